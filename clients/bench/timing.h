// What works cost on a machine whose speed wanders: each is timed in turn with a floor, a small work that
// everyone can picture, in many short rounds, and the median of the ratios is kept.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "server/clock.h"

namespace skyig::clients::bench {

/// Does the calls number `first` .. `first + count - 1` and returns something that depends on all of them, so
/// that no compiler drops one.
using Work = std::function<double(std::uint64_t first, std::uint64_t count)>;

/// A Work of a function of the call's number that returns a double; the loop is inside, so that no indirect
/// call is timed.
template <class Call>
[[nodiscard]] Work repeat(Call call) {
    return [call](std::uint64_t first, std::uint64_t count) mutable {
        double sum = 0.0;
        for (std::uint64_t i = first; i < first + count; ++i)
            sum += call(i);
        return sum;
    };
}

/// One of the works that are compared: what a model asks for one of the family's costs.
struct Contender {
    std::string model;
    std::string cost;
    Work work;
    /// Of this work alone; empty: the floor of all.
    Work floor = {};
    /// Calls enough to count instructions of: fewer for works that take long and are always alike.
    std::uint64_t most_counted_calls = std::numeric_limits<std::uint64_t>::max();
    /// Alike things that one call does at once: figures are of one of them.
    std::uint64_t things = 1;
};

struct Quartiles {
    double p25 = 0.0;
    double median = 0.0;
    double p75 = 0.0;

    friend bool operator==(const Quartiles&, const Quartiles&) = default;
};

/// Interpolated between ranks; zero for no values.
[[nodiscard]] Quartiles quartiles(std::vector<double> values);

struct Timing {
    Quartiles ns;  ///< of one call, or of one of its things
    /// As multiples of the floor that was timed just before.
    Quartiles floors;
};

struct PairedTimings {
    /// Of one call, whichever floor it was.
    Quartiles floor_ns;
    /// In the order of the contenders.
    std::vector<Timing> contenders;
};

struct TimingOptions {
    int rounds = 101;
    /// How long one batch of calls takes, about; the clock's own cost and grain vanish in it.
    double batch_ns = 100'000.0;
};

/// Every round times each contender once, each time next to a batch of its floor; the order is shuffled from
/// round to round (alike in every run), so that nobody always follows the same neighbour. One round before
/// the first warms up and is not counted.
[[nodiscard]] PairedTimings measure_paired(const server::Clock& clock, const Work& floor,
                                           std::span<const Contender> contenders,
                                           const TimingOptions& options);

}  // namespace skyig::clients::bench
