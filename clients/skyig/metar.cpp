#include "clients/skyig/metar.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "clients/skyig/metar/json.h"
#include "clients/skyig/metar/page.h"
#include "clients/skyig/metar/state.h"
#include "protocol/metar/decode.h"

namespace skyig::clients {

namespace {

class ReportPrinter {
  public:
    ReportPrinter(const MetarOptions& options, std::ostream& out) : options_(options), out_(out) {}

    /// \param text   any number of reports  \param place  "line 2"
    void print(std::string_view text, const std::string& place) {
        while (const auto one = protocol::metar::next_report(text)) {
            const protocol::metar::Report report = protocol::metar::decode(*one);
            if (options_.state) {
                out_ << metar::state_json(report, options_.elevation_m) << '\n';
            } else if (options_.json) {
                out_ << metar::to_json(report) << '\n';
            } else {
                out_ << (printed_ ? "\n" : "") << metar::to_text(report);
            }
            printed_ = true;
            if (report.valid()) continue;
            good_ = false;
            out_.flush();
            fmt::print(stderr, "skyig metar: {}: {}\n", place, metar::problems_text(report));
        }
    }
    [[nodiscard]] int exit_status() const {
        if (!printed_) fmt::print(stderr, "skyig metar: there is no report to read\n");
        return printed_ && good_ ? 0 : 1;
    }

  private:
    const MetarOptions& options_;
    std::ostream& out_;
    bool printed_ = false;
    bool good_ = true;
};

/// Each argument is a report; neighbours without a blank are the words of one that came without quotes.
void print_arguments(const std::vector<std::string>& arguments, ReportPrinter& printer) {
    const auto is_word = [&](std::size_t i) { return arguments[i].find(' ') == std::string::npos; };
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::size_t first = i;
        std::string report = arguments[i];
        while (is_word(first) && i + 1 < arguments.size() && is_word(i + 1))
            report += ' ' + arguments[++i];
        printer.print(report, fmt::format("argument {}", first + 1));
    }
}

}  // namespace

int run_metar(const MetarOptions& options, std::istream& in, std::ostream& out) {
    try {
        ReportPrinter printer(options, out);
        if (!options.reports.empty() && options.reports != std::vector<std::string>{"-"}) {
            print_arguments(options.reports, printer);
            return printer.exit_status();
        }
        std::string line;
        for (std::size_t number = 1; std::getline(in, line); ++number)
            printer.print(line, fmt::format("line {}", number));
        return printer.exit_status();
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig metar: {}\n", error.what());
        return 1;
    }
}

int run_metar(const MetarOptions& options) {
    return run_metar(options, std::cin, std::cout);
}

}  // namespace skyig::clients
