#include "protocol/metar/report.h"

#include <fmt/format.h>

#include <array>

namespace skyig::protocol::metar {
namespace {

/// A group is a few characters; one of a thousand need not be repeated in full.
constexpr std::size_t kToldChars = 40;

constexpr std::array<std::string_view, static_cast<std::size_t>(Fault::kEnd)> kFaultTexts{
    "a report begins with METAR, SPECI or neither, then a station of four letters: METAR EGLL",
    "write day (01 to 31), hour and minute of UTC behind the station as 151220Z",
    "write the wind as 24012KT, 24012G25KT or VRB03MPS: direction 000 to 360, speed of two or three digits, "
    "KT, MPS or KMH",
    "write the sector of a variable wind direction as 280V350, 000 to 360, behind the wind",
    "write visibility as four digits of metres, 0800 or 1200SW, or in statute miles as 10SM, 1/4SM or "
    "1 1/2SM",
    "write a runway's range as R27L/0600, R27/0550V0800U or R27/P6000FT/D, its state as R27/450093 or "
    "R27/SNOCLO, runways 01 to 36",
    "write weather as intensity (+, -, VC), one of MI BC PR DR BL SH TS FZ and phenomena: -SHRA, FZFG, VCTS",
    "write cloud as FEW, SCT, BKN or OVC and hundreds of feet, CB or TCU behind them: BKN012CB; a hidden sky "
    "as VV002",
    "write temperature and dew point as two digits each, M for minus: 15/08, M02/M11",
    "write the pressure as Q1018 (hPa, 0850 to 1100) or A2992 (hundredths of an inch of mercury)",
    "write the sea's temperature and state or wave height (dm) as W15/S2 or W15/H12",
    "write wind shear as WS ALL RWY or WS R27L",
    "an earlier group has told this; leave one of them",
};

}  // namespace

std::string_view fault_text(Fault fault) noexcept {
    const auto index = static_cast<std::size_t>(fault);
    return index < kFaultTexts.size() ? kFaultTexts[index] : std::string_view("no fault");
}

std::string describe(const Problem& problem) {
    if (problem.group.empty()) return fmt::format("at its end: {}", fault_text(problem.fault));
    const std::string_view group = problem.group;
    const bool cut = group.size() > kToldChars;
    return fmt::format("'{}{}': {}", group.substr(0, kToldChars), cut ? "..." : "",
                       fault_text(problem.fault));
}

}  // namespace skyig::protocol::metar
