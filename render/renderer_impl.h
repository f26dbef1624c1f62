// What the renderer holds: passes, pictures, the frame in hand. For the renderer's own sources.
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "render/blend_pass.h"
#include "render/channel_pictures.h"
#include "render/cloud_pass.h"
#include "render/deferred_pass.h"
#include "render/discs.h"
#include "render/eye/tone_curve.h"
#include "render/gl/debug_log.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/glare_pass.h"
#include "render/milky_way_pass.h"
#include "render/overlay/overlay_text.h"
#include "render/overlay/text_pass.h"
#include "render/pattern/pattern_text.h"
#include "render/pattern_pass.h"
#include "render/precipitation_pass.h"
#include "render/refined_mesh.h"
#include "render/renderer.h"
#include "render/screens.h"
#include "render/sea_pass.h"
#include "render/sky_frame.h"
#include "render/star_pass.h"
#include "render/thing_cover.h"
#include "render/warp_pass.h"
#include "render/windscreen_pass.h"

namespace skyig::render {

inline gl::PixelFormat pixel_format(Target target) {
    switch (target) {
        case Target::kLuminance:
            return gl::PixelFormat::kRgba32F;
        case Target::kHalfLuminance:
            return gl::PixelFormat::kRgba16F;
        case Target::kDisplay:
            break;
    }
    return gl::PixelFormat::kRgba8;
}

struct Renderer::Impl {
    Impl(std::vector<Channel> channel_list, const DisplaySettings& display_settings, const Quality& quality,
         Target target)
        : channels(std::move(channel_list)),
          display(display_settings),
          pixels_hold(target),
          screens(screens_of(channels, display_settings)),
          pictures(channels, pixel_format(target)),
          shows_screen(target == Target::kDisplay),
          target_format(pixel_format(target)),
          flat_pictures(channels.size()),
          blend(channels, display_settings.dither),
          frame(display_settings, quality, screens.distinct, target) {
        display.dither = display.dither && target == Target::kDisplay;
        for (const Channel& channel : channels)
            flat_channels.push_back(flat_picture_of(channel));
        for (std::size_t i = 0; i < screens.distinct.size(); ++i)
            dome_meshes.emplace_back(std::initializer_list<int>{3, 3, 3}, Dome::kMaxVertices,
                                     placement == gl::Placement::kWarped);
        dome_program.set(dome_program.uniform("u_dither_codes"), display.dither ? 1.0F : 0.0F);
        gl::set_common_state();
    }

    void begin(std::size_t channel, bool flat);
    void finish(std::size_t channel);
    /// What the channel that is begun draws into.
    [[nodiscard]] const Channel& drawn(std::size_t channel) const noexcept {
        return draws_flat ? flat_channels[channel] : pictures.drawn(channel);
    }
    [[nodiscard]] glm::dmat4 shown_from_clip(std::size_t channel) const noexcept {
        return draws_flat ? glm::dmat4{1.0} : warps.shown_from_clip(channel);
    }
    [[nodiscard]] bool shows_pattern(std::size_t channel) const noexcept {
        return shows_screen && scene.views[channel].pattern != Pattern::kOff;
    }
    void draw_pattern(std::size_t channel);
    void write_texts(std::size_t channel);
    void upload_dome();
    void prepare_discs(std::size_t screen);
    void prepare_moon(std::size_t screen);
    void draw_dome(std::size_t channel, const glm::dmat4& clip_from_enu);
    void draw_clouded_dome(std::size_t channel, const glm::dmat4& clip_from_mesh,
                           const glm::dmat4& shown_from_mesh, std::uint32_t sea_rows);
    void prepare_clouds();
    [[nodiscard]] const CloudPass* shown_clouds() const noexcept {
        return frame.clouds().shown() ? clouds.get() : nullptr;
    }
    void refresh_deferred();
    [[nodiscard]] bool shows(std::size_t channel) const noexcept;
    [[nodiscard]] glm::dmat4 clip_from_enu(std::size_t channel) const noexcept;
    [[nodiscard]] shaders32::ToneParameters tone32(std::size_t channel) const {
        return eye::single_precision(frame.tone(screens.of_channel[channel]));
    }
    void make_ready() noexcept;
    void make_flat_picture(std::size_t channel);
    void draw_world(std::size_t channel);
    void draw_sky(std::size_t channel);
    void draw_discs(std::size_t channel);

    std::vector<Channel> channels;
    DisplaySettings display;
    Target pixels_hold;
    Screens screens;
    gl::DebugLog log;
    ChannelPictures pictures;
    bool shows_screen;  // else light itself
    gl::PixelFormat target_format;
    std::vector<Channel> flat_channels;
    std::vector<std::optional<gl::Framebuffer>> flat_pictures;  // once one is resampled
    gl::Placement placement = placement_of(channels);
    WarpPass warps{channels};
    BlendPass blend;
    gl::Program dome_program{"sky/dome.vert", "sky/dome.frag", placement};
    int dome_clip = dome_program.uniform("u_clip_from_mesh");
    int dome_half_size = dome_program.uniform("u_half_size_px");
    int dome_share = dome_program.uniform("u_share");
    std::vector<RefinedMesh> dome_meshes;  // one a screen
    std::uint64_t triangles_revision = 0;
    std::uint64_t vertices_revision = 0;
    std::unique_ptr<CloudPass> clouds;  // once there are any
    SeaPass sea{screens.distinct.size(), placement};
    MilkyWayPass milky_way{screens.distinct.size(), placement};
    StarPass stars{placement};
    Corona corona{placement};
    SunDisc sun_disc{placement};
    MoonDisc moon_disc{placement};
    PrecipitationPass precipitation{placement};
    GlarePass sun_glare{placement};
    GlarePass moon_glare{placement};
    std::unique_ptr<DeferredPass> deferred;  // once a scene is drawn
    ThingCover cover{channels.size()};
    WindscreenPass windscreens{channels.size()};
    std::unique_ptr<PatternPass> patterns;  // once one is shown
    std::unique_ptr<TextPass> texts;        // once there are any

    // The frame in hand.
    SkyFrame frame;
    Scene scene;
    double pixel_rad = 1e-3;
    double longest_edge_rad = std::numbers::pi;  // of a triangle in the rig's warped channels
    double uploaded_edge_rad = 0.0;
    bool draws_flat = false;
    std::size_t discs_screen = 0;  // what discs are prepared for
    FrameReport report;
};

}  // namespace skyig::render
