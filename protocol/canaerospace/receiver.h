// The receiving end of one CANaerospace bus: frames with their receive times in, values of parameters out.
// Keeps what single frames cannot tell: message codes, halves of doubles, redundancy channels, the running
// clock, weather waiting for its commit. No clock of its own, no allocation after construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/can_frame.h"
#include "protocol/canaerospace/bus_clock.h"
#include "protocol/canaerospace/channel_choice.h"
#include "protocol/canaerospace/identifier_map.h"
#include "protocol/canaerospace/reading.h"
#include "protocol/canaerospace/sequence.h"
#include "protocol/canaerospace/weather_stage.h"

namespace skyig::protocol::canaerospace {

inline constexpr std::int64_t kNever = INT64_MAX;

struct GroupTimes {
    /// A value older than this says nothing any more; kNever: it holds until the next.
    std::int64_t stale_after_ns = 0;
    std::int64_t nominal_interval_ns = 0;

    /// After so long without a frame any message code is accepted.
    [[nodiscard]] constexpr std::int64_t restart_after_ns() const noexcept {
        constexpr std::int64_t kLeast = 1'000'000'000;
        return nominal_interval_ns > kLeast / 10 ? 10 * nominal_interval_ns : kLeast;
    }
    /// After so long a redundancy channel counts as silent.
    [[nodiscard]] constexpr std::int64_t silent_after_ns() const noexcept {
        return stale_after_ns == kNever ? restart_after_ns() : stale_after_ns;
    }
};

enum class WeatherMode : std::uint8_t {
    kOnCommit,  // weather applies when a commit comes
    kAtOnce     // each value is committed as it comes, for senders without a commit
};

struct ReceiverOptions {
    /// Indexed by Group.
    std::array<GroupTimes, kGroups> times{{{500'000'000, 12'500'000},
                                           {500'000'000, 12'500'000},
                                           {1'000'000'000, 100'000'000},
                                           {3'000'000'000, 1'000'000'000},
                                           {kNever, 1'000'000'000}}};
    /// A DOUBLEL counts if it comes no later after its DOUBLEH.
    std::int64_t pair_within_ns = 50'000'000;
    /// A lower redundancy channel that was silent is taken again after it was heard for so long.
    std::int64_t channel_returns_after_ns = 1'000'000'000;
    WeatherMode weather = WeatherMode::kOnCommit;
};

/// One new value. Of a commit: layers that stay staged as bits in `held_layers`.
struct Update {
    Parameter parameter = Parameter::kEnd;
    /// Number of the cloud layer for layered parameters and for the commit of one layer, else 0.
    std::uint8_t layer = 0;
    std::uint8_t node = 0;
    std::uint16_t channel = 0;
    /// In the unit of the default map; coverage as 0..1. Time of day and date as Value::number has them.
    double value = 0.0;
    /// Time of day and date: as Value::items.
    std::array<std::int64_t, 4> items{};
    std::int64_t received_ns = 0;
    std::uint8_t held_layers = 0;
};

struct Reception {
    /// reason kNone: accepted. The value of a DOUBLEL is the double's.
    Reading reading;
    /// There is an `update`: accepted, a whole value, of the redundancy channel in use.
    bool published = false;
    Update update;

    [[nodiscard]] Outcome outcome() const noexcept { return outcome_of(reading.reason); }
};

/// What was noticed beside outcomes and their reasons.
enum class Event : std::uint8_t {
    kFrames,        // all of them
    kAccepted,      // of all kinds, services and halves of doubles included
    kPublished,     // values handed on
    kLost,          // messages missing by their codes
    kRestarted,     // senders that began anew after a silence
    kUnchecked,     // senders found not to count their messages
    kUnfinished,    // high halves of doubles without their low half
    kOtherChannel,  // values of redundancy channels that are not in use
    kFellOver,      // changes to another channel, the one in use being silent
    kReturned,      // changes back to a lower channel
    kCommits,       // of weather
    kLayersHeld,    // cloud layers that a commit left staged, since they cannot be drawn
    kEnd
};
inline constexpr std::size_t kEvents = static_cast<std::size_t>(Event::kEnd);
/// "frames", "accepted", ...
[[nodiscard]] std::string_view event_name(Event event) noexcept;

struct Counters {
    std::array<std::uint64_t, kEvents> events{};
    /// Frames by Reason; at kNone the accepted ones.
    std::array<std::uint64_t, kReasons> reasons{};

    [[nodiscard]] std::uint64_t& operator[](Event event) noexcept {
        return events[static_cast<std::size_t>(event)];
    }
    [[nodiscard]] std::uint64_t operator[](Event event) const noexcept {
        return events[static_cast<std::size_t>(event)];
    }
    [[nodiscard]] std::uint64_t operator[](Reason reason) const noexcept {
        return reasons[static_cast<std::size_t>(reason)];
    }
    [[nodiscard]] std::uint64_t operator[](Outcome outcome) const noexcept;
};

class Receiver {
  public:
    /// \param map  for which check() found no fault
    explicit Receiver(const IdentifierMap& map = default_identifier_map(),
                      const ReceiverOptions& options = {});

    /// Takes one frame; frames come in the order of their receive times. A frame that is refused changes
    /// nothing but counters, and a waiting high half that it fails to complete.
    Reception receive(const CanFrame& frame) noexcept;
    /// The same; hands a new value to `sink(const Update&)`.
    template <class Sink>
    Reception receive(const CanFrame& frame, Sink&& sink) {
        const Reception reception = receive(frame);
        if (reception.published) sink(reception.update);
        return reception;
    }

    /// True if nothing was ever published of `parameter`, or nothing for as long as its group allows.
    [[nodiscard]] bool is_stale(Parameter parameter, std::int64_t now_ns) const noexcept;
    /// The redundancy channel in use; none before the first value.
    [[nodiscard]] std::optional<std::uint16_t> channel_of(Parameter parameter) const noexcept;

    [[nodiscard]] const BusClock& clock() const noexcept { return clock_; }
    [[nodiscard]] const WeatherStage& weather() const noexcept { return weather_; }
    [[nodiscard]] const Counters& counters() const noexcept { return counters_; }
    [[nodiscard]] const IdentifierMap& map() const noexcept { return index_.map(); }
    [[nodiscard]] const ReceiverOptions& options() const noexcept { return options_; }

  private:
    [[nodiscard]] const GroupTimes& times_of(const MapEntry& entry) const noexcept {
        return options_.times[static_cast<std::size_t>(entry.group)];
    }
    void judge(const CanFrame& frame, Reading& reading) noexcept;
    void count(const CodeVerdict& verdict) noexcept;
    [[nodiscard]] Reason join(Stream& stream, const CanFrame& frame, Reading& reading) noexcept;
    void publish(const CanFrame& frame, Reception& reception) noexcept;
    [[nodiscard]] bool choose_channel(const Message& message, std::int64_t received_ns) noexcept;
    void take_in(const Message& message, Update& update) noexcept;
    void commit(const Message& message, bool one_layer, Update& update) noexcept;

    IdentifierIndex index_;
    ReceiverOptions options_;
    StreamTable streams_;
    std::array<ChannelChoice, kParameters> channels_{};
    BusClock clock_;
    WeatherStage weather_;
    Counters counters_;
};

}  // namespace skyig::protocol::canaerospace
