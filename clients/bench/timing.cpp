#include "clients/bench/timing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>

namespace skyig::clients::bench {

namespace {

/// A work with the number of calls that fills a batch, and the number of its next call.
class Batch {
  public:
    Batch(const server::Clock& clock, const Work& work, double batch_ns) : clock_(clock), work_(work) {
        (void)run_ns();  // fills caches, those of the work too
        while (quicker_of_two_ns() < 0.5 * batch_ns && calls_ < kMostCalls)
            calls_ *= 2;
    }

    /// Nanoseconds a call.
    double time_ns() { return run_ns() / static_cast<double>(calls_); }

  private:
    static constexpr std::uint64_t kMostCalls = std::uint64_t{1} << 30U;

    /// A work that was interrupted, or had something to prepare, looks longer than it is.
    double quicker_of_two_ns() {
        const double first_ns = run_ns();
        return std::min(first_ns, run_ns());
    }

    double run_ns() {
        const std::int64_t start_ns = clock_.monotonic_ns();
        const double sum = work_(next_, calls_);
        const std::int64_t end_ns = clock_.monotonic_ns();
        sink_ = sum;
        next_ += calls_;
        return static_cast<double>(end_ns - start_ns);
    }

    const server::Clock& clock_;
    const Work& work_;
    std::uint64_t calls_ = 1;
    std::uint64_t next_ = 0;
    volatile double sink_ = 0.0;
};

}  // namespace

Quartiles quartiles(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&values](double part) {
        const double rank = part * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(rank);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return std::lerp(values[below], values[above], rank - std::floor(rank));
    };
    return {at(0.25), at(0.5), at(0.75)};
}

PairedTimings measure_paired(const server::Clock& clock, const Work& floor,
                             std::span<const Contender> contenders, const TimingOptions& options) {
    std::vector<Batch> floor_batches;
    std::vector<Batch> batches;
    for (const Contender& contender : contenders) {
        floor_batches.emplace_back(clock, contender.floor ? contender.floor : floor, options.batch_ns);
        batches.emplace_back(clock, contender.work, options.batch_ns);
    }

    std::vector<double> floor_ns;
    std::vector<std::vector<double>> ns(contenders.size());
    std::vector<std::vector<double>> floors(contenders.size());
    std::vector<std::size_t> order(contenders.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(1);
    for (int round = -1; round < options.rounds; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        for (const std::size_t i : order) {
            const double floor_now_ns = floor_batches[i].time_ns();
            const double now_ns = batches[i].time_ns() / static_cast<double>(contenders[i].things);
            if (round < 0) continue;
            floor_ns.push_back(floor_now_ns);
            ns[i].push_back(now_ns);
            // A clock too coarse for the floor leaves no ratio.
            if (floor_now_ns > 0.0) floors[i].push_back(now_ns / floor_now_ns);
        }
    }
    PairedTimings timings;
    timings.floor_ns = quartiles(std::move(floor_ns));
    for (std::size_t i = 0; i < contenders.size(); ++i)
        timings.contenders.push_back({quartiles(std::move(ns[i])), quartiles(std::move(floors[i]))});
    return timings;
}

}  // namespace skyig::clients::bench
