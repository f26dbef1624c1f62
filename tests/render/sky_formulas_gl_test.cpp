// The closed formulas of the sky are one text: here the driver compiles it, and its numbers are held against
// those of the same text in double precision.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/shaders/shader_text.h"
#include "render/shaders/shared.h"

namespace skyig::render {
namespace {

constexpr int kCount = 256;
constexpr std::size_t kValues = 8;

// Directions spread over the sky, from the index alone so that both sides have the same.
constexpr const char* kMain = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Result { float value[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    float elevation = 0.02 + 1.5 * float((i * 37u) % 256u) / 256.0;
    float sun = 0.06 + 1.4 * float((i * 101u) % 256u) / 256.0;
    float angle = angle_between(elevation, sun, 3.1 * float(i) / 256.0);
    CieSky cie = CieSky(-1.0, -0.32, 10.0, -3.0, 0.45);
    Windlight look = Windlight(vec3(0.25, 0.45, 0.76), 0.7, 1.8e-4, 1600.0, vec3(0.5, 0.5, 0.64), 0.19,
                               vec3(0.73, 0.78, 0.9), vec3(0.35), 5.0, 0.001, -0.48, 0.01);
    WindlightAir air = windlight_air(sin(elevation), sin(sun), angle, 20000.0, look);
    uint at = 8u * i;
    value[at] = angle;
    value[at + 1u] = cie_relative(sin(elevation), angle, 1.5707963 - sun, cie);
    value[at + 2u] = perez_relative(sin(elevation), angle, 1.5707963 - sun, preetham_luminance(3.0));
    value[at + 3u] = preetham_zenith_luminance(3.0, 1.5707963 - sun);
    value[at + 4u] = preetham_zenith_x(3.0, 1.5707963 - sun);
    value[at + 5u] = perez_relative(sin(elevation), angle, 1.5707963 - sun, preetham_y(3.0));
    value[at + 6u] = air.passed.y;
    value[at + 7u] = air.added.z;
}
)";

std::array<double, kValues> in_double(unsigned i) {
    using namespace shaders64;
    const double elevation = 0.02 + 1.5 * ((i * 37U) % 256U) / 256.0;
    const double sun = 0.06 + 1.4 * ((i * 101U) % 256U) / 256.0;
    const double zenith = 1.5707963267948966 - sun;
    const double angle = angle_between(elevation, sun, 3.1 * i / 256.0);
    const CieSky cie{-1.0, -0.32, 10.0, -3.0, 0.45};
    const Windlight look{{0.25, 0.45, 0.76},
                         0.7,
                         1.8e-4,
                         1600.0,
                         {0.5, 0.5, 0.64},
                         0.19,
                         {0.73, 0.78, 0.9},
                         glm::dvec3(0.35),
                         5.0,
                         0.001,
                         -0.48,
                         0.01};
    const double sine = std::sin(elevation);
    const WindlightAir air = windlight_air(sine, std::sin(sun), angle, 20000.0, look);
    return {angle,
            cie_relative(sine, angle, zenith, cie),
            perez_relative(sine, angle, zenith, preetham_luminance(3.0)),
            preetham_zenith_luminance(3.0, zenith),
            preetham_zenith_x(3.0, zenith),
            perez_relative(sine, angle, zenith, preetham_y(3.0)),
            air.passed.y,
            air.added.z};
}

std::string whole_text() {
    std::string text = "#version 450 core\n";
    for (const char* path : {"common/scalar.glsl", "common/angle.glsl", "sky/cie.glsl", "sky/preetham.glsl",
                             "sky/windlight.glsl"})
        text += std::string(*shaders::shader_text(path)) + "\n";
    return text + kMain;
}

TEST(SkyFormulas, TheDriverComputesWhatTheSameTextGivesInDouble) {
    const gl::HeadlessContext context = gl::HeadlessContext::create(true);
    const std::string text = whole_text();
    const char* source = text.c_str();
    const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    std::array<char, 2048> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    ASSERT_EQ(linked, GL_TRUE) << log.data();
    GLuint buffer = 0;
    std::vector<float> values(kCount * kValues);
    const auto bytes = static_cast<GLsizeiptr>(values.size() * sizeof(float));
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
    glUseProgram(program);
    glDispatchCompute(kCount / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, values.data());
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);

    double largest = 0.0;
    for (unsigned i = 0; i < kCount; ++i) {
        const auto wanted = in_double(i);
        for (std::size_t k = 0; k < kValues; ++k) {
            const auto made = static_cast<double>(values[i * kValues + k]);
            largest = std::max(largest, std::abs(made - wanted[k]) / (std::abs(wanted[k]) + 0.01));
        }
    }
    std::printf("largest relative difference %.1e\n", largest);
    // A fifth of what moves a display code.
    EXPECT_LT(largest, 1e-3);
}

}  // namespace
}  // namespace skyig::render
