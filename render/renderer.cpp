#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "render/renderer_impl.h"

namespace skyig::render {

void Renderer::Impl::begin(std::size_t channel, bool flat) {
    draws_flat = flat && channels[channel].warp;
    pictures.begin(channel);
    if (!draws_flat) {
        warps.bind(channel);
        return;
    }
    make_flat_picture(channel);
    warps.bind_flat();
    flat_pictures[channel]->bind();
}

/// From what is drawn to the picture.
void Renderer::Impl::finish(std::size_t channel) {
    if (draws_flat) {
        pictures.begin(channel);
        warps.resample(channel, *flat_pictures[channel]);
    }
    pictures.finish(channel);
    if (shows_screen && !shows_pattern(channel) && !channels[channel].warp)
        windscreens.draw(channel, scene.views[channel], pictures.whole(channel));
    if (shows_screen) blend.draw(channel, pictures.whole(channel), tone32(channel).encode_power);
    if (shows_pattern(channel) || (shows_screen && scene.views[channel].overlay != 0)) write_texts(channel);
    gl::finish();
}

void Renderer::Impl::make_flat_picture(std::size_t channel) {
    const Channel& size = flat_channels[channel];
    if (!flat_pictures[channel]) flat_pictures[channel].emplace(size.width_px, size.height_px, target_format);
}

void Renderer::Impl::make_ready() noexcept {
    try {
        if (shows_screen && !patterns) patterns = std::make_unique<PatternPass>(placement);
        if (shows_screen && !texts) texts = std::make_unique<TextPass>();
        for (std::size_t i = 0; i < channels.size(); ++i) {
            if (channels[i].elsewhere || !channels[i].warp || channels[i].drawing != WarpDrawing::kResampled)
                continue;
            make_flat_picture(i);
            warps.make_resampling();
        }
    } catch (const std::exception&) {
        // Left to draw(), which tries again and tells of it.
    }
}

void Renderer::Impl::draw_pattern(std::size_t channel) {
    if (!patterns) patterns = std::make_unique<PatternPass>(placement);
    gl::set_blend(gl::Blend::kReplace);
    patterns->draw(drawn(channel), pictures.view(channel), clip_from_enu(channel),
                   screens.distinct[screens.of_channel[channel]], channel);
}

void Renderer::Impl::write_texts(std::size_t channel) {
    if (!texts) texts = std::make_unique<TextPass>();
    texts->clear();
    const Channel& picture = channels[channel];
    write_pattern_text(*texts, picture, scene.views[channel]);
    // Patterns are as bright by night as by day.
    const double code = shows_pattern(channel) ? kDayTextCode : text_code(frame.adaptation_cd_m2());
    write_overlay(*texts, picture, scene.overlay, scene.views[channel].overlay, code);
    gl::set_blend(gl::Blend::kCoverage);
    texts->draw(picture.width_px, picture.height_px);
}

void Renderer::Impl::upload_dome() {
    const bool triangles =
        triangles_revision != frame.triangles_revision() || uploaded_edge_rad != longest_edge_rad;
    for (std::size_t screen = 0; screen < dome_meshes.size(); ++screen) {
        const auto dome = frame.dome().vertices(screen);
        const std::span<const float> vertices{reinterpret_cast<const float*>(dome.data()),
                                              dome.size_bytes() / sizeof(float)};
        if (triangles)
            dome_meshes[screen].set_triangles(frame.dome().indices(), vertices, longest_edge_rad);
        else if (vertices_revision != frame.vertices_revision())
            dome_meshes[screen].set_vertices(vertices);
    }
    uploaded_edge_rad = longest_edge_rad;
    triangles_revision = frame.triangles_revision();
    vertices_revision = frame.vertices_revision();
}

void Renderer::Impl::prepare_discs(std::size_t screen) {
    const Plan& plan = frame.plan();
    const shaders64::ToneParameters& tone = frame.tone(screen);
    const auto tone32 = eye::single_precision(tone);
    discs_screen = screen;
    if (plan.needs(Pass::kCorona)) corona.prepare(scene, frame, pixel_rad, tone32, plan.corona_share);
    if (plan.needs(Pass::kSunDisc)) sun_disc.prepare(scene, frame, pixel_rad, tone32, display.dither);
    if (plan.needs(Pass::kMoonDisc)) prepare_moon(screen);
    if (plan.needs(Pass::kSunGlare)) sun_glare.prepare(frame.sun_glare(screen), pixel_rad, display.dither);
    if (plan.needs(Pass::kMoonGlare)) moon_glare.prepare(frame.moon_glare(screen), pixel_rad, display.dither);
}

void Renderer::Impl::prepare_moon(std::size_t screen) {
    moon_disc.prepare(
        scene, frame, pixel_rad, eye::single_precision(frame.tone(screen)), display.dither,
        moon_fovea(scene, frame.air(), frame.light(), frame.display(screen), frame.tone(screen)),
        frame.moon_glare(screen).limb());
}

void Renderer::Impl::draw_dome(std::size_t index, const glm::dmat4& clip_from_enu) {
    const Channel& channel = drawn(index);
    const glm::dmat4 clip_from_mesh = clip_from_enu * frame.enu_from_mesh();
    const glm::dmat4 shown_from_mesh = shown_from_clip(index) * clip_from_mesh;
    dome_program.use();
    dome_program.set(dome_clip, glm::mat4{clip_from_mesh});
    dome_program.set(dome_half_size, 0.5F * glm::vec2{channel.width_px, channel.height_px});
    dome_program.set(dome_share, static_cast<float>(frame.dome().share()));
    const std::size_t screen = screens.of_channel[index];
    const auto sea_rows = static_cast<std::uint32_t>(frame.sea_rows());
    const bool clouded = frame.clouds().shown();
    const Marked plain = clouded ? Marked::kNo : Marked::kAll;
    for (const IndexRange& range : frame.dome().visible(shown_from_mesh, {.first = sea_rows}, plain))
        dome_meshes[screen].draw(range);
    if (sea_rows > 0) {
        sea.draw(channel, screen, eye::single_precision(frame.tone(screen)), clip_from_mesh,
                 frame.dome().visible(shown_from_mesh, {.end = sea_rows}));
    }
    if (clouded) draw_clouded_dome(index, clip_from_mesh, shown_from_mesh, sea_rows);
}

void Renderer::Impl::draw_clouded_dome(std::size_t index, const glm::dmat4& clip_from_mesh,
                                       const glm::dmat4& shown_from_mesh, std::uint32_t sea_rows) {
    const std::size_t screen = screens.of_channel[index];
    const auto draw_ranges = [&](std::span<const IndexRange> ranges) {
        for (const IndexRange& range : ranges)
            dome_meshes[screen].draw(range);
    };
    clouds->bind(screen);
    clouds->use_dome(drawn(index), clip_from_mesh, frame.enu_from_mesh(), frame.dome().share());
    gl::set_clip_distances(3);
    for (int i = 0; i < kOctants; ++i) {
        const Octant octant = octant_of(i, frame.enu_from_mesh());
        const auto ranges =
            frame.dome().visible(shown_from_mesh, octant.sides, {.first = sea_rows}, Marked::kYes);
        if (ranges.empty()) continue;
        clouds->take(octant);
        draw_ranges(ranges);
    }
    gl::set_clip_distances(0);
    if (sea_rows == 0) return;
    // Waves are drawn already.
    clouds->use_over(clip_from_mesh, frame.enu_from_mesh());
    gl::set_blend(gl::Blend::kOver);
    draw_ranges(frame.dome().visible(shown_from_mesh, {.end = sea_rows}, Marked::kYes));
    gl::set_blend(gl::Blend::kReplace);
}

void Renderer::Impl::prepare_clouds() {
    report.cloud_rays = 0;
    report.cloud_tiles = 0;
    if (!frame.clouds().shown()) return;
    if (!clouds) clouds = std::make_unique<CloudPass>(screens.distinct.size(), placement);
    clouds->prepare(frame.clouds(), display.dither);
    report.cloud_rays = frame.clouds().map().rays_marched() + frame.clouds().map().near_rays();
    report.cloud_tiles = frame.clouds().toned().size();
}

void Renderer::Impl::refresh_deferred() {
    deferred->prepare(frame.air_between(scene), frame.clouds(), frame.ground_shadow(), display.dither);
}

Renderer::Renderer(std::vector<Channel> channels, const DisplaySettings& display, const Quality& quality,
                   Target target) {
    if (channels.empty() || channels.size() > kMaxChannels) {
        throw std::runtime_error("a renderer draws 1 to " + std::to_string(kMaxChannels) + " channels, not " +
                                 std::to_string(channels.size()));
    }
    impl_ = std::make_unique<Impl>(std::move(channels), display, quality, target);
}

Renderer::~Renderer() = default;

void Renderer::draw_clouds(Clouds clouds) {
    impl_->frame.draw_clouds(std::move(clouds));
}

void Renderer::thin(Thinned thinned) noexcept {
    impl_->frame.thin(thinned);
}

const eye::Adaptation& Renderer::adaptation() const noexcept {
    return impl_->frame.adaptation();
}

void Renderer::adapt_as(const eye::Adaptation& eyes) noexcept {
    impl_->frame.adapt_as(eyes);
}

const FrameReport& Renderer::prepare(const Scene& scene) {
    Impl& m = *impl_;
    m.scene = scene;
    m.pictures.take(scene);
    m.pixel_rad = finest_pixel_rad(m.pictures.drawn(), m.pictures.views());
    m.frame.prepare(scene, m.pixel_rad, smallest_pixel_sr(m.pictures.drawn(), m.pictures.views()));
    m.longest_edge_rad = longest_direct_edge_rad(m.pictures.drawn(), m.pictures.views());
    m.upload_dome();
    m.prepare_clouds();
    if (m.frame.sea_rows() > 0) m.sea.prepare(m.frame, m.display.dither, m.longest_edge_rad);
    if (m.frame.light().milky_way.map != nullptr)
        m.milky_way.prepare(m.frame.milky_way(), m.frame.light(), m.display.dither, m.longest_edge_rad);
    m.report.stars_drawn = 0;
    if (m.frame.plan().needs(Pass::kStars)) {
        m.stars.prepare(scene, m.frame, m.pixel_rad);
        m.report.stars_drawn = m.stars.count();
    }
    if (m.frame.plan().needs(Pass::kPrecipitation))
        m.precipitation.prepare(scene, m.frame.light(), m.pixel_rad,
                                m.frame.plan().thins(Thin::kPrecipitation) ? kThinnedPrecipitation : 1.0);
    m.prepare_discs(0);
    if (m.deferred) m.refresh_deferred();
    m.cover.prepare(m.scene, m.frame);
    m.windscreens.prepare(scene);
    m.report.plan = m.frame.plan();
    plan_screens(m.report.plan, m.channels);
    m.report.adaptation_cd_m2 = m.frame.adaptation_cd_m2();
    m.report.gl_errors = m.log.errors();
    return m.report;
}

bool Renderer::Impl::shows(std::size_t channel) const noexcept {
    return channel < channels.size() && !channels[channel].elsewhere && channel < scene.view_count &&
           has_area(scene.views[channel].frustum);
}

glm::dmat4 Renderer::Impl::clip_from_enu(std::size_t channel) const noexcept {
    const ChannelView& view = pictures.view(channel);
    return clip_from_view(view.frustum) * glm::dmat4{view.view_from_enu};
}

void Renderer::Impl::draw_sky(std::size_t channel) {
    const Plan& plan = report.plan;
    const std::size_t screen = screens.of_channel[channel];
    const glm::dmat4 clip = clip_from_enu(channel);
    // Discs are prepared for one screen at a time: rigs of like screens pay for it once a frame.
    if (discs_screen != screen) prepare_discs(screen);
    gl::set_blend(gl::Blend::kReplace);
    draw_dome(channel, clip);
    gl::set_blend(gl::Blend::kAdd);
    if (frame.light().milky_way.map != nullptr)
        milky_way.draw(frame.milky_way(), drawn(channel), screen, clip, shown_from_clip(channel),
                       shown_clouds());
    if (plan.needs(Pass::kStars))
        stars.draw(drawn(channel), pictures.view(channel), tone32(channel), shown_clouds());
    if (plan.needs(Pass::kCorona)) corona.draw(glm::mat4{clip});
}

void Renderer::Impl::draw_discs(std::size_t channel) {
    const glm::mat4 clip{clip_from_enu(channel)};
    gl::set_blend(gl::Blend::kCoverage);
    if (report.plan.needs(Pass::kSunDisc)) sun_disc.draw(clip);
    if (report.plan.needs(Pass::kMoonDisc)) moon_disc.draw(clip);
}

void Renderer::draw(std::size_t channel) {
    Impl& m = *impl_;
    if (!m.shows(channel)) return;
    m.begin(channel, m.channels[channel].drawing == WarpDrawing::kResampled);
    if (m.shows_pattern(channel))
        m.draw_pattern(channel);
    else
        m.draw_world(channel);
    m.finish(channel);
}

void Renderer::make_ready() noexcept {
    impl_->make_ready();
}

std::uint64_t Renderer::gl_errors() {
    return impl_->log.errors();
}

void Renderer::cross_out(std::size_t channel) {
    impl_->pictures.cross_out(channel);
    gl::finish();
}

void Renderer::Impl::draw_world(std::size_t channel) {
    const glm::mat4 clip{clip_from_enu(channel)};
    draw_sky(channel);
    if (report.plan.needs(Pass::kMoonGlare)) moon_glare.draw(clip);
    draw_discs(channel);
    if (report.plan.needs(Pass::kPrecipitation)) precipitation.draw(pictures.view(channel), tone32(channel));
    gl::set_blend(gl::Blend::kAdd);
    // Over the Moon too, when it stands before the Sun.
    if (report.plan.needs(Pass::kSunGlare)) sun_glare.draw_around(clip);
}

void Renderer::draw_scene(std::size_t channel, const DeferredInput& input) {
    Impl& m = *impl_;
    if (!m.shows(channel)) return;
    if (!(input.far_m > 0.0) || m.shows_pattern(channel)) {
        draw(channel);
        return;
    }
    if (!m.deferred) {
        m.deferred = std::make_unique<DeferredPass>();
        m.frame.serve_things();
        m.prepare_clouds();
        m.refresh_deferred();
    }
    const ChannelView& view = m.pictures.view(channel);
    gl::set_blend(gl::Blend::kReplace);
    const DeferredInput covered = m.cover.covered(
        channel, m.channels[channel].warp ? m.flat_channels[channel] : m.pictures.drawn(channel), view,
        input);
    m.begin(channel, true);
    m.draw_sky(channel);
    m.draw_discs(channel);
    gl::set_blend(gl::Blend::kReplace);
    m.deferred->draw(view, covered, m.tone32(channel));
    gl::set_blend(gl::Blend::kCoverage);
    m.cover.draw_film(m.drawn(channel), view, m.tone32(channel), input);
    if (m.report.plan.needs(Pass::kPrecipitation)) {
        m.precipitation.draw_before(view, m.tone32(channel), input);
    }
    // Glare is in the eye: before things too.
    const glm::mat4 clip{m.clip_from_enu(channel)};
    gl::set_blend(gl::Blend::kAdd);
    if (m.report.plan.needs(Pass::kMoonGlare)) m.moon_glare.draw_around(clip);
    if (m.report.plan.needs(Pass::kSunGlare)) m.sun_glare.draw_around(clip);
    m.finish(channel);
}

std::optional<precipitation::ExposureView> Renderer::exposure_view() const noexcept {
    if (!impl_->report.plan.needs(Pass::kExposure)) return std::nullopt;
    return precipitation::exposure_view(impl_->scene);
}

unsigned Renderer::texture(std::size_t channel) const noexcept {
    return impl_->pictures.texture(channel);
}

void Renderer::read_back(std::size_t channel, std::span<std::byte> rgba) {
    impl_->pictures.read_back(channel, rgba);
}

void Renderer::read_luminance(std::size_t channel, std::span<float> rgb_cd_m2) {
    impl_->pictures.read_light(channel, rgb_cd_m2);
    const auto unit_cd_m2 = static_cast<float>(std::exp2(-impl_->frame.exposure_exponent()));
    for (float& value : rgb_cd_m2)
        value *= unit_cd_m2;
}

std::span<const Channel> Renderer::channels() const noexcept {
    return impl_->channels;
}

glm::dvec3 Renderer::reference_colour(const glm::dvec3& direction_enu, std::size_t channel) const {
    return impl_->frame.exact_colour(direction_enu, impl_->screens.of_channel[channel]);
}

glm::dvec3 Renderer::reference_colour(const glm::dvec3& direction_enu, double distance_m,
                                      const glm::dvec3& rgb_cd_m2) const {
    const shaders64::ToneParameters& tone = impl_->frame.tone();
    const DeferredAir* air = impl_->frame.air_between();
    if (air == nullptr) return shaders64::shown(rgb_cd_m2, tone);
    const glm::dvec3 lit_cd_m2 =
        rgb_cd_m2 * impl_->frame.ground_shadow().on_thing(direction_enu * distance_m);
    const glm::dvec3 seen_cd_m2 = air->under_air(lit_cd_m2, direction_enu, distance_m);
    return shaders64::shown(impl_->frame.clouds().before_thing(*air, seen_cd_m2, direction_enu, distance_m),
                            tone);
}

}  // namespace skyig::render
