#include "render/wet_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/precipitation/streak_field.h"
#include "render/sky/sea_waves.h"

namespace skyig::render {

namespace {

using precipitation::Ripples;

double rain_mm_h(const Scene& scene) {
    double rate_mm_h = 0.0;
    for (const Precipitation& falling : scene.weather.all_precipitations()) {
        const bool drops = falling.kind == Precipitation::Kind::kRain ||
                           falling.kind == Precipitation::Kind::kDrizzle ||
                           falling.kind == Precipitation::Kind::kSleet;
        if (drops && precipitation::falls_on(falling, scene.eye)) rate_mm_h += falling.rate_mm_h;
    }
    return rate_mm_h;
}

glm::vec2 within_tile(const glm::dvec2& m) {
    return glm::vec2{m / Ripples::kSide_m - glm::floor(m / Ripples::kSide_m)};
}

}  // namespace

WetPass::WetPass()
    : program_("sky/deferred.vert", "precipitation/wet.frag"),
      triangle_({}, 3),
      tone_(program_, true),
      surface_(program_),
      film_(program_.uniform("u_film")),
      extinction_(program_.uniform("u_extinction_per_m")),
      anchor_(program_.uniform("u_tile_at_eye")),
      pixel_(program_.uniform("u_pixel_rad")),
      sky_(gl::TexelFormat::kRgba32F, kColumns + 1, kRows),
      slopes_(gl::TexelFormat::kRgba32F, Ripples::kCells + 1, Ripples::kCells + 1),
      texels_(std::size_t{kColumns + 1} * kRows * 4) {
    program_.set(program_.uniform("u_sky_size"), glm::vec2{kColumns + 1, kRows});
    program_.set(program_.uniform("u_tile_texels"), static_cast<float>(Ripples::kCells + 1));
    program_.set(program_.uniform("u_tile_m"), static_cast<float>(Ripples::kSide_m));
    slopes_.update(ripples_.slopes());
}

void WetPass::prepare(const Scene& scene, const SkyLight& light,
                      const precipitation::ExposureView& exposure) {
    exposure_ = exposure;
    std::size_t out = 0;
    for (int row = 0; row < kRows; ++row) {
        const double elevation_rad = std::asin(static_cast<double>(row) / (kRows - 1));
        for (int column = 0; column <= kColumns; ++column, out += 4) {
            const double azimuth_rad = 2.0 * std::numbers::pi * (column % kColumns) / kColumns;
            const glm::vec3 rgb = light.covered_rgb_cd_m2(elevation_rad, azimuth_rad, Side::kSky);
            std::copy_n(&rgb.x, 3, texels_.begin() + static_cast<std::ptrdiff_t>(out));
        }
    }
    sky_.update(texels_);
    if (ripples_.advance(scene.time_s, rain_mm_h(scene))) slopes_.update(ripples_.slopes());
    program_.set(film_, static_cast<float>(light.film));
    program_.set(extinction_, static_cast<float>(light.near_extinction_per_m));
    program_.set(anchor_, within_tile(sky::sea_anchor(scene.eye).eye_m));
}

void WetPass::draw(const Channel& channel, const ChannelView& view, const shaders32::ToneParameters& tone,
                   const DeferredInput& input) const {
    tone_.set(program_, tone);
    surface_.bind(program_, channel, view, input, exposure_);
    program_.use();
    program_.set(pixel_, static_cast<float>(pixel_angle_rad(channel, view.frustum)));
    gl::bind_texture(1, sky_.name());
    gl::bind_texture(2, slopes_.name());
    triangle_.draw_strip(3);
}

}  // namespace skyig::render
