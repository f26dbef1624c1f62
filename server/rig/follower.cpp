#include "server/rig/follower.h"

#include <algorithm>
#include <utility>

#include "server/rig/seal.h"

namespace skyig::server::rig {

Follower::Follower(FollowerSettings settings, const Key& key, const FrameCoder& coder, Link& link,
                   const Clock& clock, Log& log)
    : settings_(std::move(settings)),
      key_(key),
      coder_(coder),
      link_(link),
      clock_(clock),
      log_(log),
      heard_(settings_.leaders.size()),
      heard_ns_(clock.monotonic_ns()),
      frames_(kMostWaiting) {
    frame_message_.state.reserve(kMostStateBytes);
    own_.from = settings_.self;
}

void Follower::listen() {
    while (link_.take(frame_message_))
        take(frame_message_);
    while (link_.take(show_message_)) {
        if (!is_sealed(key_, show_message_)) {
            ++counts_.unsealed;
            continue;
        }
        if (show_message_.node != leader_.node || show_message_.session != leader_.session) continue;
        heard_ns_ = clock_.monotonic_ns();
        told_frame_ = std::max(told_frame_, show_message_.frame);
    }
    // A leader's to hear; what lies there would wake every wait.
    while (link_.take(node_message_)) {
    }
}

void Follower::take(const FrameMessage& message) {
    if (!is_sealed(key_, message)) {
        ++counts_.unsealed;
        log_.limited("rig unsealed", kRepeatAfter_s, Severity::kWarning,
                     "a frame from {} that does not bear the rig's key: not drawn",
                     message.from.node.substr(0, kMostNameBytes));
        return;
    }
    if (!obeys(message)) return;
    if (message.from != leader_) follow(message);
    heard_ns_ = clock_.monotonic_ns();
    if (waiting_ == kMostWaiting) {
        first_ = (first_ + 1) % kMostWaiting;
        --waiting_;
        ++counts_.missed;
    }
    FrameState& state = frames_[(first_ + waiting_) % kMostWaiting];
    if (!coder_.decode(message.state, state) || state.scene.frame_number != message.frame) {
        ++counts_.unreadable;
        log_.limited("rig unreadable", kRepeatAfter_s, Severity::kWarning,
                     "frame {} of {} cannot be read: not drawn", message.frame, leader_.node);
        return;
    }
    if (any_frame_) counts_.missed += message.frame - last_frame_ - 1;
    // A leader goes on only from what it has shown.
    if (message.frame > 0) told_frame_ = std::max(told_frame_, message.frame - 1);
    last_frame_ = message.frame;
    any_frame_ = true;
    ++waiting_;
}

bool Follower::obeys(const FrameMessage& message) {
    const std::vector<std::string>& may = settings_.leaders;
    if (std::find(may.begin(), may.end(), message.from.node) == may.end() ||
        message.from.node == settings_.self.node) {
        ++counts_.strangers;
        log_.limited("rig stranger", kRepeatAfter_s, Severity::kWarning,
                     "{} leads, but the settings do not name it as leader or stand-in", message.from.node);
        return false;
    }
    const Speaker& self = settings_.self;
    if (message.from.build != self.build || message.from.settings != self.settings) {
        ++counts_.refused;
        log_.limited(
            "rig refused", kRepeatAfter_s, Severity::kError,
            "{} leads with {} and settings {:016x}; this is {} with settings {:016x}: its frames are "
            "not drawn",
            message.from.node, message.from.build, message.from.settings, self.build, self.settings);
        refuses_ = true;
        return false;
    }
    if (!is_news(message)) return false;
    if (message.from.node == leader_.node) return true;
    const bool free = !has_leader() || silent_ns() > settings_.lost_after_ns / 2;
    if (message.rank < least_rank_ || (!free && message.rank <= leader_rank_)) {
        ++counts_.outranked;
        return false;
    }
    return true;
}

bool Follower::is_news(const FrameMessage& message) {
    const std::vector<std::string>& may = settings_.leaders;
    const auto place = std::find(may.begin(), may.end(), message.from.node) - may.begin();
    Heard& heard = heard_[static_cast<std::size_t>(place)];
    const bool earlier_run = message.from.session < heard.session;
    const bool first = message.from.session > heard.session;
    if (earlier_run || (!first && message.frame <= heard.frame)) {
        ++counts_.stale;
        if (earlier_run) {
            log_.limited("rig earlier run", kRepeatAfter_s, Severity::kWarning,
                         "a frame of {} from a run before the one that was heard: not drawn (does it run "
                         "twice, or has its clock gone back?)",
                         message.from.node);
        }
        return false;
    }
    heard = {message.from.session, message.frame};
    return true;
}

void Follower::follow(const FrameMessage& message) {
    log_.notice("follows {} from frame {} on", message.from.node, message.frame);
    // It counts on its own: anew from its start, or on from where another stood in for it in vain.
    any_frame_ = false;
    told_frame_ = 0;
    waiting_ = 0;
    leader_ = message.from;
    leader_rank_ = message.rank;
    refuses_ = false;
    draws_ = false;
    ++counts_.leaders;
}

void Follower::forget_leader() noexcept {
    leader_ = {};
    waiting_ = 0;
    draws_ = false;
}

void Follower::tell_drawn(std::uint64_t frame, std::int64_t drawing_ns) {
    own_.drawn_frame = frame;
    own_.drawing_ns = drawing_ns;
    draws_ = true;
    say(NodeState::kFollows);
}

void Follower::tell_alive() {
    say(refuses_ ? NodeState::kRefuses : draws_ ? NodeState::kFollows : NodeState::kJoins);
}

void Follower::note_gl(const std::string& description, std::uint64_t errors) {
    if (own_.gl.empty()) own_.gl = description.substr(0, kMostGlBytes);
    own_.gl_errors = errors;
}

void Follower::say(NodeState state) {
    own_.state = state;
    own_.leader = leader_.node;
    own_.leader_session = leader_.session;
    own_.repeats = counts_.repeats;
    own_.late = counts_.late;
    seal(key_, own_);
    link_.send(own_);
}

Follower::Word Follower::await_word(std::uint64_t frame, std::int64_t patience_ns, const Idle& idle) {
    listen();
    const bool late = told_frame_ >= frame;
    while (told_frame_ < frame && silent_ns() < patience_ns) {
        link_.wait(std::min(kAliveEvery_ns, patience_ns - silent_ns()));
        listen();
        if (told_frame_ >= frame || silent_ns() < kAliveEvery_ns) continue;
        tell_alive();
        if (!idle()) break;
    }
    if (told_frame_ != frame) {
        ++counts_.repeats;
        return Word::kRepeat;
    }
    if (!late) return Word::kShow;
    ++counts_.late;
    return Word::kLate;
}

}  // namespace skyig::server::rig
