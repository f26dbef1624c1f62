// Executes the plan of a frame: shared, direction-dependent work once, then each channel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/channel.h"
#include "render/clouds.h"
#include "render/deferred.h"
#include "render/display.h"
#include "render/eye/adaptation.h"
#include "render/plan.h"
#include "render/precipitation/exposure.h"
#include "render/scene.h"
#include "render/target.h"

namespace skyig::render {

/// What a frame did; valid until the next prepare().
struct FrameReport {
    Plan plan;
    /// The one luminance that all channels of this frame are adapted to, cd/m2.
    double adaptation_cd_m2 = 0.0;
    std::size_t stars_drawn = 0;
    /// Through clouds, for the cloud maps of this frame, and tiles that were toned.
    int cloud_rays = 0;
    std::size_t cloud_tiles = 0;
    /// GL errors since start-up (debug output of type error).
    std::uint64_t gl_errors = 0;
};

/// Needs a current OpenGL 4.5 core context for its whole life, always on the same thread.
/// A frame is: prepare(scene), then draw(i) and, if wanted, read_back(i) for each channel.
class Renderer {
  public:
    /// \throws std::runtime_error with the GL text when a program cannot be made or no channel's framebuffer
    /// (where only some cannot, draw() of those throws), or when there are no channels or more than
    /// kMaxChannels.
    /// \param target  what the pixels hold; the adaptation is that of eyes before `display` for all
    Renderer(std::vector<Channel> channels, const DisplaySettings& display, const Quality& quality = {},
             Target target = Target::kDisplay);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// From the next frame on the scene's weather has clouds.
    void draw_clouds(Clouds clouds);

    /// Makes now what a view may want in a later frame, so that none is held up by it: the passes of patterns
    /// and texts, and of channels that are resampled. What cannot be made is left to draw().
    void make_ready() noexcept;

    /// What frames leave out from the next one on. \see render::thinnable()
    void thin(Thinned thinned) noexcept;

    /// The eyes' state after the last frame; what a renderer made after a reset of the device goes on from.
    [[nodiscard]] const eye::Adaptation& adaptation() const noexcept;
    /// The next prepare() goes on from `eyes`, as they stood before that frame.
    void adapt_as(const eye::Adaptation& eyes) noexcept;

    /// All work that the channels share. Channels beyond `scene.view_count` and those whose frustum has no
    /// area keep their last picture (black at first). Allocates nothing in steady state. The first call
    /// builds all tables and may throw std::bad_alloc; later ones do not throw.
    const FrameReport& prepare(const Scene& scene);

    /// Draws one channel of the prepared frame, or the test pattern that its view asks for, with its texts;
    /// returns when the pixels are finished. Patterns and texts are for displays: targets of luminance show
    /// none.
    /// \throws std::runtime_error, std::bad_alloc when what a view needs for the first time cannot be made:
    /// its picture if that failed in the constructor, a mirrored view's canvas, the pass of patterns or
    /// texts. All else of the renderer stays good, and the next call tries again.
    void draw(std::size_t channel);

    /// As in the report, and of what was drawn since: errors in a channel's draw() are those of its picture.
    [[nodiscard]] std::uint64_t gl_errors();

    /// Makes a channel's picture the one that says that it could not be drawn: a red cross. Needs no program
    /// and nothing of the frame.
    void cross_out(std::size_t channel);

    /// The same with another renderer's picture of that channel, under this frame's air and tone curve; where
    /// the channel is warped, of its flat picture, render_scale times its size, which is resampled. The
    /// first call allocates and builds the table of the air between (some 40 ms), from then on prepare()
    /// keeps it; it may throw like the constructor. Ridges stand where a straight ray sees them.
    void draw_scene(std::size_t channel, const DeferredInput& input);

    /// Through what another renderer should draw what keeps rain and snow off in the prepared frame, for
    /// draw_scene(); none while nothing lies on the land.
    [[nodiscard]] std::optional<precipitation::ExposureView> exposure_view() const noexcept;

    /// The GL name of a channel's picture, its bottom row first; complete after draw(). 0 for a channel that
    /// is not there or has no picture.
    [[nodiscard]] unsigned texture(std::size_t channel) const noexcept;

    /// Copies a channel's pixels: RGBA, 8 bits, top row first, width * height * 4 bytes. Red if the channel
    /// has no picture.
    void read_back(std::size_t channel, std::span<std::byte> rgba);

    /// Copies the light of a channel's pixels: linear Rec.709, cd/m2, top row first, width * height * 3
    /// floats. Colours outside Rec.709 have negative components. Only of a renderer whose target is
    /// luminance.
    void read_luminance(std::size_t channel, std::span<float> rgb_cd_m2);

    [[nodiscard]] std::span<const Channel> channels() const noexcept;

    /// The colour, encoded for the display and before dither, that the same functions give for one
    /// direction of view (discs, their glare and stars left out): what the tests hold the drawn pixels
    /// against.
    [[nodiscard]] glm::dvec3 reference_colour(const glm::dvec3& direction_enu, std::size_t channel = 0) const;
    /// The same of a thing, given by its own light, in the first channel; after a draw_scene().
    [[nodiscard]] glm::dvec3 reference_colour(const glm::dvec3& direction_enu, double distance_m,
                                              const glm::dvec3& rgb_cd_m2) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace skyig::render
