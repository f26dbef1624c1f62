#include "protocol/canaerospace/channel_choice.h"

#include "protocol/canaerospace/sequence.h"

namespace skyig::protocol::canaerospace {

void ChannelChoice::take(std::uint16_t channel, std::int64_t received_ns) noexcept {
    heard_ = true;
    channel_ = channel;
    last_ns_ = received_ns;
    if (candidate_ == channel) candidate_heard_ = false;
}

ChannelStep ChannelChoice::hear(std::uint16_t channel, std::int64_t received_ns, std::int64_t silent_after_ns,
                                std::int64_t return_after_ns) noexcept {
    if (!heard_ || channel == channel_) {
        const ChannelStep step = heard_ ? ChannelStep::kUsed : ChannelStep::kFirst;
        take(channel, received_ns);
        return step;
    }
    if (elapsed_ns(last_ns_, received_ns) > silent_after_ns) {
        candidate_heard_ = false;
        take(channel, received_ns);
        return ChannelStep::kFellOver;
    }
    if (channel > channel_) return ChannelStep::kIdle;
    const bool candidate_silent =
        !candidate_heard_ || elapsed_ns(candidate_last_ns_, received_ns) > silent_after_ns;
    if (channel > candidate_ && !candidate_silent) return ChannelStep::kIdle;
    if (channel != candidate_ || candidate_silent) candidate_since_ns_ = received_ns;
    candidate_heard_ = true;
    candidate_ = channel;
    candidate_last_ns_ = received_ns;
    if (elapsed_ns(candidate_since_ns_, received_ns) < return_after_ns) return ChannelStep::kIdle;
    take(channel, received_ns);
    return ChannelStep::kReturned;
}

}  // namespace skyig::protocol::canaerospace
