#include "server/lock_step.h"

#include <cmath>

namespace skyig::server {

bool LockStep::answered(const Inbox& inbox, const world::World& world) const noexcept {
    const std::uint32_t echo = inbox.last_echo();
    if (echo == 0) return settings_.host_frames_behind > 0 || !inbox.frame_arrivals().host().empty();
    // Frame numbers wrap.
    const auto behind = static_cast<std::int32_t>(world.session().ig_frame_number() - echo);
    return behind <= settings_.host_frames_behind;
}

void LockStep::await(const Clock& clock, Wire& wire, Inbox& inbox, const world::World& world) {
    if (settings_.pacing != config::Pacing::kHost) return;
    const std::int64_t end_ns = clock.monotonic_ns() + std::llround(settings_.host_wait_s() * 1e9);
    while (world.control_link().state == world::LinkState::kLive && !answered(inbox, world)) {
        const std::int64_t left_ns = end_ns - clock.monotonic_ns();
        if (left_ns <= 0 || !wire.wait(world.control_source(), left_ns)) {
            ++timeouts_;
            return;
        }
        wire.drain(inbox);
    }
}

}  // namespace skyig::server
