// The words of a report, each table in the order of its enumeration.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "protocol/metar/values.h"

namespace skyig::protocol::metar {

inline constexpr std::array<std::string_view, static_cast<std::size_t>(Descriptor::kEnd)> kDescriptorCodes{
    "MI", "BC", "PR", "DR", "BL", "SH", "TS", "FZ"};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Phenomenon::kEnd)> kPhenomenonCodes{
    "DZ", "RA", "SN", "SG", "IC", "PL", "GR", "GS", "UP", "BR", "FG",
    "FU", "VA", "DU", "SA", "HZ", "PY", "PO", "SQ", "FC", "SS", "DS"};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(CloudAmount::kEnd)> kAmountCodes{
    "FEW", "SCT", "BKN", "OVC"};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(ClearCode::kEnd)> kClearCodes{
    "SKC", "CLR", "NSC", "NCD"};
inline constexpr std::array<std::string_view, 3> kSpeedUnits{"KT", "MPS", "KMH"};
inline constexpr std::array<std::string_view, 8> kCompass{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
inline constexpr std::array<std::string_view, 8> kColourStates{"BLU",  "WHT",  "GRN", "YLO",
                                                               "YLO1", "YLO2", "AMB", "RED"};

/// The place of `word` among `words`, as E.
template <class E, std::size_t count>
[[nodiscard]] std::optional<E> find_code(const std::array<std::string_view, count>& words,
                                         std::string_view word) noexcept {
    const auto* const found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) return std::nullopt;
    return static_cast<E>(found - words.begin());
}

template <std::size_t count>
[[nodiscard]] bool is_one_of(const std::array<std::string_view, count>& words,
                             std::string_view word) noexcept {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace skyig::protocol::metar
