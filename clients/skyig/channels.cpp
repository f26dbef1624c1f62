#include "clients/skyig/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "clients/skyig/still/still.h"
#include "render/rig_geometry.h"
#include "server/clock.h"
#include "server/from_config.h"

namespace skyig::clients {
namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr double kSquareDegPerSr = kDegPerRad * kDegPerRad;
constexpr double kArcminPerRad = 60.0 * kDegPerRad;
constexpr double kWholeSphere_sr = 4.0 * 3.14159265358979323846;
/// Channels that miss one another by less meet: what the eye does not see.
constexpr double kTouch_rad = 1e-3 / kDegPerRad;

struct Rig {
    std::vector<render::Channel> channels;
    render::RigField field;
};

Rig read_rig(const ChannelsOptions& options) {
    const server::SystemClock clock;
    StillOptions moment;
    moment.config_path = options.config_path;
    const Still still = make_still(moment, clock);
    Rig rig;
    rig.channels = server::render_channels(still.config);
    rig.field = render::rig_field(rig.channels, still.scene.channel_views());
    return rig;
}

double finest_corner_rad(const render::ChannelField& field) {
    return *std::min_element(field.corner_pixel_rad.begin(), field.corner_pixel_rad.end());
}

double coarsest_corner_rad(const render::ChannelField& field) {
    return *std::max_element(field.corner_pixel_rad.begin(), field.corner_pixel_rad.end());
}

std::string how_they_meet(const render::ChannelPair& pair) {
    if (pair.overlap_rad > kTouch_rad) {
        return fmt::format("overlap by {:.2f} deg, {:.1f} square degrees", pair.overlap_rad * kDegPerRad,
                           pair.overlap_sr * kSquareDegPerSr);
    }
    if (pair.gap_rad > kTouch_rad) return fmt::format("a gap of {:.2f} deg", pair.gap_rad * kDegPerRad);
    return "meet";
}

void print_text(const Rig& rig) {
    fmt::print("{:<12} {:>11} {:>8} {:>8} {:>10} {:>8} {:>17}\n", "channel", "pixels", "across", "upright",
               "sq. deg", "centre", "corners");
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        const render::Channel& channel = rig.channels[i];
        const render::ChannelField& field = rig.field.channels[i];
        fmt::print("{:<12} {:>11} {:>7.2f}d {:>7.2f}d {:>10.1f} {:>7.2f}' {:>16}'\n", channel.name,
                   fmt::format("{}x{}", channel.width_px, channel.height_px), field.across_rad * kDegPerRad,
                   field.upright_rad * kDegPerRad, field.solid_angle_sr * kSquareDegPerSr,
                   field.centre_pixel_rad * kArcminPerRad,
                   fmt::format("{:.2f}..{:.2f}", finest_corner_rad(field) * kArcminPerRad,
                               coarsest_corner_rad(field) * kArcminPerRad));
    }
    for (const render::ChannelPair& pair : rig.field.pairs)
        fmt::print("{} - {}: {}\n", rig.channels[pair.first].name, rig.channels[pair.second].name,
                   how_they_meet(pair));
    fmt::print("all: {:.1f} square degrees, {:.1f} % of the sphere\n",
               rig.field.solid_angle_sr * kSquareDegPerSr,
               100.0 * rig.field.solid_angle_sr / kWholeSphere_sr);
}

nlohmann::ordered_json channel_json(const render::Channel& channel, const render::ChannelField& field) {
    nlohmann::ordered_json corners = nlohmann::ordered_json::array();
    for (const double corner_rad : field.corner_pixel_rad)
        corners.push_back(corner_rad * kArcminPerRad);
    return {{"name", channel.name},
            {"width_px", channel.width_px},
            {"height_px", channel.height_px},
            {"across_deg", field.across_rad * kDegPerRad},
            {"upright_deg", field.upright_rad * kDegPerRad},
            {"square_deg", field.solid_angle_sr * kSquareDegPerSr},
            {"centre_arcmin_px", field.centre_pixel_rad * kArcminPerRad},
            {"corners_arcmin_px", std::move(corners)}};
}

void print_json(const Rig& rig) {
    nlohmann::ordered_json json;
    json["channels"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        json["channels"].push_back(channel_json(rig.channels[i], rig.field.channels[i]));
    json["pairs"] = nlohmann::ordered_json::array();
    for (const render::ChannelPair& pair : rig.field.pairs) {
        json["pairs"].push_back({{"first", rig.channels[pair.first].name},
                                 {"second", rig.channels[pair.second].name},
                                 {"overlap_deg", pair.overlap_rad * kDegPerRad},
                                 {"overlap_square_deg", pair.overlap_sr * kSquareDegPerSr},
                                 {"gap_deg", pair.gap_rad * kDegPerRad}});
    }
    json["square_deg"] = rig.field.solid_angle_sr * kSquareDegPerSr;
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_channels(const ChannelsOptions& options) {
    try {
        const Rig rig = read_rig(options);
        options.json ? print_json(rig) : print_text(rig);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    }
}

}  // namespace skyig::clients
