#include "render/discs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/colour.h"
#include "render/night/moon_light.h"
#include "render/night/moon_map.h"

namespace skyig::render {

namespace {

// Linear limb darkening at red, green and blue (fits to Neckel and Labs 1994 near 610, 550 and 465 nm).
const glm::vec3 kLimb{0.53F, 0.60F, 0.72F};

// Of the map of the Moon's face: down to one texel.
constexpr int kMapLevels = 10;

// Reach of the corona, in radii of the Sun: as in sky/corona.frag.
constexpr double kCoronaRadii = 8.0;

// What a disc of limb darkening adds up to when its edge is softened over `pixel_radii`, by the sum of the
// sharp one: a few percent less where a disc has few pixels, since it is the bright side of the edge that
// loses.
glm::vec3 softened_sum(float pixel_radii) {
    constexpr int kSteps = 64;
    const float reach = 1.0F + 0.5F * pixel_radii;
    glm::vec3 sum{0.0F};
    for (int i = 0; i < kSteps; ++i) {
        const float rho = (static_cast<float>(i) + 0.5F) / kSteps * reach;
        const float inside = std::min(rho, 1.0F);
        const float cosine = std::sqrt(1.0F - inside * inside);
        const float coverage = std::clamp((1.0F - rho) / pixel_radii + 0.5F, 0.0F, 1.0F);
        sum += (glm::vec3{1.0F} - kLimb * (1.0F - cosine)) * (coverage * rho);
    }
    return sum * (2.0F * reach / kSteps) / (glm::vec3{1.0F} - kLimb / 3.0F);
}

// The same for the Moon, whose lit limb is its brightest part: what its face adds up to with a softened edge,
// by the sum of the sharp one. \param to_sun_disc  right, up, towards the eye
float softened_moon_sum(float pixel_radii, const glm::vec3& to_sun_disc) {
    constexpr int kSteps = 32;
    const float reach = 1.0F + 0.5F * pixel_radii;
    float sharp = 1e-4F;
    float soft = 1e-4F;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::vec2 xy = (glm::vec2{i / kSteps, i % kSteps} * 2.0F + 1.0F) * (reach / kSteps) - reach;
        const float rho = glm::length(xy);
        const float coverage = std::clamp((1.0F - rho) / pixel_radii + 0.5F, 0.0F, 1.0F);
        const glm::vec3 normal{xy.x, xy.y, std::sqrt(1.0F - std::min(rho * rho, 1.0F))};
        const float light = shaders32::lommel_seeliger(glm::dot(normal, to_sun_disc), normal.z);
        soft += light * coverage;
        if (rho < 1.0F) sharp += light;
    }
    return soft / sharp;
}

// Rows over the Sun whose light is the mean luminance of its disc.
DiscFrame sunlit_frame(const Sun& sun, const sky::AirTables& air, const SkyLight& light, double pixel_rad,
                       double reach_radii) {
    DiscFrame frame = disc_frame(sun.direction_enu, sun.angular_radius_rad, pixel_rad, light, reach_radii);
    const double sine = std::sin(sun.angular_radius_rad);
    const double solid_angle = std::numbers::pi * sine * sine;
    for (std::size_t row = 0; row < DiscFrame::kRows; ++row) {
        const glm::dvec3 illuminance =
            air.direct_sun_xyz(light.eye_height_m, frame.straight_elevation_rad[row], sun.distance_au);
        const double passes = light.veil_passes(frame.straight_elevation_rad[row]);
        frame.set_light(row, rec709_from_xyz(glm::vec3{passes * illuminance / solid_angle}));
    }
    return frame;
}

}  // namespace

ToneUniforms::ToneUniforms(const gl::Program& program, bool all) {
    encode_power_ = program.uniform("u_tone.encode_power");
    ambient_ = program.uniform("u_tone.ambient");
    shoulder_ = program.uniform("u_tone.shoulder");
    if (!all) return;
    log2_gain_ = program.uniform("u_tone.log2_gain");
    exponent_ = program.uniform("u_tone.exponent");
    compression_ = program.uniform("u_tone.compression");
    burn_ = program.uniform("u_tone.burn");
    photopic_ = program.uniform("u_tone.photopic");
    inv_display_max_ = program.uniform("u_tone.inv_display_max");
}

