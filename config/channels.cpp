// The [[channel]] tables: each for itself, then against one another.
#include <fmt/format.h>

#include <cmath>

#include "config/schema.h"

namespace skyig::config {
namespace {

/// Where the things stand that only a comparison can find wrong.
struct ChannelPlaces {
    Place name;
    Place view_id;
    Place offset;
    bool named = false;
};

void read_offset(TableReader& table, Channel& channel, ChannelPlaces& places) {
    const Value* value = table.numbers("offset_m", channel.offset_m, {-kMaxOffset_m, kMaxOffset_m, "m"},
                                       "three numbers of metres: [forward, right, down]");
    if (value != nullptr) places.offset = value->place;
}

void read_own_screen(TableReader& table, const Screen& usual, Channel& channel) {
    if (table.any("display") == nullptr) return;
    TableReader own = table.table("display");
    channel.display = usual;
    read_screen(own, *channel.display);
    own.finish();
}

void read_own_overlay(TableReader& table, const Overlay& usual, Channel& channel) {
    if (table.any("overlay") == nullptr) return;
    TableReader own = table.table("overlay");
    channel.overlay = usual;
    read_overlay(own, *channel.overlay);
    own.finish();
}

void read_windscreen(TableReader& table, Channel& channel) {
    const Value* value =
        table.number("windscreen_m", channel.windscreen_m, {kLeastWindscreen_m, kMostWindscreen_m, "m"});
    if (value != nullptr && channel.warp) {
        table.error(
            *value, "windscreen_m",
            "is of channels without a warp, whose pictures are what is seen through a pane; leave it out");
    }
}

ChannelPlaces read_channel(TableReader& table, ErrorList& errors, const Config& config, Channel& channel) {
    ChannelPlaces places;
    places.name = places.view_id = places.offset = table.place();
    if (const Value* value = table.text("name", channel.name); value != nullptr) {
        places.name = value->place;
        places.named = is_short_name(channel.name);
        if (!places.named) {
            table.error(
                *value, "name",
                fmt::format("is \"{}\"; it must be 1..32 of letters, digits, '-' and '_' (it names files)",
                            channel.name));
        }
    }
    table.require("name", "a short text such as \"centre\"");
    read_channel_node(table, config.rig, channel);
    read_offset(table, channel, places);
    read_projection(table, errors.file(), channel);
    if (const Value* value = table.integer("view_id", channel.view_id, 0, 65535); value != nullptr) {
        places.view_id = value->place;
    }
    table.integer("group_id", channel.group_id, 0, 255);
    read_own_screen(table, config.display, channel);
    table.choice("pattern", channel.pattern, kPatternNames);
    read_windscreen(table, channel);
    read_own_overlay(table, config.overlay, channel);
    read_viewport(table, errors, config.windows, channel);
    table.finish();
    return places;
}

double distance_m(const Channel& a, const Channel& b) {
    return std::hypot(a.offset_m[0] - b.offset_m[0], a.offset_m[1] - b.offset_m[1],
                      a.offset_m[2] - b.offset_m[2]);
}

void compare(ErrorList& errors, const std::vector<Channel>& channels,
             const std::vector<ChannelPlaces>& places) {
    for (std::size_t j = 1; j < channels.size(); ++j) {
        const Channel& channel = channels[j];
        bool name_told = !places[j].named, view_told = false, spread_told = false;
        for (std::size_t i = 0; i < j; ++i) {
            const Channel& other = channels[i];
            if (!name_told && channel.name == other.name) {
                name_told = true;
                errors.add(places[j].name, fmt::format("channel[{}].name", j + 1),
                           fmt::format("is \"{}\" like that of channel[{}]; names must differ", channel.name,
                                       i + 1));
            }
            if (!view_told && channel.view_id == other.view_id) {
                view_told = true;
                errors.add(
                    places[j].view_id, fmt::format("channel[{}].view_id", j + 1),
                    fmt::format(
                        "is {} like that of channel[{}] (not given: the channel's place in the file); view "
                        "ids must differ",
                        channel.view_id, i + 1));
            }
            if (!spread_told && distance_m(channel, other) > kMaxEyeSpread_m) {
                spread_told = true;
                errors.add(
                    places[j].offset, fmt::format("channel[{}].offset_m", j + 1),
                    fmt::format(
                        "is {:.4g} m from that of channel[{}]; all channels share one eye point, so at most "
                        "{} m (run a daemon of its own for another place)",
                        distance_m(channel, other), i + 1, kMaxEyeSpread_m));
            }
        }
    }
}

}  // namespace

void read_overlay(TableReader& table, Overlay& overlay) {
    table.boolean("mode", overlay.mode);
    table.boolean("rate", overlay.rate);
    table.boolean("host", overlay.host);
    table.boolean("host_lost", overlay.host_lost);
    table.integer("scale", overlay.scale, 1, kMaxTextScale);
}

void read_channels(TableReader& root, ErrorList& errors, Config& config) {
    std::vector<Channel>& channels = config.channels;
    const Value* value = root.any("channel");
    if (value == nullptr) {
        errors.add({}, "channel",
                   "is missing; at least one [[channel]] with name, size and half angles is needed");
        return;
    }
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr || list->items.empty()) {
        root.error(*value, "channel", "must be one or more tables: write [[channel]] in double brackets");
        return;
    }
    if (list->items.size() > kMaxChannels) {
        root.error(*value, "channel",
                   fmt::format("is there {} times; at most {}", list->items.size(), kMaxChannels));
        return;
    }
    std::vector<ChannelPlaces> places;
    for (const Value& item : list->items) {
        const std::size_t number = channels.size() + 1;
        const auto* table = std::get_if<Table>(&item.data);
        if (table == nullptr) {
            root.error(item, "channel", fmt::format("holds {}; write [[channel]] tables", type_name(item)));
        }
        Channel& channel = channels.emplace_back();
        channel.view_id = static_cast<int>(number);
        TableReader reader(errors, table, item.place, fmt::format("channel[{}]", number));
        places.push_back(table == nullptr ? ChannelPlaces{} : read_channel(reader, errors, config, channel));
    }
    compare(errors, channels, places);
}

}  // namespace skyig::config
