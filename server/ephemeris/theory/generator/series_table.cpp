// Build tool: turns the CSV of a theory's coefficients into the initialisers of two C++ arrays, the terms in
// pairs and where each sum's pairs lie, so that the programs neither ship nor parse it.
// Usage: series_table elpmpp02|vsop87b INPUT.csv TERMS.inc RANGES.inc. Exit 1 with one line on stderr when a
// file is not as it should be.
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace {

/// One way of writing coefficients: which columns name a sum, and which sums the program has places for.
struct Theory {
    std::string_view heading;
    std::size_t name_columns;
    /// The program sums sines; a theory written in cosines has a quarter turn added.
    double added_phase_rad;
    std::vector<std::string> sums;
};

/// Amplitude, then the coefficients of the phase, as text that reads back exactly.
using Term = std::vector<std::string>;

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else if (c != '\r') {
            fields.back().push_back(c);
        }
    }
    return fields;
}

std::string number(const std::string& text, double added = 0.0) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end)
        throw std::runtime_error("not a number: '" + text + "'");
    return fmt::format("{:.17e}", value + added);
}

std::vector<std::string> names_of_sums(const std::vector<std::string>& bodies, int powers) {
    std::vector<std::string> names;
    for (const std::string& body : bodies) {
        for (const char coordinate : {'L', 'B', 'R'}) {
            for (int power = 0; power < powers; ++power)
                names.push_back(fmt::format("{}{},{}", body, coordinate, power));
        }
    }
    return names;
}

Theory theory_named(std::string_view name) {
    if (name == "elpmpp02")
        return {"coord,power,amp,phi0,phi1,phi2,phi3,phi4", 2, 0.0, names_of_sums({""}, 2)};
    if (name == "vsop87b")
        return {"body,coord,power,amp,phase,freq", 3, std::numbers::pi / 2.0,
                names_of_sums({"mercury,", "venus,", "mars,", "jupiter,", "saturn,"}, 4)};
    throw std::runtime_error(fmt::format("{}: the theory should be elpmpp02 or vsop87b", name));
}

/// The terms of each sum in the order of the file: great amplitudes first.
std::map<std::string, std::vector<Term>> read_sums(const std::string& path, const Theory& theory) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error(path + ": cannot be read");
    if (line != theory.heading)
        throw std::runtime_error(fmt::format("{}: the heading should be {}", path, theory.heading));
    std::map<std::string, std::vector<Term>> sums;
    for (const std::string& name : theory.sums)
        sums[name];
    const std::size_t columns = split(line).size();
    while (std::getline(file, line)) {
        const std::vector<std::string> row = split(line);
        if (row.size() != columns)
            throw std::runtime_error(fmt::format("{}: wrong number of fields: {}", path, line));
        std::string name = row[0];
        for (std::size_t i = 1; i < theory.name_columns; ++i)
            name += "," + row[i];
        const auto sum = sums.find(name);
        if (sum == sums.end()) throw std::runtime_error(fmt::format("{}: no such sum: {}", path, line));
        Term term{number(row[theory.name_columns])};
        for (std::size_t i = theory.name_columns + 1; i < columns; ++i)
            term.push_back(number(row[i], term.size() == 1 ? theory.added_phase_rad : 0.0));
        sum->second.push_back(std::move(term));
    }
    return sums;
}

/// A pair as {amplitudes, {phases, phases, ...}}.
std::string pair_literal(const Term& first, const Term& second) {
    std::string phases;
    for (std::size_t i = 1; i < first.size(); ++i)
        phases += fmt::format("{}{{{},{}}}", i == 1 ? "" : ",", first[i], second[i]);
    return fmt::format("{{{{{},{}}},{{{{{}}}}}}},\n", first[0], second[0], phases);
}

void write_tables(const Theory& theory, const std::string& input_path, const std::string& terms_path,
                  const std::string& ranges_path) {
    std::map<std::string, std::vector<Term>> sums = read_sums(input_path, theory);
    std::ofstream terms_file(terms_path);
    std::ofstream ranges_file(ranges_path);
    std::size_t pairs = 0;
    for (const std::string& name : theory.sums) {
        std::vector<Term>& terms = sums.at(name);
        // A lone last term is paired with nothing: amplitude and phase 0.
        if (terms.size() % 2 != 0) terms.push_back(Term(terms.front().size(), "0.0"));
        ranges_file << fmt::format("TermRange{{{}, {}}},  // {}\n", pairs, terms.size() / 2, name);
        pairs += terms.size() / 2;
        // Small ones first, as the program adds them.
        for (std::size_t i = terms.size(); i > 0; i -= 2)
            terms_file << pair_literal(terms[i - 1], terms[i - 2]);
    }
    if (!terms_file.flush()) throw std::runtime_error(terms_path + ": cannot be written");
    if (!ranges_file.flush()) throw std::runtime_error(ranges_path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fputs("usage: series_table elpmpp02|vsop87b INPUT.csv TERMS.inc RANGES.inc\n", stderr);
        return 2;
    }
    try {
        write_tables(theory_named(argv[1]), argv[2], argv[3], argv[4]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "series_table: %s\n", error.what());
        return 1;
    }
    return 0;
}
