// Build tool: turns the star catalogue's CSV into the initialisers of a C++ array, so that the programs
// neither ship nor parse it. Usage: star_table bsc5.csv bv_by_spectral.csv OUTPUT. Exit 1 with one line on
// stderr when a file is not as it should be.
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr double kRadiansPerMilliarcsecond = kRadiansPerDegree / 3'600'000.0;
constexpr double kBvWithoutClass = 0.6;

using Row = std::vector<std::string>;
using BvByClass = std::map<std::string, double, std::less<>>;

Row split(const std::string& line) {
    Row fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else if (c != '\r') {
            fields.back().push_back(c);
        }
    }
    return fields;
}

double number(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end)
        throw std::runtime_error("not a number: '" + text + "'");
    return value;
}

/// All rows below the heading, which has to be `heading`.
std::vector<Row> read_table(const std::string& path, std::string_view heading) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error(path + ": cannot be read");
    if (line != heading) throw std::runtime_error(fmt::format("{}: the heading should be {}", path, heading));
    const std::size_t columns = split(line).size();
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        rows.push_back(split(line));
        if (rows.back().size() != columns)
            throw std::runtime_error(fmt::format("{}: wrong number of fields: {}", path, line));
    }
    return rows;
}

/// The spectral class as the table of medians has it: a capital letter and perhaps a digit, after one
/// luminosity prefix.
std::string_view spectral_class(std::string_view spectral) {
    constexpr std::string_view kPrefixes = "gdksc";
    constexpr std::string_view kLetters = "WOBAFGKMSC";
    if (!spectral.empty() && kPrefixes.find(spectral.front()) != std::string_view::npos)
        spectral.remove_prefix(1);
    if (spectral.empty() || kLetters.find(spectral.front()) == std::string_view::npos) return {};
    const bool digit = spectral.size() > 1 && spectral[1] >= '0' && spectral[1] <= '9';
    return spectral.substr(0, digit ? 2 : 1);
}

double color_index(const std::string& bv, const std::string& spectral, const BvByClass& medians) {
    if (!bv.empty()) return number(bv);
    const std::string_view wanted = spectral_class(spectral);
    if (wanted.empty()) return kBvWithoutClass;
    const auto found = medians.find(wanted);
    if (found == medians.end()) throw std::runtime_error("no B-V for spectral class " + std::string(wanted));
    return found->second;
}

/// Nine digits bring every float back exactly.
std::string vector_literal(double x, double y, double z) {
    return fmt::format("{{{:.8e}F,{:.8e}F,{:.8e}F}}", x, y, z);
}

/// One element of the array: direction, proper motion, V, B-V, HR, in the order of CatalogueStar.
std::string star_literal(const Row& row, const BvByClass& medians) {
    enum Column { kHr, kRa, kDec, kPmRa, kPmDec, kV, kBv, kParallax, kHd, kSpectral };
    const double ra_rad = number(row[kRa]) * kRadiansPerDegree;
    const double dec_rad = number(row[kDec]) * kRadiansPerDegree;
    const double pm_ra = number(row[kPmRa]) * kRadiansPerMilliarcsecond;
    const double pm_dec = number(row[kPmDec]) * kRadiansPerMilliarcsecond;
    const double sin_ra = std::sin(ra_rad);
    const double cos_ra = std::cos(ra_rad);
    const double sin_dec = std::sin(dec_rad);
    const double cos_dec = std::cos(dec_rad);

    const std::string direction = vector_literal(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec);
    // Along the unit vectors of growing right ascension and declination; the first is measured on the sky.
    const std::string motion = vector_literal(-pm_ra * sin_ra - pm_dec * sin_dec * cos_ra,
                                              pm_ra * cos_ra - pm_dec * sin_dec * sin_ra, pm_dec * cos_dec);
    return fmt::format("{{{},{},{:.8e}F,{:.8e}F,{}}},\n", direction, motion, number(row[kV]),
                       color_index(row[kBv], row[kSpectral], medians), row[kHr]);
}

void write_table(const std::string& catalogue_path, const std::string& medians_path,
                 const std::string& output_path) {
    BvByClass medians;
    for (const Row& row : read_table(medians_path, "class,count,bv_median"))
        medians.emplace(row[0], number(row[2]));
    const std::vector<Row> rows = read_table(catalogue_path,
                                             "hr,ra_deg,dec_deg,pmra_masyr,pmdec_masyr,vmag,bv,plx_mas,hd,"
                                             "spectral,vflag,dmag,sep_arcsec,name");
    std::ofstream output(output_path);
    for (const Row& row : rows)
        output << star_literal(row, medians);
    if (!output.flush()) throw std::runtime_error(output_path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: star_table bsc5.csv bv_by_spectral.csv OUTPUT\n", stderr);
        return 2;
    }
    try {
        write_table(argv[1], argv[2], argv[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "star_table: %s\n", error.what());
        return 1;
    }
    return 0;
}
