#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "render/deferred_pass.h"
#include "render/discs.h"
#include "render/dome.h"
#include "render/eye/adaptation.h"
#include "render/eye/tone_curve.h"
#include "render/gl/debug_log.h"
#include "render/gl/draw.h"
#include "render/gl/framebuffer.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/light_tables.h"
#include "render/star_field.h"

namespace skyig::render {

namespace {

// Points whose centre lies outside the picture by less than half a footprint still show, also where the
// frustum's edge spreads the footprint over more pixels.
constexpr int kStarGuard_px = 16;
constexpr double kStarSigma_px = 0.7;

constexpr double kZenith_rad = 1.5707;

// Softening of edges where no channel says how fine its pixels are.
constexpr double kCoarsestEdge_rad = 0.02;

bool has_area(const Frustum& f) {
    return f.right_rad > f.left_rad && f.top_rad > f.bottom_rad;
}

// A shift of adaptation smaller than this moves no pixel by half a display code.
constexpr double kAdaptationStep = 0.002;

// Of the sources' relative azimuth, or of the moonlit share: below it the dome's colours stay.
constexpr float kLightStep = 5e-4F;

// Directions at infinity: z is 0, which no depth range clips; w is the distance along the view axis.
glm::dmat4 clip_from_view(const Frustum& frustum, double guard_x, double guard_y) {
    const ImagePlane p = image_plane(frustum);
    const double width = (p.right - p.left) * guard_x;
    const double height = (p.top - p.bottom) * guard_y;
    return {glm::dvec4{2.0 / width, 0.0, 0.0, 0.0}, glm::dvec4{0.0, 2.0 / height, 0.0, 0.0},
            glm::dvec4{(p.right + p.left) / width, (p.top + p.bottom) / height, 0.0, -1.0}, glm::dvec4{0.0}};
}

class StarPass {
  public:
    StarPass()
        : program_("night/star.vert", "night/star.frag"),
          mesh_({3, 3, 3}, field_.capacity()),
          tone_(program_, false),
          clip_(program_.uniform("u_clip_from_enu")),
          view_(program_.uniform("u_view_from_enu")),
          plane_origin_(program_.uniform("u_plane_origin")),
          plane_step_(program_.uniform("u_plane_step")),
          sigma_(program_.uniform("u_sigma_rad")),
          point_gain_(program_.uniform("u_point_gain")) {}

    void prepare(const Scene& scene, const sky::AirTables& air, const SkyLight& light,
                 const shaders64::ToneParameters& tone, double limit_mag) {
        field_.update(scene, air, light, tone, limit_mag);
        const auto stars = field_.stars();
        mesh_.update({reinterpret_cast<const float*>(stars.data()), stars.size_bytes() / sizeof(float)});
        const auto tone32 = eye::single_precision(tone);
        tone_.set(program_, tone32);
        program_.set(point_gain_, tone32.point_gain * tone32.inv_display_max);
    }

    void draw(const Channel& channel, const ChannelView& view) const {
        const double width = channel.width_px + 2.0 * kStarGuard_px;
        const double height = channel.height_px + 2.0 * kStarGuard_px;
        const ImagePlane p = image_plane(view.frustum);
        const glm::dvec2 step{(p.right - p.left) / channel.width_px, (p.top - p.bottom) / channel.height_px};
        program_.use();
        program_.set(clip_, glm::mat4{clip_from_view(view.frustum, width / channel.width_px,
                                                     height / channel.height_px) *
                                      glm::dmat4{view.view_from_enu}});
        program_.set(view_, glm::mat4{glm::dmat4{view.view_from_enu}});
        program_.set(plane_origin_, glm::vec2{glm::dvec2{p.left, p.bottom}});
        program_.set(plane_step_, glm::vec2{step});
        program_.set(sigma_, static_cast<float>(kStarSigma_px * pixel_angle_rad(channel, view.frustum)));
        mesh_.draw_points(field_.stars().size());
    }

    [[nodiscard]] std::size_t count() const { return field_.stars().size(); }

  private:
    StarField field_;
    gl::Program program_;
    gl::Mesh mesh_;
    ToneUniforms tone_;
    int clip_, view_, plane_origin_, plane_step_, sigma_, point_gain_;
};

}  // namespace

struct Renderer::Impl {
    Impl(std::vector<Channel> channel_list, const DisplaySettings& display_settings)
        : channels(std::move(channel_list)), display(display_settings) {
        for (const Channel& channel : channels)
            targets.emplace_back(channel.width_px, channel.height_px);
        dome_mesh.set_indices(dome.indices());
        dome_program.set(dome_program.uniform("u_dither_codes"), display.dither ? 1.0F : 0.0F);
        gl::set_common_state();
    }

    void adapt();
    void refresh_dome();
    void refresh_deferred();

