// Compiles the shared GLSL texts as C++: once in float (as the GPU computes), once in double (as tests
// judge).
#pragma once

#include <glm/glm.hpp>

#define SKYIG_CPP
#define SKYIG_INLINE inline

namespace skyig::render::shaders32 {
using real = float;
using rvec2 = glm::vec2;
using rvec3 = glm::vec3;
using glm::clamp, glm::max, glm::min, glm::exp2, glm::log2, glm::pow, glm::log, glm::exp, glm::sqrt, glm::sin,
    glm::cos, glm::tan, glm::asin, glm::dot, glm::length, glm::abs, glm::floor;
#include "render/shaders/cloud/before.glsl"
#include "render/shaders/cloud/map.glsl"
#include "render/shaders/common/angle.glsl"
#include "render/shaders/common/fresnel.glsl"
#include "render/shaders/eye/tone.glsl"
// After the tone curve that it builds on.
#include "render/shaders/eye/fovea.glsl"
#include "render/shaders/fog/veil.glsl"
// After the ray that it follows.
#include "render/shaders/fog/patches.glsl"
#include "render/shaders/night/moon.glsl"
#include "render/shaders/sky/aerial.glsl"
#include "render/shaders/sky/cie.glsl"
#include "render/shaders/sky/preetham.glsl"
#include "render/shaders/sky/sea.glsl"
#include "render/shaders/sky/windlight.glsl"
}  // namespace skyig::render::shaders32

namespace skyig::render::shaders64 {
using real = double;
using rvec2 = glm::dvec2;
using rvec3 = glm::dvec3;
using glm::clamp, glm::max, glm::min, glm::exp2, glm::log2, glm::pow, glm::log, glm::exp, glm::sqrt, glm::sin,
    glm::cos, glm::tan, glm::asin, glm::dot, glm::length, glm::abs, glm::floor;
#include "render/shaders/cloud/before.glsl"
#include "render/shaders/cloud/map.glsl"
#include "render/shaders/common/angle.glsl"
#include "render/shaders/common/fresnel.glsl"
#include "render/shaders/eye/tone.glsl"
// After the tone curve that it builds on.
#include "render/shaders/eye/fovea.glsl"
#include "render/shaders/fog/veil.glsl"
// After the ray that it follows.
#include "render/shaders/fog/patches.glsl"
#include "render/shaders/night/moon.glsl"
#include "render/shaders/sky/aerial.glsl"
#include "render/shaders/sky/cie.glsl"
#include "render/shaders/sky/preetham.glsl"
#include "render/shaders/sky/sea.glsl"
#include "render/shaders/sky/windlight.glsl"
}  // namespace skyig::render::shaders64

#undef SKYIG_CPP
#undef SKYIG_INLINE
