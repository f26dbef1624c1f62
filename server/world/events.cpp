#include "server/world/events.h"

namespace skyig::server::world {

bool Events::enable(std::uint16_t event_id, bool enable) noexcept {
    if (event_id == 0 || event_id >= enabled_.size()) return false;
    enabled_[event_id] = enable;
    return true;
}

bool Events::raise(Event event, std::uint32_t data_1, std::uint32_t data_2, std::uint32_t data_3) noexcept {
    const auto id = static_cast<std::uint16_t>(event);
    if (!enabled_[id]) return true;
    if (count_ == kMostWaiting) return false;
    waiting_[(first_ + count_++) % kMostWaiting] = {id, data_1, data_2, data_3};
    return true;
}

void Events::pop() noexcept {
    if (count_ == 0) return;
    first_ = (first_ + 1) % kMostWaiting;
    --count_;
}

void Events::clear() noexcept {
    *this = {};
}

}  // namespace skyig::server::world
