#include "protocol/canaerospace/sequence.h"

#include <algorithm>
#include <cassert>

namespace skyig::protocol::canaerospace {
namespace {

constexpr unsigned kFirstOlderStep = 128;

void start(Stream& stream, std::uint8_t message_code, std::int64_t received_ns) noexcept {
    stream.used = true;
    stream.unchecked = false;
    stream.message_code = message_code;
    stream.equal_codes = 1;
    stream.accepted_ns = received_ns;
}

/// Counts the run of equal codes; true when it has just become long enough.
bool extends_run(Stream& stream, bool equal, bool distinct_time) noexcept {
    if (!equal) stream.equal_codes = 0;
    if (!equal || !distinct_time || stream.equal_codes == 0) return false;
    stream.equal_codes = static_cast<std::uint8_t>(stream.equal_codes + 1);
    return stream.equal_codes == kConstantCodeFrames;
}

}  // namespace

CodeVerdict judge_code(Stream& stream, std::uint8_t message_code, bool may_repeat, std::int64_t received_ns,
                       std::int64_t timeout_ns) noexcept {
    const bool distinct_time = received_ns != stream.seen_ns;
    stream.seen_ns = received_ns;
    CodeVerdict verdict;
    if (!stream.used) {
        start(stream, message_code, received_ns);
        return verdict;
    }
    const unsigned step = static_cast<std::uint8_t>(message_code - stream.message_code);
    if (stream.unchecked && step == 0) {
        stream.accepted_ns = received_ns;
        return verdict;
    }
    // A sender that counts after all is a new one.
    if (stream.unchecked || elapsed_ns(stream.accepted_ns, received_ns) > timeout_ns) {
        start(stream, message_code, received_ns);
        verdict.restarted = true;
        return verdict;
    }
    if (extends_run(stream, step == 0, distinct_time)) {
        stream.unchecked = true;
        stream.accepted_ns = received_ns;
        verdict.became_unchecked = true;
        return verdict;
    }
    if (step == 0 && !may_repeat) {
        verdict.reason = Reason::kDuplicate;
        return verdict;
    }
    if (step >= kFirstOlderStep) {
        verdict.reason = Reason::kOlder;
        return verdict;
    }
    verdict.lost = static_cast<std::uint8_t>(step > 1 ? step - 1 : 0);
    stream.message_code = message_code;
    stream.accepted_ns = received_ns;
    return verdict;
}

StreamTable::StreamTable(std::size_t sets) : streams_(sets * kWays), sets_(sets) {
    assert(sets > 0 && (sets & (sets - 1)) == 0);
}

Stream& StreamTable::find(StreamKey key) noexcept {
    const std::size_t set = (key.value * 0x9E37'79B1U >> 16) & (sets_ - 1);
    const auto first = streams_.begin() + static_cast<std::ptrdiff_t>(set * kWays);
    const auto last = first + kWays;
    const auto found =
        std::find_if(first, last, [key](const Stream& each) { return each.used && each.key == key; });
    if (found != last) return *found;
    const auto place = std::min_element(first, last, [](const Stream& a, const Stream& b) {
        return a.used == b.used ? a.seen_ns < b.seen_ns : !a.used;
    });
    if (place->used) ++evicted_;
    *place = {};
    place->key = key;
    return *place;
}

}  // namespace skyig::protocol::canaerospace
