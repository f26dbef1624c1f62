// The families of interchangeable models that can be measured, and the one way to measure them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/bench/report.h"
#include "clients/bench/timing.h"
#include "server/clock.h"

namespace skyig::clients::bench {

/// One line of the register in family.cpp. A new family brings these four and nothing else.
struct Family {
    std::string_view name;
    std::string_view what;
    /// The report with everything but costs: models with their errors against the truth tables under
    /// `truth` (one folder a topic, as tests/data). Throws std::runtime_error naming the table that is
    /// missing.
    Report (*measure_errors)(const std::filesystem::path& truth);
    /// All costs of all models; each model's name stands in the report.
    std::vector<Contender> (*contenders)();
    /// What costs are told in multiples of.
    Work (*floor)();
};

[[nodiscard]] std::span<const Family> families() noexcept;
/// Nothing when there is no family of that name.
[[nodiscard]] const Family* find_family(std::string_view name) noexcept;

/// Instructions of one call, as a tool outside has counted them.
struct InstructionCount {
    std::string family;
    std::string model;
    std::string cost;
    double instructions = 0.0;
};

/// Reads lines of "family,model,cost,instructions"; `#` begins a comment. Throws std::runtime_error with the
/// number of the bad line.
[[nodiscard]] std::vector<InstructionCount> read_instruction_counts(std::string_view text);

/// Errors and costs of every model, all costs from one paired run. Throws std::runtime_error for a truth
/// table that is missing and for a count of something that there is not (other families may be counted too).
[[nodiscard]] Report measure(const Family& family, const std::filesystem::path& truth,
                             const server::Clock& clock, const TimingOptions& options,
                             std::span<const InstructionCount> instructions);

/// For an instruction counter: makes `calls` calls of each contender's work (or its most_counted_calls)
/// inside skyig_bench_counted_calls, after a few outside of it. \return lines of "family,model,cost,calls" in
/// the same order; a call that does several things counts as so many.
[[nodiscard]] std::string make_counted_calls(const Family& family, std::uint64_t calls);

}  // namespace skyig::clients::bench

/// The function, by a name without mangling, inside which instructions are to be counted.
extern "C" double skyig_bench_counted_calls(const skyig::clients::bench::Work* work, std::uint64_t first,
                                            std::uint64_t calls);
