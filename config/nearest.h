// The word that somebody probably meant.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace skyig::config {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment), letter case ignored.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest distance, or an empty view when none is near: at most a third of the
/// longer word, or one word begins the other (a forgotten or superfluous unit suffix).
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace skyig::config