void ToneUniforms::set(const gl::Program& program, const shaders32::ToneParameters& tone) const {
    program.set(encode_power_, tone.encode_power);
    program.set(ambient_, tone.ambient);
    program.set(shoulder_, tone.shoulder);
    if (exponent_ < 0) return;
    program.set(log2_gain_, tone.log2_gain);
    program.set(exponent_, tone.exponent);
    program.set(compression_, tone.compression);
    program.set(burn_, tone.burn);
    program.set(photopic_, tone.photopic);
    program.set(inv_display_max_, tone.inv_display_max);
}

DiscPass::DiscPass(std::string_view fragment, gl::Placement placement, bool dithers)
    : program_("sky/disc.vert", fragment, placement),
      strip_({2, 2, 3}, 2 * DiscFrame::kRows),
      tone_(program_, true),
      clip_(program_.uniform("u_clip_from_enu")),
      centre_(program_.uniform("u_centre_enu")),
      right_(program_.uniform("u_right_enu")),
      up_(program_.uniform("u_up_enu")),
      radius_(program_.uniform("u_radius")),
      pixel_(program_.uniform("u_pixel_rad")),
      horizon_sin_(program_.uniform("u_horizon_sin")),
      horizon_cos_(program_.uniform("u_horizon_cos")),
      background_(program_.uniform("u_background_cd_m2")),
      background_right_(program_.uniform("u_background_right")),
      background_up_(program_.uniform("u_background_up")),
      dither_(dithers ? program_.uniform("u_dither_codes") : -1) {}

void DiscPass::prepare(const SkyFrame& sky, DiscFrame frame, const shaders32::ToneParameters& tone,
                       bool dither) {
    shows_ = !sky.clouds().shown() ||
             put_behind_clouds(
                 frame,
                 [&](const glm::dvec3& behind_cd_m2, const glm::dvec3& direction_enu) {
                     return sky.through_clouds(behind_cd_m2, direction_enu);
                 },
                 [&](const glm::dvec3& direction_enu) { return sky.clouds().transmittance(direction_enu); });
    strip_.update(
        {reinterpret_cast<const float*>(frame.vertices.data()), sizeof(frame.vertices) / sizeof(float)});
    program_.set(centre_, frame.centre_enu);
    program_.set(right_, frame.right_enu);
    program_.set(up_, frame.up_enu);
    program_.set(radius_, frame.radius);
    program_.set(pixel_, frame.pixel_rad);
    program_.set(horizon_sin_, std::sin(frame.horizon_rad));
    program_.set(horizon_cos_, std::cos(frame.horizon_rad));
    program_.set(background_, frame.background_cd_m2);
    program_.set(background_right_, frame.background_right);
    program_.set(background_up_, frame.background_up);
    if (dither_ >= 0) program_.set(dither_, dither ? 1.0F : 0.0F);
    tone_.set(program_, tone);
}

void DiscPass::draw(const glm::mat4& clip_from_enu) const {
    if (!shows_) return;
    program_.use();
    program_.set(clip_, clip_from_enu);
    strip_.draw_strip(2 * DiscFrame::kRows);
}

SunDisc::SunDisc(gl::Placement placement)
    : pass_("sky/sun.frag", placement, true), limb_(pass_.program().uniform("u_limb")) {}

void SunDisc::prepare(const Scene& scene, const SkyFrame& sky, double pixel_rad,
                      const shaders32::ToneParameters& tone, bool dither) {
    DiscFrame frame = sunlit_frame(scene.sun, sky.air(), sky.light(), pixel_rad, 1.0);
    const glm::vec3 kept = softened_sum(static_cast<float>(pixel_rad / scene.sun.angular_radius_rad));
    for (DiscVertex& vertex : frame.vertices)
        vertex.light /= kept;
    pass_.prepare(sky, frame, tone, dither);
    pass_.program().set(limb_, kLimb);
}

Corona::Corona(gl::Placement placement)
    : pass_("sky/corona.frag", placement, false), share_(pass_.program().uniform("u_share")) {}

void Corona::prepare(const Scene& scene, const SkyFrame& sky, double pixel_rad,
                     const shaders32::ToneParameters& tone, double share) {
    pass_.prepare(sky, sunlit_frame(scene.sun, sky.air(), sky.light(), pixel_rad, kCoronaRadii), tone, false);
    pass_.program().set(share_, static_cast<float>(share));
}

