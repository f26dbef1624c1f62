// The frustum of a [[channel]], in any of the three ways to give one: four half angles, fields of view, or
// the corners of a flat screen.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "config/flat_screen.h"
#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::string_view kWanted =
    "the signed half angle to that side in degrees (or fov_deg, or the corners in [channel.screen])";
constexpr double kMaxField_deg = 2.0 * kMaxHalfAngle_deg;

/// One pair of frustum sides: both are needed, and something has to lie between them.
void read_sides(TableReader& table, std::string_view low_key, double& low_deg, std::string_view high_key,
                double& high_deg) {
    const Range range{-kMaxHalfAngle_deg, kMaxHalfAngle_deg, "degrees"};
    const Value* low = table.number(low_key, low_deg, range);
    const Value* high = table.number(high_key, high_deg, range);
    table.require(low_key, kWanted);
    table.require(high_key, kWanted);
    if (low != nullptr && high != nullptr && low_deg >= high_deg) {
        table.error(
            *high, high_key,
            fmt::format(
                "is {}, not greater than {} = {}: such a channel has no area ({} is normally negative)",
                high_deg, low_key, low_deg, low_key));
    }
}

void read_half_angles(TableReader& table, Channel& channel) {
    read_sides(table, "left_deg", channel.left_deg, "right_deg", channel.right_deg);
    read_sides(table, "bottom_deg", channel.bottom_deg, "top_deg", channel.top_deg);
}

void read_fields(TableReader& table, Channel& channel) {
    const Range range{0.0, kMaxField_deg, "degrees", true};
    double across_deg = channel.right_deg - channel.left_deg;
    const Value* across = table.number("fov_deg", across_deg, range);
    table.require("fov_deg", "the whole field of view from left to right in degrees");
    double upright_deg = matching_field_deg(across_deg, channel.width_px, channel.height_px);
    const Value* upright = table.number("fov_vertical_deg", upright_deg, range);
    if (upright == nullptr && across != nullptr && upright_deg > kMaxField_deg) {
        table.error(*across, "fov_deg",
                    fmt::format("makes {:.2f} degrees from bottom to top with square pixels; at most {}",
                                upright_deg, kMaxField_deg));
        return;
    }
    channel.left_deg = -0.5 * across_deg;
    channel.right_deg = 0.5 * across_deg;
    channel.bottom_deg = -0.5 * upright_deg;
    channel.top_deg = 0.5 * upright_deg;
}

const Value* read_corner(TableReader& table, std::string_view key, BodyPoint& corner_m) {
    const Value* value = table.numbers(key, corner_m, {-kMaxOffset_m, kMaxOffset_m, "m"},
                                       "three numbers of metres: [forward, right, down]");
    table.require(key, "that corner of the screen: [forward, right, down] in metres");
    return value;
}

void read_flat_screen(TableReader& table, const Value& key, Channel& channel) {
    TableReader own = table.table("screen");
    FlatScreen screen;
    const bool bottom_left = read_corner(own, "bottom_left_m", screen.bottom_left_m) != nullptr;
    const bool bottom_right = read_corner(own, "bottom_right_m", screen.bottom_right_m) != nullptr;
    const bool top_left = read_corner(own, "top_left_m", screen.top_left_m) != nullptr;
    own.finish();
    if (!bottom_left || !bottom_right || !top_left) return;
    const AimResult result = aim_at(screen, channel.offset_m);
    if (!result.aim) {
        table.error(key, "screen", result.refusal);
        return;
    }
    const Aim& aim = *result.aim;
    channel.left_deg = aim.left_deg;
    channel.right_deg = aim.right_deg;
    channel.bottom_deg = aim.bottom_deg;
    channel.top_deg = aim.top_deg;
    channel.yaw_deg = aim.yaw_deg;
    channel.pitch_deg = aim.pitch_deg;
    channel.roll_deg = aim.roll_deg;
}

void read_attitude(TableReader& table, Channel& channel) {
    table.number("yaw_deg", channel.yaw_deg, {-360.0, 360.0, "degrees"});
    table.number("pitch_deg", channel.pitch_deg, {-90.0, 90.0, "degrees"});
    table.number("roll_deg", channel.roll_deg, {-180.0, 180.0, "degrees"});
}

constexpr std::array<std::string_view, 4> kHalfAngles{"left_deg", "right_deg", "bottom_deg", "top_deg"};
constexpr std::array<std::string_view, 2> kFields{"fov_deg", "fov_vertical_deg"};
constexpr std::array<std::string_view, 3> kAttitude{"yaw_deg", "pitch_deg", "roll_deg"};

/// Keys that another way to give the frustum has made meaningless. \return whether there are none
bool leaves_out(TableReader& table, std::string_view beside, std::span<const std::string_view> keys) {
    bool none = true;
    for (const std::string_view key : keys) {
        const Value* value = table.any(key);
        if (value == nullptr) continue;
        none = false;
        table.error(*value, key,
                    fmt::format("stands beside {}, which says it already; give one of them", beside));
    }
    return none;
}

}  // namespace

double matching_field_deg(double field_deg, double own_px, double other_px) noexcept {
    return 2.0 * std::atan(std::tan(field_deg * kPi / 360.0) * other_px / own_px) * 180.0 / kPi;
}

void know_frustum(TableReader& table) {
    for (const std::span<const std::string_view> keys :
         {std::span<const std::string_view>{kHalfAngles}, std::span<const std::string_view>{kFields},
          std::span<const std::string_view>{kAttitude}}) {
        for (const std::string_view key : keys)
            table.any(key);
    }
}

bool refuse_frustum(TableReader& table, std::string_view beside) {
    const bool angles = leaves_out(table, beside, kHalfAngles);
    const bool fields = leaves_out(table, beside, kFields);
    const bool attitude = leaves_out(table, beside, kAttitude);
    return angles && fields && attitude;
}

void read_frustum(TableReader& table, Channel& channel) {
    if (const Value* screen = table.any("screen"); screen != nullptr) {
        if (refuse_frustum(table, "screen")) read_flat_screen(table, *screen, channel);
        return;
    }
    read_attitude(table, channel);
    if (table.any("fov_deg") != nullptr || table.any("fov_vertical_deg") != nullptr) {
        if (leaves_out(table, "fov_deg", kHalfAngles)) read_fields(table, channel);
        return;
    }
    read_half_angles(table, channel);
}

}  // namespace skyig::config