    std::vector<Channel> channels;
    DisplaySettings display;
    gl::DebugLog log;
    std::vector<gl::Framebuffer> targets;
    gl::Program dome_program{"sky/dome.vert", "sky/dome.frag"};
    int dome_clip = dome_program.uniform("u_clip_from_mesh");
    int dome_half_size = dome_program.uniform("u_half_size_px");
    Dome dome;
    gl::Mesh dome_mesh{{3, 3}, dome.vertices().size()};
    StarPass stars;
    Corona corona;
    SunDisc sun_disc;
    MoonDisc moon_disc;
    std::unique_ptr<DeferredPass> deferred;  // once a scene is drawn

    LightTables tables;
    eye::Adaptation adaptation;

    // The frame in hand.
    Scene scene;
    SkyLight light;
    shaders64::ToneParameters tone{};
    double pixel_rad = 1e-3;
    FrameReport report;

    // What the dome's colours were made from.
    struct Shaded {
        std::uint64_t revision = 0;
        double adaptation_cd_m2 = 0.0;
        glm::vec3 sun_scale{-1.0F};
        glm::vec3 moon_scale{-1.0F};
        double moon_from_sun_rad = 0.0;
    } shaded;
};

void Renderer::Impl::adapt() {
    std::array<double, eye::kProbeCount> luminance{};
    double darkest_sky = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < eye::kProbeCount; ++i) {
        const eye::ProbeDirection& probe = eye::probe_directions()[i];
        const double elevation = std::min(light.horizon_elevation_rad + probe.above_horizon_rad, kZenith_rad);
        luminance[i] = static_cast<double>(
            shaders32::luminance_709(light.rgb_cd_m2(elevation, probe.azimuth_rad, Side::kByElevation)));
        if (probe.above_horizon_rad > 0.0) darkest_sky = std::min(darkest_sky, luminance[i]);
    }
    report.adaptation_cd_m2 =
        adaptation.update(eye::adaptation_target_cd_m2(luminance), scene.time_s, tables.jumped(), display);
    tone = eye::tone_parameters(display, report.adaptation_cd_m2);
    plan_stars(report.plan, scene, darkest_sky);
}

// Whether a colour's factor has changed by what could move a display code.
bool scale_moved(const glm::vec3& a, const glm::vec3& b) {
    return glm::any(glm::greaterThan(glm::abs(a - b), kLightStep * glm::max(a, b)));
}

void Renderer::Impl::refresh_dome() {
    const DomeLayout wanted = dome_layout(light, pixel_rad);
    const bool lay = shaded.revision == 0 || !still_serves(dome.layout(), wanted);
    const bool stale = lay || shaded.revision != tables.revision() ||
                       std::abs(report.adaptation_cd_m2 - shaded.adaptation_cd_m2) >
                           kAdaptationStep * shaded.adaptation_cd_m2 ||
                       scale_moved(light.sun.scale_xyz, shaded.sun_scale) ||
                       scale_moved(light.moon.scale_xyz, shaded.moon_scale) ||
                       std::abs(std::remainder(wanted.second_azimuth_rad - shaded.moon_from_sun_rad,
                                               2.0 * std::numbers::pi)) > static_cast<double>(kLightStep);
    if (!stale) return;
    if (lay) dome.lay_out(wanted);
    dome.shade(light, tone);
    const auto vertices = dome.vertices();
    dome_mesh.update(
        {reinterpret_cast<const float*>(vertices.data()), vertices.size_bytes() / sizeof(float)});
    shaded = {tables.revision(), report.adaptation_cd_m2, light.sun.scale_xyz, light.moon.scale_xyz,
              wanted.second_azimuth_rad};
}

void Renderer::Impl::refresh_deferred() {
    deferred->prepare(scene, report.plan, tables, light, eye::single_precision(tone), display.dither);
}

Renderer::Renderer(std::vector<Channel> channels, const DisplaySettings& display) {
    if (channels.empty() || channels.size() > kMaxChannels) {
        throw std::runtime_error("a renderer draws 1 to " + std::to_string(kMaxChannels) + " channels, not " +
                                 std::to_string(channels.size()));
    }
    impl_ = std::make_unique<Impl>(std::move(channels), display);
}

Renderer::~Renderer() = default;

