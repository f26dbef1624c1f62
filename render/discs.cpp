#include "render/discs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour.h"
#include "render/night/moon_light.h"

namespace skyig::render {

namespace {

// Linear limb darkening at red, green and blue (fits to Neckel and Labs 1994 near 610, 550 and 465 nm).
const glm::vec3 kLimb{0.53F, 0.60F, 0.72F};

// Where the air's transmittance is taken for a disc: the tables fade it out while a disc sets, which the
// shader does by cutting the disc, so it is asked no lower than where the whole disc still stands above the
// horizon.
double disc_elevation_rad(const glm::dvec3& direction_enu, const SkyLight& light) {
    constexpr double kWholeDisc_rad = 0.0048;
    return std::max(horizontal_of(direction_enu).elevation_rad, light.horizon_elevation_rad + kWholeDisc_rad);
}

}  // namespace

ToneUniforms::ToneUniforms(const gl::Program& program, bool all) {
    encode_power_ = program.uniform("u_tone.encode_power");
    if (!all) return;
    log2_gain_ = program.uniform("u_tone.log2_gain");
    exponent_ = program.uniform("u_tone.exponent");
    photopic_ = program.uniform("u_tone.photopic");
    inv_display_max_ = program.uniform("u_tone.inv_display_max");
}

void ToneUniforms::set(const gl::Program& program, const shaders32::ToneParameters& tone) const {
    program.set(encode_power_, tone.encode_power);
    if (exponent_ < 0) return;
    program.set(log2_gain_, tone.log2_gain);
    program.set(exponent_, tone.exponent);
    program.set(photopic_, tone.photopic);
    program.set(inv_display_max_, tone.inv_display_max);
}

DiscFrame disc_frame(const glm::dvec3& centre_enu, double angular_radius_rad, double pixel_rad,
                     const SkyLight& light) noexcept {
    // At the zenith any right will do: east there.
    const glm::dvec3 level = glm::cross(centre_enu, glm::dvec3{0.0, 0.0, 1.0});
    const double length = glm::length(level);
    const glm::dvec3 right = length > 1e-9 ? level / length : glm::dvec3{1.0, 0.0, 0.0};
    const Horizontal at = horizontal_of(centre_enu);
    DiscFrame frame;
    frame.centre_enu = centre_enu;
    frame.right_enu = right;
    frame.up_enu = glm::normalize(glm::cross(right, centre_enu));
    frame.radius = static_cast<float>(std::tan(angular_radius_rad));
    frame.pixel_rad = static_cast<float>(pixel_rad);
    frame.horizon_rad = static_cast<float>(light.horizon_elevation_rad);
    const double aside_rad = angular_radius_rad / std::max(std::cos(at.elevation_rad), angular_radius_rad);
    const auto sky = [&](double up_rad, double right_rad) {
        return light.rgb_cd_m2(at.elevation_rad + up_rad, at.azimuth_rad + right_rad, Side::kSky);
    };
    frame.background_cd_m2 = sky(0.0, 0.0);
    frame.background_up = 0.5F * (sky(angular_radius_rad, 0.0) - sky(-angular_radius_rad, 0.0));
    frame.background_right = 0.5F * (sky(0.0, aside_rad) - sky(0.0, -aside_rad));
    return frame;
}

DiscPass::DiscPass(std::string_view fragment)
    : program_("sky/disc.vert", fragment),
      square_({}, 4),
      tone_(program_, true),
      clip_(program_.uniform("u_clip_from_enu")),
      centre_(program_.uniform("u_centre_enu")),
      right_(program_.uniform("u_right_enu")),
      up_(program_.uniform("u_up_enu")),
      extent_(program_.uniform("u_extent")),
      radius_(program_.uniform("u_radius")),
      pixel_(program_.uniform("u_pixel_rad")),
      horizon_sin_(program_.uniform("u_horizon_sin")),
      horizon_cos_(program_.uniform("u_horizon_cos")),
      background_(program_.uniform("u_background_cd_m2")),
      background_right_(program_.uniform("u_background_right")),
      background_up_(program_.uniform("u_background_up")),
      dither_(program_.uniform("u_dither_codes")) {}

void DiscPass::prepare(const DiscFrame& frame, const shaders32::ToneParameters& tone, bool dither) const {
    program_.set(centre_, frame.centre_enu);
    program_.set(right_, frame.right_enu);
    program_.set(up_, frame.up_enu);
    program_.set(extent_, frame.radius + 2.0F * frame.pixel_rad);
    program_.set(radius_, frame.radius);
    program_.set(pixel_, frame.pixel_rad);
    program_.set(horizon_sin_, std::sin(frame.horizon_rad));
    program_.set(horizon_cos_, std::cos(frame.horizon_rad));
    program_.set(background_, frame.background_cd_m2);
    program_.set(background_right_, frame.background_right);
    program_.set(background_up_, frame.background_up);
    program_.set(dither_, dither ? 1.0F : 0.0F);
    tone_.set(program_, tone);
}

void DiscPass::draw(const glm::mat4& clip_from_enu) const {
    program_.use();
    program_.set(clip_, clip_from_enu);
    square_.draw_strip(4);
}

SunDisc::SunDisc()
    : pass_("sky/sun.frag"),
      disc_(pass_.program().uniform("u_disc_cd_m2")),
      limb_(pass_.program().uniform("u_limb")) {}

void SunDisc::prepare(const Scene& scene, const sky::AirTables& air, const SkyLight& light, double pixel_rad,
                      const shaders32::ToneParameters& tone, bool dither) const {
    const Sun& sun = scene.sun;
    pass_.prepare(disc_frame(sun.direction_enu, sun.angular_radius_rad, pixel_rad, light), tone, dither);
    const double sine = std::sin(sun.angular_radius_rad);
    const glm::dvec3 illuminance =
        air.direct_sun_xyz(light.eye_height_m, disc_elevation_rad(sun.direction_enu, light), sun.distance_au);
    const glm::dvec3 mean = illuminance / (std::numbers::pi * sine * sine);
    pass_.program().set(disc_, rec709_from_xyz(glm::vec3{mean}));
    pass_.program().set(limb_, kLimb);
}

MoonDisc::MoonDisc()
    : pass_("night/moon.frag"),
      face_(pass_.program().uniform("u_full_cd_m2")),
      earthshine_(pass_.program().uniform("u_earthshine_cd_m2")),
      to_sun_(pass_.program().uniform("u_to_sun_disc")) {}

void MoonDisc::prepare(const Scene& scene, const sky::AirTables& air, const SkyLight& light, double pixel_rad,
                       const shaders32::ToneParameters& tone, bool dither) const {
    const Moon& moon = scene.moon;
    const DiscFrame frame = disc_frame(moon.direction_enu, moon.angular_radius_rad, pixel_rad, light);
    pass_.prepare(frame, tone, dither);
    const glm::dvec3 through =
        air.transmittance_rgb(light.eye_height_m, disc_elevation_rad(moon.direction_enu, light));
    const glm::dvec3 face = night::moon_tint_rgb() * night::moon_face_cd_m2(moon) * through;
    const glm::dvec3 dark_side = glm::dvec3{night::earthshine_cd_m2(moon.phase_angle_rad)} * through;
    const glm::vec3 to_sun{moon.to_sun_enu};
    pass_.program().set(face_, glm::vec3{face});
    pass_.program().set(earthshine_, glm::vec3{dark_side});
    pass_.program().set(to_sun_, glm::vec3{glm::dot(to_sun, frame.right_enu), glm::dot(to_sun, frame.up_enu),
                                           -glm::dot(to_sun, frame.centre_enu)});
}

}  // namespace skyig::render
