#include "clients/skyig/bench.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/bench/family.h"
#include "clients/bench/pages.h"
#include "server/clock.h"

namespace skyig::clients {

namespace {

/// What is not of a family: it draws.
using NameAndWhat = std::pair<std::string_view, std::string_view>;
constexpr std::array<NameAndWhat, 3> kDrawing{
    {{"frame", "frames a second by picture size and scene"},
     {"thinning", "what each thing that [overload] may leave out saves, by scene"},
     {"preview", "what reading back and previews of three channels add to frames"}}};

int list_families(bool json) {
    std::string text;
    std::vector<NameAndWhat> all;
    for (const bench::Family& family : bench::families())
        all.emplace_back(family.name, family.what);
    all.insert(all.end(), kDrawing.begin(), kDrawing.end());
    for (const auto& [name, what] : all) {
        if (json) {
            text += fmt::format("{}{{\"family\": \"{}\", \"what\": \"{}\"}}", text.empty() ? "" : ",\n ",
                                name, what);
        } else {
            text += fmt::format("{:<12} {}\n", name, what);
        }
    }
    fmt::print("{}", json ? fmt::format("[{}]\n", text) : text);
    return 0;
}

int unknown_family(const std::string& name) {
    std::string known;
    for (const bench::Family& family : bench::families())
        known += fmt::format("{}{}", known.empty() ? "" : ", ", family.name);
    for (const NameAndWhat& drawing : kDrawing)
        known += fmt::format(", {}", drawing.first);
    fmt::print(stderr, "skyig: bench: there is no family '{}'; there are: {}\n", name, known);
    return 2;
}

std::vector<bench::InstructionCount> read_instructions(const std::string& path) {
    if (path.empty()) return {};
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path));
    try {
        return bench::read_instruction_counts(text.str());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
    }
}

}  // namespace

int run_bench(const BenchOptions& options) {
    if (options.list) return list_families(options.json);
    if (!options.render_folder.empty()) {
        for (const auto& path : bench::render_pages(options.render_folder))
            fmt::print("{}\n", path.string());
        return 0;
    }
    const bench::Family* family = bench::find_family(options.family);
    if (!family) return unknown_family(options.family);
    if (options.counted_calls) {
        fmt::print("{}", bench::make_counted_calls(*family, *options.counted_calls));
        return 0;
    }
    const server::SystemClock clock;
    bench::TimingOptions timing;
    timing.rounds = options.rounds;
    const bench::Report report = bench::measure(*family, options.truth_folder, clock, timing,
                                                read_instructions(options.instructions_path));
    fmt::print("{}", options.json ? to_json(report) : to_text(report));
    return 0;
}

}  // namespace skyig::clients
