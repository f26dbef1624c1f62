#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "config/file_at.h"
#include "config/schema.h"
#include "config/warp/grey_map.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 4> kNoiseNames{"puffs", "smooth", "cells", "fibres"};
constexpr int kLeastSide_px = 16;
constexpr int kMostSide_px = 2048;

/// Mean difference of pixels that are neighbours: inside, and across the edges when the picture repeats.
struct Steps {
    double inside = 0.0;
    double across = 0.0;
};

Steps steps_of(const warp::GreyMap& map, bool along_rows) {
    const int side = map.width_px;
    const auto at = [&](int place, int line) {
        const int index = along_rows ? line * side + place : place * side + line;
        return map.values[static_cast<std::size_t>(index)];
    };
    double inside = 0.0;
    double across = 0.0;
    for (int line = 0; line < side; ++line) {
        for (int place = 1; place < side; ++place)
            inside += static_cast<double>(std::abs(at(place, line) - at(place - 1, line)));
        across += static_cast<double>(std::abs(at(0, line) - at(side - 1, line)));
    }
    return {inside / (static_cast<double>(side) * (side - 1)), across / side};
}

/// What keeps a picture from being repeated over the ground; empty: nothing.
std::string fault_of(const warp::GreyMap& map) {
    const bool power = std::has_single_bit(static_cast<unsigned>(map.width_px));
    if (map.width_px != map.height_px || !power || map.width_px < kLeastSide_px ||
        map.width_px > kMostSide_px) {
        return fmt::format("it is {}x{} pixels; it must be square, 16, 32, 64 ... or 2048 wide", map.width_px,
                           map.height_px);
    }
    constexpr double kMostTimes = 3.0;
    constexpr double kCodes = 255.0;
    for (const bool along_rows : {true, false}) {
        const Steps steps = steps_of(map, along_rows);
        if (steps.across <= kMostTimes * steps.inside + 2.0 / kCodes) continue;
        return fmt::format(
            "it has a seam when it repeats: pixels of its {} edges differ by {:.0f} of 255 in the mean, "
            "neighbours inside by {:.1f}",
            along_rows ? "left and right" : "upper and lower", kCodes * steps.across, kCodes * steps.inside);
    }
    return {};
}

void read_texture(TableReader& table, const std::string& settings_file, WeatherTexture& texture) {
    auto image = file_at(table, "image", settings_file, [](const warp::Bytes& bytes) {
        warp::FileRead<warp::GreyMap> map = warp::read_grey_map(bytes);
        if (!map.value) return map;
        std::string fault = fault_of(*map.value);
        return fault.empty() ? map : warp::FileRead<warp::GreyMap>{std::nullopt, std::move(fault)};
    });
    if (image) texture.image = std::make_shared<warp::GreyMap>(std::move(*image));
    const Value* named = table.choice("noise", texture.noise, kNoiseNames);
    if (named != nullptr && table.has("image"))
        table.error(*named, "noise", "stands beside image; give one of them");
    table.number("size_m", texture.size_m, {32.0, kTexturesRepeat_m, "m"});
    table.number("weight", texture.weight, {-4.0, 4.0, {}});
    table.number("scroll_m_s", texture.scroll_m_s, {0.0, 150.0, "m/s"});
    table.number("scroll_from_deg", texture.scroll_from_deg, {-360.0, 360.0, "degrees"});
}

}  // namespace

void read_weather_sheet(TableReader& table, ErrorList& errors, WeatherSheet& sheet) {
    table.require("type", "which clouds look so: \"cirrus\", \"stratus\" ...");
    const Value* type = table.choice("type", sheet.type, std::span(kLayerTypeNames));
    if (type != nullptr && !is_cloud(sheet.type)) table.error(*type, "type", "is no cloud; it must be one");
    table.number("density_offset", sheet.density_offset, {-4.0, 4.0, {}});
    table.number("self_shadow", sheet.self_shadow, {0.0, 10.0, {}});
    table.numbers("colour", sheet.colour, {0.0, 1.0, {}}, "three numbers: [red, green, blue]");
    table.require("texture", "what it is made of: one to three [[weather.sheet.texture]] tables");
    read_tables(table, errors, "texture", "weather.sheet.texture", 0, kMaxWeatherTextures,
                [&](TableReader& item) { read_texture(item, errors.file(), sheet.textures.emplace_back()); });
}

}  // namespace skyig::config
