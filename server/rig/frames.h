// A rig's frames in the frame loop's own words: when they begin, what is heard in them, what is drawn. The
// loop stays the same on a machine alone, on the leader and on a node.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "server/pace.h"
#include "server/painter.h"
#include "server/rig/machine.h"
#include "server/rig/rig_status.h"
#include "server/wire.h"
#include "server/world/world.h"

namespace skyig::server::rig {

/// The leader's frames begin as this machine's own would, those of others when the leader has told them.
class RigPace final : public Pace {
  public:
    /// \param own  of this machine while it leads
    RigPace(Machine& machine, Pace& own, Machine::Idle idle)
        : machine_(machine), own_(own), idle_(std::move(idle)) {}

    [[nodiscard]] std::optional<FramePacer::Slot> next() override;
    [[nodiscard]] double period_s() const noexcept override { return own_.period_s(); }
    [[nodiscard]] bool replays() const noexcept override { return own_.replays(); }
    [[nodiscard]] std::uint64_t spaced() const noexcept override { return own_.spaced(); }
    /// Of the frame at hand.
    [[nodiscard]] std::uint32_t slots() const noexcept { return slots_; }

  private:
    Machine& machine_;
    Pace& own_;
    Machine::Idle idle_;
    std::int64_t last_ns_ = 0;
    bool followed_ = false;
    std::uint32_t slots_ = 1;
};

/// What a machine that follows hears it keeps to itself.
class RigWire final : public Wire {
  public:
    /// \param own  null on machines that never lead: they hear nobody
    RigWire(const Machine& machine, Wire* own) noexcept : machine_(machine), own_(own) {}

    void open_frame(const FrameMark& mark, std::span<const std::byte> message) override;
    void drain(ArrivalTaker& taker) override;
    [[nodiscard]] bool wait(std::size_t source, std::int64_t most_ns) override;
    [[nodiscard]] bool live() const noexcept override;
    bool send(std::size_t source, const protocol::transport::Endpoint& to,
              std::span<const std::byte> bytes) override;
    [[nodiscard]] protocol::transport::UdpCounters counters() const override;

  private:
    const Machine& machine_;
    Wire* own_;
};

/// Draws this machine's own channels of the frames that the leader tells, or tells its own to all others.
class RigPainter final : public Painter {
  public:
    /// \param own  one for each channel of the rig: whether this machine draws it
    RigPainter(Machine& machine, Painter& inner, const RigPace& pace, world::World& world,
               std::vector<bool> own, Machine::Idle idle);

    void settle(render::Scene& scene) override;
    void thin(render::Thinned thinned) override;
    [[nodiscard]] render::Thinned thinnable() const override { return inner_.thinnable(); }
    void prepare(const render::Scene& scene) override;
    [[nodiscard]] bool draws(std::size_t channel) const override { return own_[channel]; }
    void draw(std::size_t channel) override;
    bool present() override;
    [[nodiscard]] bool showed() const override { return showed_; }
    [[nodiscard]] bool hides(std::size_t channel) const override { return inner_.hides(channel); }
    void read_back(std::size_t channel, std::span<std::byte> rgba) override;
    [[nodiscard]] bool rebuilt() const override { return inner_.rebuilt(); }
    [[nodiscard]] bool on_processor() const override { return inner_.on_processor(); }
    [[nodiscard]] std::size_t gl_objects() const override { return inner_.gl_objects(); }
    [[nodiscard]] std::uint64_t gl_errors() const override { return inner_.gl_errors(); }
    [[nodiscard]] std::uint64_t resets() const override { return inner_.resets(); }
    [[nodiscard]] status::ChannelHealth health(std::size_t channel) const override {
        return inner_.health(channel);
    }
    [[nodiscard]] render::eye::Adaptation eyes() const override { return inner_.eyes(); }
    [[nodiscard]] double adaptation_cd_m2() const override { return inner_.adaptation_cd_m2(); }
    [[nodiscard]] std::size_t passes(std::span<status::PassState> rows) const override {
        return inner_.passes(rows);
    }
    void rig(status::RigState& state) const override { fill_status(machine_, frame_, state); }
    [[nodiscard]] std::string description() const override { return inner_.description(); }

  private:
    void tell(const render::Scene& scene);
    void follow(const FrameState& state);
    [[nodiscard]] bool may_show();

    Machine& machine_;
    Painter& inner_;
    const RigPace& pace_;
    world::World& world_;
    std::vector<bool> own_;
    Machine::Idle idle_;
    render::Thinned thinned_;
    std::unique_ptr<FrameState> told_;
    bool gave_up_ = false;
    std::uint64_t frame_ = 0;
    std::int64_t began_ns_ = 0;
    bool showed_ = false;
    /// The last that was prepared.
    std::optional<std::uint64_t> prepared_;
};

}  // namespace skyig::server::rig
