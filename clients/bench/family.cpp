#include "clients/bench/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "clients/bench/cloud_family.h"
#include "clients/bench/ephemeris_family.h"
#include "clients/bench/eye_family.h"
#include "clients/bench/fog_family.h"
#include "clients/bench/night_family.h"
#include "clients/bench/sky_family.h"
#include "clients/bench/wire_family.h"

namespace skyig::clients::bench {

namespace {

constexpr std::array<Family, 7> kFamilies{{
    {"cloud", "light in and from cloud", measure_cloud_errors, cloud_contenders, cloud_floor},
    {"ephemeris", "places of Sun, Moon and planets", measure_ephemeris_errors, ephemeris_contenders,
     ephemeris_floor},
    {"eye", "from luminance to display codes", measure_eye_errors, eye_contenders, eye_floor},
    {"fog", "fog, haze and their like; runway visual range", measure_fog_errors, fog_contenders, fog_floor},
    {"night", "light of the night sky, source by source", measure_night_errors, night_contenders,
     night_floor},
    {"sky", "light of the day sky", measure_sky_errors, sky_contenders, sky_floor},
    {"wire", "CIGI in both versions and byte orders", measure_wire_errors, wire_contenders, wire_floor},
}};

std::string describe_machine() {
    std::ifstream info("/proc/cpuinfo");
    std::string processor = "unknown processor";
    for (std::string line; std::getline(info, line);) {
        const auto colon = line.find(": ");
        if (!line.starts_with("model name") || colon == std::string::npos) continue;
        processor = line.substr(colon + 2);
        break;
    }
#if defined(__clang__)
    constexpr std::string_view kCompiler = "clang " __clang_version__;
#else
    constexpr std::string_view kCompiler = "gcc " __VERSION__;
#endif
    return fmt::format("{}, {} cores, {}", processor, std::thread::hardware_concurrency(), kCompiler);
}

std::optional<double> instructions_of(std::span<const InstructionCount> counts, std::string_view family,
                                      const Contender& contender) {
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const InstructionCount& count) {
        return count.family == family && count.model == contender.model && count.cost == contender.cost;
    });
    if (found == counts.end()) return {};
    return found->instructions;
}

/// A count of this family that belongs to none of its works, or of no family, is a misspelt one.
void require_known(std::span<const InstructionCount> counts, const Family& family,
                   std::span<const Contender> contenders) {
    for (const InstructionCount& count : counts) {
        if (!find_family(count.family))
            throw std::runtime_error(fmt::format("instructions: there is no family '{}'", count.family));
        const auto counted = [&count](const Contender& contender) {
            return contender.model == count.model && contender.cost == count.cost;
        };
        if (count.family == family.name && std::none_of(contenders.begin(), contenders.end(), counted))
            throw std::runtime_error(fmt::format("instructions: {} has no model '{}' with a cost '{}'",
                                                 family.name, count.model, count.cost));
    }
}

std::optional<InstructionCount> read_count(std::string_view line) {
    std::array<std::string_view, 4> fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto comma = line.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == fields.size())) return {};
        fields[i] = line.substr(0, comma);
        if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
    }
    InstructionCount count{std::string(fields[0]), std::string(fields[1]), std::string(fields[2]), 0.0};
    const char* end = fields[3].data() + fields[3].size();
    const auto [rest, error] = std::from_chars(fields[3].data(), end, count.instructions);
    if (error != std::errc() || rest != end || !(count.instructions >= 0.0)) return {};
    return count;
}

}  // namespace

std::span<const Family> families() noexcept {
    return kFamilies;
}

const Family* find_family(std::string_view name) noexcept {
    const auto found = std::find_if(kFamilies.begin(), kFamilies.end(),
                                    [name](const Family& family) { return family.name == name; });
    return found == kFamilies.end() ? nullptr : &*found;
}

std::vector<InstructionCount> read_instruction_counts(std::string_view text) {
    std::vector<InstructionCount> counts;
    for (int number = 1; !text.empty(); ++number) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        const auto count = read_count(line);
        if (!count)
            throw std::runtime_error(
                fmt::format("line {}: '{}' is not family,model,cost,instructions", number, line));
        counts.push_back(*count);
    }
    return counts;
}

Report measure(const Family& family, const std::filesystem::path& truth, const server::Clock& clock,
               const TimingOptions& options, std::span<const InstructionCount> instructions) {
    const std::vector<Contender> contenders = family.contenders();
    require_known(instructions, family, contenders);
    Report report = family.measure_errors(truth);
    const PairedTimings timings = measure_paired(clock, family.floor(), contenders, options);
    report.floor_ns = timings.floor_ns;
    report.rounds = options.rounds;
    report.machine = describe_machine();
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        const Contender& contender = contenders[i];
        const auto model =
            std::find_if(report.models.begin(), report.models.end(),
                         [&](const ModelEntry& entry) { return entry.name == contender.model; });
        if (model == report.models.end())
            throw std::logic_error(fmt::format("bench: {} times an unknown model", family.name));
        model->costs.push_back({contender.cost, timings.contenders[i].ns, timings.contenders[i].floors,
                                instructions_of(instructions, family.name, contender)});
    }
    return report;
}

std::string make_counted_calls(const Family& family, std::uint64_t calls) {
    std::string lines;
    double sum = 0.0;
    for (const Contender& contender : family.contenders()) {
        const std::uint64_t warm_up = std::min<std::uint64_t>(4, contender.most_counted_calls);
        const std::uint64_t counted = std::min(calls, contender.most_counted_calls);
        sum += contender.work(0, warm_up);
        sum += skyig_bench_counted_calls(&contender.work, warm_up, counted);
        fmt::format_to(std::back_inserter(lines), "{},{},{},{}\n", family.name, contender.model,
                       contender.cost, counted * contender.things);
    }
    // Keeps every call's result in use.
    if (sum != sum) throw std::domain_error("bench: a model's result is not a number");
    return lines;
}

}  // namespace skyig::clients::bench
