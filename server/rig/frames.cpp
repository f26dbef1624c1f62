#include "server/rig/frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skyig::server::rig {

namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
/// Of 1970-01-01.
constexpr std::int32_t kUnixMjd = 40587;

std::int64_t unix_ns(const ephemeris::UtcClockTime& time) noexcept {
    return (time.mjd() - kUnixMjd) * 86'400 * kSecondNs + std::llround(time.second_of_day() * 1e9);
}

ephemeris::UtcClockTime from_unix_ns(std::int64_t utc_ns) noexcept {
    const std::int64_t seconds = utc_ns / kSecondNs - (utc_ns % kSecondNs < 0 ? 1 : 0);
    return ephemeris::UtcClockTime::from_unix(seconds,
                                              static_cast<std::int32_t>(utc_ns - seconds * kSecondNs));
}

}  // namespace

std::optional<FramePacer::Slot> RigPace::next() {
    if (!machine_.await_work(idle_)) return std::nullopt;
    const std::int64_t now_ns = machine_.clock().monotonic_ns();
    if (machine_.leads()) {
        std::optional<FramePacer::Slot> slot = own_.next();
        if (!slot) return std::nullopt;
        // The world has gone on while nobody led.
        if (std::exchange(followed_, false)) {
            slot->slots = static_cast<std::uint64_t>(std::max<std::int64_t>(
                std::llround(static_cast<double>(slot->start_ns - last_ns_) * 1e-9 / period_s()), 1));
            slot->late = false;
        }
        last_ns_ = slot->start_ns;
        slots_ = static_cast<std::uint32_t>(slot->slots);
        return slot;
    }
    const Follower& follower = machine_.follower();
    FramePacer::Slot slot{.start_ns = now_ns};
    for (std::size_t i = 0; i < follower.waiting(); ++i)
        slot.slots += follower.frame(i).slots;
    slot.thinned = follower.newest().thinned.to_ullong();
    slot.told_number = follower.newest().scene.frame_number;
    followed_ = true;
    last_ns_ = now_ns;
    return slot;
}

void RigWire::open_frame(const FrameMark& mark, std::span<const std::byte> message) {
    if (own_ != nullptr && machine_.leads()) own_->open_frame(mark, message);
}

void RigWire::drain(ArrivalTaker& taker) {
    if (own_ != nullptr) own_->drain(taker);
}

bool RigWire::wait(std::size_t source, std::int64_t most_ns) {
    return own_ != nullptr && machine_.leads() && own_->wait(source, most_ns);
}

bool RigWire::live() const noexcept {
    return own_ != nullptr && machine_.leads() && own_->live();
}

bool RigWire::send(std::size_t source, const protocol::transport::Endpoint& to,
                   std::span<const std::byte> bytes) {
    return own_ == nullptr || !machine_.leads() || own_->send(source, to, bytes);
}

protocol::transport::UdpCounters RigWire::counters() const {
    return own_ != nullptr ? own_->counters() : protocol::transport::UdpCounters{};
}

RigPainter::RigPainter(Machine& machine, Painter& inner, const RigPace& pace, world::World& world,
                       std::vector<bool> own, Machine::Idle idle)
    : machine_(machine),
      inner_(inner),
      pace_(pace),
      world_(world),
      own_(std::move(own)),
      idle_(std::move(idle)),
      told_(std::make_unique<FrameState>()) {
    machine_.follower().note_gl(inner_.description(), 0);
}

void RigPainter::settle(render::Scene& scene) {
    // The first frame has no slot of its own.
    if (!machine_.leads() && machine_.follower().waiting() == 0) gave_up_ = !machine_.await_work(idle_);
    began_ns_ = machine_.clock().monotonic_ns();
    if (machine_.leads() || gave_up_) return;
    const FrameState& newest = machine_.follower().newest();
    scene = newest.scene;
    world_.stand_at(from_unix_ns(newest.world_utc_ns), newest.scene.time_s,
                    static_cast<std::uint32_t>(newest.scene.frame_number));
}

void RigPainter::thin(render::Thinned thinned) {
    thinned_ = thinned;
    inner_.thin(thinned);
}

void RigPainter::prepare(const render::Scene& scene) {
    frame_ = scene.frame_number;
    if (gave_up_) return;
    if (machine_.leads()) {
        tell(scene);
        inner_.prepare(scene);
        return;
    }
    Follower& follower = machine_.follower();
    for (std::size_t i = 0; i < follower.waiting(); ++i)
        follow(follower.frame(i));
    follower.clear();
}

void RigPainter::tell(const render::Scene& scene) {
    told_->scene = scene;
    told_->eyes = inner_.eyes();
    told_->thinned = thinned_;
    told_->world_utc_ns = unix_ns(world_.clock().utc());
    told_->slots = pace_.slots();
    machine_.leader().tell(*told_);
}

void RigPainter::follow(const FrameState& state) {
    render::eye::Adaptation eyes = state.eyes;
    // The leader's eyes were there all along, whatever this machine has missed.
    const std::uint64_t frame = state.scene.frame_number;
    if (frame != 0 && (!prepared_ || *prepared_ + 1 != frame)) eyes.resume();
    prepared_ = frame;
    inner_.thin(state.thinned);
    inner_.adapt_as(eyes);
    inner_.prepare(state.scene);
}

void RigPainter::draw(std::size_t channel) {
    if (own_[channel] && !gave_up_) inner_.draw(channel);
}

bool RigPainter::may_show() {
    if (machine_.leads()) {
        machine_.leader().await(frame_);
        machine_.leader().tell_show(frame_);
        return true;
    }
    Follower& follower = machine_.follower();
    follower.note_gl({}, inner_.gl_errors());
    follower.tell_drawn(frame_, machine_.clock().monotonic_ns() - began_ns_);
    return machine_.await_word(frame_, idle_) != Follower::Word::kRepeat;
}

bool RigPainter::present() {
    showed_ = !gave_up_ && may_show();
    return !showed_ || inner_.present();
}

void RigPainter::read_back(std::size_t channel, std::span<std::byte> rgba) {
    inner_.read_back(channel, rgba);
}

}  // namespace skyig::server::rig
