#include "server/rig/leader.h"

#include <algorithm>
#include <utility>

#include "server/rig/seal.h"

namespace skyig::server::rig {

Leader::Leader(LeaderSettings settings, const Key& key, const FrameCoder& coder, Link& link,
               const Clock& clock, Log& log)
    : settings_(std::move(settings)), key_(key), coder_(coder), link_(link), clock_(clock), log_(log) {
    for (const std::string& name : settings_.nodes) {
        members_.emplace_back();
        members_.back().name = name;
    }
    frame_message_.from = settings_.self;
    frame_message_.rank = settings_.rank;
    frame_message_.state.reserve(kMostStateBytes);
    show_message_.node = settings_.self.node;
    show_message_.session = settings_.self.session;
}

void Leader::listen() {
    while (link_.take(node_message_)) {
        if (is_sealed(key_, node_message_)) {
            take(node_message_);
            continue;
        }
        ++counts_.unsealed;
        log_.limited("rig node unsealed", kRepeatAfter_s, Severity::kWarning,
                     "word of {} that does not bear the rig's key: not heard",
                     node_message_.from.node.substr(0, kMostNameBytes));
    }
}

void Leader::take(const NodeMessage& message) {
    const auto found = std::find_if(members_.begin(), members_.end(), [&message](const Member& member) {
        return member.name == message.from.node;
    });
    // Of two of one name the later one; a node whose clock has gone back is heard once its former run is
    // silent.
    if (found == members_.end() || (found->here && message.from.session < found->session)) {
        ++counts_.strangers;
        return;
    }
    Member& member = *found;
    const std::int64_t now_ns = clock_.monotonic_ns();
    const bool new_run = message.from.session != member.session;
    if (!member.here || new_run) {
        log_.notice("node {} is {}: {}, {}", member.name, member.session == 0 ? "there" : "back",
                    message.from.build, message.gl.empty() ? "no word of what draws" : message.gl);
    }
    member.here = true;
    member.heard_ns = now_ns;
    member.session = message.from.session;
    if (new_run) member.drawn_frame = 0;
    member.build = message.from.build;
    member.settings = message.from.settings;
    member.gl = message.gl;
    member.gl_errors = message.gl_errors;
    member.repeats = message.repeats;
    member.late = message.late;
    member.drawing_ns = message.drawing_ns;
    if (member.build != settings_.self.build || member.settings != settings_.self.settings) {
        refuse(member);
        return;
    }
    const bool ours =
        message.leader == settings_.self.node && message.leader_session == settings_.self.session;
    const bool followed = member.state == NodeState::kFollows;
    member.state = ours || message.state == NodeState::kLeads ? message.state : NodeState::kJoins;
    if (!ours) return;
    if (!followed && member.state == NodeState::kFollows)
        log_.notice("node {} draws from frame {} on", member.name, message.drawn_frame);
    if (message.drawn_frame != member.drawn_frame && message.drawn_frame == finished_frame_)
        member.waited_ns = std::max<std::int64_t>(now_ns - finished_ns_, 0);
    member.drawn_frame = message.drawn_frame;
}

void Leader::refuse(Member& member) {
    member.state = NodeState::kRefuses;
    log_.limited(
        "rig node refused", kRepeatAfter_s, Severity::kError,
        "node {} is {} with settings {:016x}; this is {} with settings {:016x}: it is not waited for",
        member.name, member.build, member.settings, settings_.self.build, settings_.self.settings);
}

bool Leader::all_here() const noexcept {
    return std::all_of(members_.begin(), members_.end(), [](const Member& member) { return member.here; });
}

void Leader::tell(const FrameState& state) {
    frame_message_.frame = state.scene.frame_number;
    frame_message_.state.resize(kMostStateBytes);
    const std::size_t size = coder_.encode(state, frame_message_.state);
    if (size == 0) {
        ++counts_.too_large;
        log_.limited(
            "rig too large", kRepeatAfter_s, Severity::kError,
            "frame {} holds more than {} bytes, or a picture of cloud that the settings did not have at the "
            "start: the nodes do not draw it",
            frame_message_.frame, kMostStateBytes);
        return;
    }
    frame_message_.state.resize(size);
    seal(key_, frame_message_);
    link_.send(frame_message_);
    ++counts_.frames;
    counts_.bytes += size;
}

bool Leader::is_awaited(const Member& member, std::uint64_t frame) const noexcept {
    if (!member.here || member.drawn_frame >= frame) return false;
    if (member.state == NodeState::kFollows) return true;
    return settings_.waits_for_all && member.state == NodeState::kJoins;
}

std::int64_t Leader::await(std::uint64_t frame) {
    finished_ns_ = clock_.monotonic_ns();
    finished_frame_ = frame;
    const std::int64_t end_ns = finished_ns_ + settings_.wait_ns;
    const auto awaited = [this, frame](const Member& member) { return is_awaited(member, frame); };
    listen();
    for (;;) {
        miss_silent_ones();
        if (std::none_of(members_.begin(), members_.end(), awaited)) break;
        const std::int64_t left_ns = end_ns - clock_.monotonic_ns();
        if (left_ns <= 0) break;
        link_.wait(left_ns);
        listen();
    }
    bool complete = true;
    for (Member& member : members_) {
        if (!awaited(member)) continue;
        complete = false;
        ++member.left_out;
        member.waited_ns = clock_.monotonic_ns() - finished_ns_;
        log_.limited({"rig late", static_cast<std::size_t>(&member - members_.data())}, kRepeatAfter_s,
                     Severity::kWarning, "frame {} is shown without node {}: it has drawn {} ({} so far)",
                     frame, member.name, member.drawn_frame, member.left_out);
    }
    if (!complete) ++counts_.incomplete;
    const std::int64_t waited_ns = clock_.monotonic_ns() - finished_ns_;
    waits_.add(waited_ns);
    return waited_ns;
}

void Leader::miss_silent_ones() {
    const std::int64_t now_ns = clock_.monotonic_ns();
    for (Member& member : members_) {
        if (!member.here || now_ns - member.heard_ns <= settings_.lost_after_ns) continue;
        member.here = false;
        member.state = NodeState::kJoins;
        ++member.losses;
        log_.warning("node {} is lost: silent for {:.1f} s, at frame {}", member.name,
                     static_cast<double>(now_ns - member.heard_ns) * 1e-9, member.drawn_frame);
    }
}

void Leader::tell_show(std::uint64_t frame) {
    show_message_.frame = frame;
    seal(key_, show_message_);
    link_.send(show_message_);
}

}  // namespace skyig::server::rig
