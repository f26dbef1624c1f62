// What the frame loop needs of whoever turns scenes into pictures; tests give it one without GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "render/eye/adaptation.h"
#include "render/quality.h"
#include "render/scene.h"
#include "server/status/channel_health.h"
#include "server/status/pass_state.h"
#include "server/status/rig_state.h"

namespace skyig::server {

class Painter {
  public:
    Painter() = default;
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;
    Painter(Painter&&) = delete;
    Painter& operator=(Painter&&) = delete;
    virtual ~Painter() = default;

    /// What frames leave out from the next one on.
    virtual void thin(render::Thinned /*thinned*/) {}
    /// What would make the next frame cheaper.
    [[nodiscard]] virtual render::Thinned thinnable() const { return {}; }
    /// Before prepare(): where another machine says what is drawn, the scene becomes that of its newest
    /// frame.
    virtual void settle(render::Scene& /*scene*/) {}
    /// The eyes' state after the last frame, and how another machine's stand before the next.
    [[nodiscard]] virtual render::eye::Adaptation eyes() const { return {}; }
    virtual void adapt_as(const render::eye::Adaptation& /*eyes*/) {}
    /// The work that all channels of this frame share. Never throws, allocates nothing in steady state.
    virtual void prepare(const render::Scene& scene) = 0;
    /// Whether the channel is this machine's to draw.
    [[nodiscard]] virtual bool draws(std::size_t /*channel*/) const { return true; }
    /// Draws one channel of the prepared frame; its pixels are finished on return. One that cannot be drawn
    /// shows that it could not, is told of by health(), and leaves the others as they are. Never throws.
    virtual void draw(std::size_t channel) = 0;
    /// The drawn channels go where people see them. \return false once nobody wants to see them any more
    virtual bool present() { return true; }
    /// Whether the last present() did that: a machine that is late keeps the picture before.
    [[nodiscard]] virtual bool showed() const { return true; }
    /// Whether nobody sees the channel, since its window's monitor is gone; it comes back with that.
    [[nodiscard]] virtual bool hides(std::size_t /*channel*/) const { return false; }
    /// RGBA, top row first, width * height * 4 bytes.
    virtual void read_back(std::size_t channel, std::span<std::byte> rgba) = 0;

    /// Whether the last prepare() built tables anew.
    [[nodiscard]] virtual bool rebuilt() const { return false; }
    /// Whether pictures are drawn by the processor alone, so that its time bounds theirs.
    [[nodiscard]] virtual bool on_processor() const { return false; }
    /// GL objects that there are now; may take a millisecond.
    [[nodiscard]] virtual std::size_t gl_objects() const { return 0; }
    /// GL errors since start-up, as of the last prepare().
    [[nodiscard]] virtual std::uint64_t gl_errors() const = 0;
    /// How often the graphics device was lost and all was made anew on it.
    [[nodiscard]] virtual std::uint64_t resets() const { return 0; }
    [[nodiscard]] virtual status::ChannelHealth health(std::size_t /*channel*/) const { return {}; }
    /// Of several machines that draw together; left as it is where this one is alone.
    virtual void rig(status::RigState& /*state*/) const {}
    /// One luminance that all channels of the last frame are adapted to, cd/m2.
    [[nodiscard]] virtual double adaptation_cd_m2() const = 0;
    /// The plan of the last frame into `rows`, as many as there is room for. \return how many
    [[nodiscard]] virtual std::size_t passes(std::span<status::PassState> rows) const = 0;
    /// What draws, for people: "4.5 (Core Profile) Mesa 22.3.6, llvmpipe ...".
    [[nodiscard]] virtual std::string description() const = 0;
};

}  // namespace skyig::server
