// Ready-made weather, compiled in from config/presets/: the same text as in the files.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "config/config.h"
#include "config/document.h"
#include "config/table_reader.h"

namespace skyig::config {

/// From the clearest to the thickest.
inline constexpr std::array<std::string_view, 15> kPresetNames{
    "cavok", "few",  "scattered", "broken",     "overcast", "mvfr",  "rain", "snow",
    "storm", "cat1", "cat2",      "patchy-fog", "fog",      "cat3a", "cat3b"};

/// \param path  "cavok.toml"
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view path) noexcept;

/// Puts a preset's [air], [ground] and [weather] in the place of those of `config`. \param preset  a name of
/// kPresetNames, or a file's path if it has a '/' or ends in ".toml"
/// \return what is wrong in one line, and nothing was changed; empty: nothing
[[nodiscard]] std::string apply_preset(const std::string& preset, Config& config);

/// The same for the document's weather.preset, before its own tables are read.
void read_preset(const Table& root, ErrorList& errors, Config& config);

}  // namespace skyig::config