const FrameReport& Renderer::prepare(const Scene& scene) {
    Impl& m = *impl_;
    m.scene = scene;
    const sky::RefractionRow refraction = m.tables.refraction(scene);
    m.report.plan = make_plan(scene, m.tables.held(scene), refraction);
    m.tables.update(scene, m.report.plan);
    m.light = m.tables.light(scene, m.report.plan, refraction);

    m.pixel_rad = kCoarsestEdge_rad;
    for (std::size_t i = 0; i < m.channels.size() && i < scene.view_count; ++i) {
        if (!has_area(scene.views[i].frustum)) continue;
        m.pixel_rad = std::min(m.pixel_rad, pixel_angle_rad(m.channels[i], scene.views[i].frustum));
    }
    m.adapt();
    m.refresh_dome();

    const auto tone32 = eye::single_precision(m.tone);
    const Plan& plan = m.report.plan;
    m.report.stars_drawn = 0;
    if (plan.needs(Pass::kStars)) {
        m.stars.prepare(scene, m.tables.air(), m.light, m.tone, plan.star_limit_mag);
        m.report.stars_drawn = m.stars.count();
    }
    if (plan.needs(Pass::kCorona)) {
        m.corona.prepare(scene, m.tables.air(), m.light, m.pixel_rad, tone32, plan.corona_share);
    }
    if (plan.needs(Pass::kSunDisc)) {
        m.sun_disc.prepare(scene, m.tables.air(), m.light, m.pixel_rad, tone32, m.display.dither);
    }
    if (plan.needs(Pass::kMoonDisc)) {
        m.moon_disc.prepare(scene, m.tables.air(), m.light, m.pixel_rad, tone32, m.display.dither);
    }
    if (m.deferred) m.refresh_deferred();
    m.report.gl_errors = m.log.errors();
    return m.report;
}

void Renderer::draw(std::size_t channel) {
    Impl& m = *impl_;
    if (channel >= m.channels.size() || channel >= m.scene.view_count) return;
    const ChannelView& view = m.scene.views[channel];
    if (!has_area(view.frustum)) return;
    const Plan& plan = m.report.plan;
    const glm::dmat4 clip_from_enu = clip_from_view(view.frustum, 1.0, 1.0) * glm::dmat4{view.view_from_enu};

    m.targets[channel].bind();
    gl::set_blend(gl::Blend::kReplace);
    m.dome_program.use();
    const glm::dmat4 clip_from_mesh =
        clip_from_enu * glm::dmat4{Dome::enu_from_mesh(dome_azimuth_rad(m.light))};
    m.dome_program.set(m.dome_clip, glm::mat4{clip_from_mesh});
    m.dome_program.set(m.dome_half_size,
                       0.5F * glm::vec2{m.channels[channel].width_px, m.channels[channel].height_px});
    for (const IndexRange& range : m.dome.visible(clip_from_mesh))
        m.dome_mesh.draw_triangles(range.first, range.count);

    if (plan.needs(Pass::kStars)) {
        gl::set_blend(gl::Blend::kAdd);
        m.targets[channel].bind(kStarGuard_px);
        m.stars.draw(m.channels[channel], view);
        m.targets[channel].bind();
    }
    if (plan.needs(Pass::kCorona)) {
        gl::set_blend(gl::Blend::kAdd);
        m.corona.draw(glm::mat4{clip_from_enu});
    }
    gl::set_blend(gl::Blend::kCoverage);
    if (plan.needs(Pass::kSunDisc)) m.sun_disc.draw(glm::mat4{clip_from_enu});
    if (plan.needs(Pass::kMoonDisc)) m.moon_disc.draw(glm::mat4{clip_from_enu});
    gl::finish();
}

void Renderer::draw_scene(std::size_t channel, const DeferredInput& input) {
    Impl& m = *impl_;
    draw(channel);
    if (channel >= m.channels.size() || channel >= m.scene.view_count) return;
    const ChannelView& view = m.scene.views[channel];
    if (!has_area(view.frustum) || !(input.far_m > 0.0)) return;
    if (!m.deferred) {
        m.deferred = std::make_unique<DeferredPass>();
        m.refresh_deferred();
    }
    m.targets[channel].bind();
    gl::set_blend(gl::Blend::kReplace);
    m.deferred->draw(view, input);
    gl::finish();
}

void Renderer::read_back(std::size_t channel, std::span<std::byte> rgba) {
    if (channel < impl_->targets.size()) impl_->targets[channel].read_rgba8(rgba);
}

std::span<const Channel> Renderer::channels() const noexcept {
    return impl_->channels;
}

glm::dvec3 Renderer::reference_colour(const glm::dvec3& direction_enu) const {
    const Horizontal at = horizontal_of(direction_enu);
    const glm::vec3 rgb = impl_->light.rgb_cd_m2(at.elevation_rad, at.azimuth_rad, Side::kByElevation);
    return shaders64::shown(glm::dvec3{rgb}, impl_->tone);
}

glm::dvec3 Renderer::reference_colour(const glm::dvec3& direction_enu, double distance_m,
                                      const glm::dvec3& rgb_cd_m2) const {
    if (!impl_->deferred) return shaders64::shown(rgb_cd_m2, impl_->tone);
    return shaders64::shown(impl_->deferred->air().under_air(rgb_cd_m2, direction_enu, distance_m),
                            impl_->tone);
}

}  // namespace skyig::render