MoonDisc::MoonDisc(gl::Placement placement)
    : pass_("night/moon.frag", placement, true),
      map_(gl::TexelFormat::kR32F, night::kMoonMapSize, night::kMoonMapSize, 0, kMapLevels),
      face_(pass_.program().uniform("u_full_cd_m2")),
      earthshine_(pass_.program().uniform("u_earthshine_cd_m2")),
      mean_(pass_.program().uniform("u_mean_cd_m2")),
      veil_(pass_.program().uniform("u_veil_cd_m2")),
      to_sun_(pass_.program().uniform("u_to_sun_disc")),
      shadow_axis_(pass_.program().uniform("u_shadow_axis_disc")),
      shadow_radii_(pass_.program().uniform("u_shadow_radii")),
      selenographic_(pass_.program().uniform("u_selenographic_from_disc")),
      map_level_(pass_.program().uniform("u_map_level")),
      veil_own_(pass_.program().uniform("u_veil_own_cd_m2")),
      fovea_factor_(pass_.program().uniform("u_fovea.log2_factor")),
      fovea_slope_(pass_.program().uniform("u_fovea.slope")) {
    std::vector<float> albedo;
    albedo.reserve(night::moon_map().size());
    for (const std::uint8_t texel : night::moon_map())
        albedo.push_back(static_cast<float>(texel / night::kMoonMapOne));
    map_.update(albedo);
}

void MoonDisc::prepare(const Scene& scene, const SkyFrame& sky, double pixel_rad,
                       const shaders32::ToneParameters& tone, bool dither, const shaders64::Fovea& fovea,
                       const Glare::Limb& veil) {
    const Moon& moon = scene.moon;
    const SkyLight& light = sky.light();
    DiscFrame frame = disc_frame(moon.direction_enu, moon.angular_radius_rad, pixel_rad, light);
    for (std::size_t row = 0; row < DiscFrame::kRows; ++row) {
        frame.set_light(row, glm::vec3{light.veil_passes(frame.straight_elevation_rad[row]) *
                                       sky.air().transmittance_rgb(light.eye_height_m,
                                                                   frame.straight_elevation_rad[row])});
    }
    frame.brightness = static_cast<float>(night::moon_mean_cd_m2(moon, scene.sun.distance_au));
    pass_.prepare(sky, frame, tone, dither);
    const glm::mat3 enu_from_disc{frame.right_enu, frame.true_up_enu, -frame.true_centre_enu};
    const glm::mat3 disc_from_enu = glm::transpose(enu_from_disc);
    const double sun_au = scene.sun.distance_au;
    const gl::Program& program = pass_.program();
    const glm::vec3 to_sun_disc = disc_from_enu * glm::vec3{moon.to_sun_enu};
    const double pixel_radii = pixel_rad / moon.angular_radius_rad;
    const double face_cd_m2 =
        night::moon_face_cd_m2(moon, sun_au) /
        static_cast<double>(softened_moon_sum(static_cast<float>(pixel_radii), to_sun_disc));
    program.set(face_, glm::vec3{night::moon_tint_rgb() * face_cd_m2});
    program.set(earthshine_,
                glm::vec3{night::earthshine_tint_rgb() * night::earthshine_cd_m2(moon.phase_angle_rad)});
    program.set(mean_, static_cast<float>(night::moon_mean_cd_m2(moon, sun_au)));
    program.set(veil_, veil.rgb_cd_m2);
    program.set(veil_own_, veil.own_cd_m2);
    program.set(to_sun_, to_sun_disc);
    program.set(shadow_axis_, disc_from_enu * glm::vec3{moon.shadow_axis_enu});
    program.set(shadow_radii_, glm::vec2{glm::dvec2{moon.umbra_radius, moon.penumbra_radius}});
    program.set(selenographic_, glm::transpose(glm::mat3{moon.enu_from_selenographic}) * enu_from_disc);
    const double texel_radii = 2.0 * shaders64::kMoonMapReach / night::kMoonMapSize;
    program.set(map_level_, static_cast<float>(std::max(0.0, std::log2(pixel_radii / texel_radii))));
    program.set(fovea_factor_, static_cast<float>(fovea.log2_factor));
    program.set(fovea_slope_, static_cast<float>(fovea.slope));
}

void MoonDisc::draw(const glm::mat4& clip_from_enu) const {
    gl::bind_texture(0, map_.name());
    pass_.draw(clip_from_enu);
}

}  // namespace skyig::render
