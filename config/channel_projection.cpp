// What of a [[channel]] says how directions come to its pixels: size, frustum, warp and blend, or a region of
// an MPCDI file in place of all four.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "config/file_at.h"
#include "config/schema.h"
#include "config/warp/bytes.h"
#include "config/warp/float_map.h"
#include "config/warp/grey_map.h"
#include "config/warp/mpcdi.h"

namespace skyig::config {
namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;

void read_size(TableReader& table, Channel& channel) {
    table.integer("width_px", channel.width_px, 1, kMaxChannelSize_px, "pixels");
    table.integer("height_px", channel.height_px, 1, kMaxChannelSize_px, "pixels");
}

void require_size(TableReader& table) {
    table.require("width_px", "the channel's width in pixels");
    table.require("height_px", "the channel's height in pixels");
}

void read_drawing(TableReader& own, Channel& channel) {
    constexpr std::array<std::string_view, 2> kDrawings{"direct", "resampled"};
    own.choice("draw", channel.warp_drawing, kDrawings);
    if (channel.warp_drawing == WarpDrawing::kResampled) {
        own.number("render_scale", channel.render_scale, {0.25, 4.0, {}});
    } else if (const Value* scale = own.any("render_scale"); scale != nullptr) {
        own.error(*scale, "render_scale",
                  "is of pictures that are resampled: write draw = \"resampled\" beside it, or leave it out "
                  "(what is drawn directly has the screen's own pixels)");
    }
}

void read_warp(TableReader own, const std::string& settings_file, Channel& channel) {
    constexpr std::array<std::string_view, 2> kNodes{"centres", "edges"};
    std::size_t nodes = 0;
    own.choice("nodes", nodes, kNodes);
    auto mesh = file_at(own, "mesh", settings_file, [&](const warp::Bytes& bytes) {
        warp::FileRead<warp::FloatMap> map = warp::read_float_map(bytes);
        if (!map.value) return warp::FileRead<warp::WarpMesh>{std::nullopt, std::move(map.fault)};
        return warp::warp_mesh(*map.value, nodes == 1);
    });
    own.require("mesh", "a PFM file of what each node of the screen shows");
    if (mesh) channel.warp = std::make_shared<warp::WarpMesh>(std::move(*mesh));
    read_drawing(own, channel);
    own.finish();
}

/// A mask of the channel's own size.
std::optional<warp::GreyMap> read_mask(TableReader& own, std::string_view key, warp::MaskPart part,
                                       const std::string& settings_file, const Channel& channel) {
    return file_at(own, key, settings_file, [&](const warp::Bytes& bytes) {
        warp::FileRead<warp::GreyMap> map = warp::read_grey_map(bytes, part);
        if (map.value &&
            (map.value->width_px != channel.width_px || map.value->height_px != channel.height_px)) {
            return warp::FileRead<warp::GreyMap>{
                std::nullopt, fmt::format("is {}x{} pixels; the channel has {}x{}", map.value->width_px,
                                          map.value->height_px, channel.width_px, channel.height_px)};
        }
        return map;
    });
}

void read_blend(TableReader own, const std::string& settings_file, Channel& channel) {
    warp::BlendMask blend{channel.width_px, channel.height_px, {}};
    constexpr std::array<std::string_view, 3> kParts{"either", "alpha", "luma"};
    std::size_t part = 0;
    own.choice("part", part, kParts);
    double gamma = 1.0;
    own.number("gamma", gamma, {0.1, 10.0, {}});
    auto mask = read_mask(own, "mask", static_cast<warp::MaskPart>(part), settings_file, channel);
    if (mask) {
        blend.weight = std::move(mask->values);
        for (float& weight : blend.weight)
            weight = std::pow(weight, static_cast<float>(gamma));
    } else {
        blend.weight.assign(
            static_cast<std::size_t>(channel.width_px) * static_cast<std::size_t>(channel.height_px), 1.0F);
    }
    std::optional<double> lift;
    own.number("black_lift", lift, {0.0, 0.5, "of full white"});
    blend.lift.assign(1, static_cast<float>(lift.value_or(0.0)));
    auto lifts = read_mask(own, "black_mask", warp::MaskPart::kEither, settings_file, channel);
    if (lifts) {
        // With a mask the lift is what its white stands for.
        const auto white = static_cast<float>(lift.value_or(1.0));
        blend.lift = std::move(lifts->values);
        for (float& value : blend.lift)
            value *= white;
    }
    own.finish();
    channel.blend = std::make_shared<warp::BlendMask>(std::move(blend));
}

/// The frustum of a part of a picture: places on the image plane are tangents.
void crop(const std::array<double, 4>& part, Channel& channel) {
    const auto cropped = [](double& low_deg, double& high_deg, double from, double size) {
        const double low = std::tan(low_deg / kDegPerRad);
        const double high = std::tan(high_deg / kDegPerRad);
        low_deg = std::atan(low + from * (high - low)) * kDegPerRad;
        high_deg = std::atan(low + (from + size) * (high - low)) * kDegPerRad;
    };
    cropped(channel.left_deg, channel.right_deg, part[0], part[2]);
    cropped(channel.bottom_deg, channel.top_deg, part[1], part[3]);
}

void take_size(TableReader& table, const warp::MpcdiRegion& region, Channel& channel) {
    for (const auto& [key, size_px, own_px] :
         {std::tuple{"width_px", region.width_px, &channel.width_px},
          std::tuple{"height_px", region.height_px, &channel.height_px}}) {
        if (const Value* value = table.any(key); value != nullptr && *own_px != size_px)
            table.error(*value, key,
                        fmt::format("is {}, but the MPCDI region has {}; leave it out", *own_px, size_px));
        *own_px = size_px;
    }
}

void take_region(TableReader& table, warp::MpcdiRegion region, Channel& channel) {
    take_size(table, region, channel);
    if (region.view) {
        if (refuse_frustum(table, "mpcdi")) {
            channel.left_deg = region.view->sides_deg[0];
            channel.right_deg = region.view->sides_deg[1];
            channel.bottom_deg = region.view->sides_deg[2];
            channel.top_deg = region.view->sides_deg[3];
            channel.yaw_deg = region.view->attitude_deg[0];
            channel.pitch_deg = region.view->attitude_deg[1];
            channel.roll_deg = region.view->attitude_deg[2];
        }
    } else {
        read_frustum(table, channel);
        crop(region.part, channel);
    }
    if (region.warp) channel.warp = std::make_shared<warp::WarpMesh>(std::move(*region.warp));
    if (region.blend) channel.blend = std::make_shared<warp::BlendMask>(std::move(*region.blend));
}

void read_mpcdi_table(TableReader& table, const std::string& settings_file, Channel& channel) {
    TableReader own = table.table("mpcdi");
    std::string region;
    own.text("region", region);
    auto read = file_at(own, "file", settings_file,
                        [&](warp::Bytes bytes) { return warp::read_mpcdi(std::move(bytes), region); });
    own.require("file", "an MPCDI file");
    read_drawing(own, channel);
    own.finish();
    for (const std::string_view key : {"warp", "blend", "screen"}) {
        if (const Value* value = table.any(key); value != nullptr)
            table.error(*value, key, "stands beside mpcdi, which says it already; give one of them");
    }
    if (read)
        take_region(table, std::move(*read), channel);
    else
        know_frustum(table);
}

}  // namespace

void read_projection(TableReader& table, const std::string& settings_file, Channel& channel) {
    read_size(table, channel);
    if (table.any("mpcdi") != nullptr) {
        read_mpcdi_table(table, settings_file, channel);
        return;
    }
    require_size(table);
    read_frustum(table, channel);
    if (table.any("warp") != nullptr) read_warp(table.table("warp"), settings_file, channel);
    if (table.any("blend") != nullptr) read_blend(table.table("blend"), settings_file, channel);
}

}  // namespace skyig::config
