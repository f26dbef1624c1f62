#include "config/pacing.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/schema.h"

namespace skyig::config {
namespace {

constexpr std::array<std::string_view, 3> kPacingNames{"clock", "display", "host"};

std::string all_thinnings() {
    std::string text;
    for (const ThinningName& each : kThinningNames)
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", each.name);
    return text;
}

/// What was in older settings, with why it is gone.
std::string told_of(std::string_view name) {
    constexpr std::array<std::string_view, 3> kSavedNothing{"cloud-motion", "dome", "stars"};
    const bool gone = std::find(kSavedNothing.begin(), kSavedNothing.end(), name) != kSavedNothing.end();
    return fmt::format("\"{}\"{}", name, gone ? ", which is no more: leaving it out saved no time" : "");
}

void read_order(TableReader& table, std::vector<Thinning>& order) {
    const Value* value = table.any("order");
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr) {
        table.error(
            *value, "order",
            fmt::format("is {}; it must be a list of some of {}", type_name(*value), all_thinnings()));
        return;
    }
    for (const Value& item : list->items) {
        const auto* text = std::get_if<std::string>(&item.data);
        const auto found =
            std::find_if(kThinningNames.begin(), kThinningNames.end(),
                         [text](const ThinningName& each) { return text != nullptr && each.name == *text; });
        if (found == kThinningNames.end()) {
            table.error(item, "order",
                        fmt::format("holds {}; it must be a list of some of {}",
                                    text == nullptr ? std::string(type_name(item)) : told_of(*text),
                                    all_thinnings()));
            continue;
        }
        const Thinning thinning = found->thinning;
        if (std::find(order.begin(), order.end(), thinning) != order.end()) {
            table.error(item, "order", fmt::format("holds \"{}\" twice", *text));
            continue;
        }
        order.push_back(thinning);
    }
}

}  // namespace

void read_daemon(TableReader& table, Daemon& daemon) {
    table.number("rate_hz", daemon.rate_hz, {1.0, 240.0, "Hz"});
    table.choice("pace", daemon.pacing, kPacingNames);
    if (daemon.pacing == Pacing::kHost) {
        table.number("host_wait_ms", daemon.host_wait_ms, {0.1, 1000.0, "ms"});
        table.integer("host_frames_behind", daemon.host_frames_behind, 0, 2, "frames");
    } else {
        for (const std::string_view key : {"host_wait_ms", "host_frames_behind"}) {
            if (const Value* value = table.any(key); value != nullptr)
                table.error(*value, key, "is of no use unless pace is \"host\"");
        }
    }
    table.number("display_delay_ms", daemon.display_delay_ms, {0.0, 500.0, "ms"});
    table.finish();
}

void check_pacing(TableReader& daemon, const Config& config) {
    const Value* pace = daemon.any("pace");
    if (pace == nullptr) return;
    if (config.daemon.pacing == Pacing::kDisplay &&
        (config.output.kind != OutputKind::kWindow || !config.output.vsync)) {
        daemon.error(*pace, "pace",
                     "is \"display\", which needs kind = \"window\" and vsync = true in [output]");
    }
    if (config.daemon.pacing == Pacing::kHost && !config.host.enabled)
        daemon.error(*pace, "pace", "is \"host\", but enabled = false in [host]");
}

void read_overload(TableReader table, Overload& overload) {
    read_order(table, overload.order);
    std::vector<std::string> order;
    for (const Thinning thinning : overload.order)
        order.emplace_back(thinning_name(thinning));
    table.describe("order", fmt::format("list of {}", all_thinnings()), to_toml(order));
    table.number("thin_above_pct", overload.thin_above_pct, {10.0, 200.0, "%"});
    table.integer("thin_after_frames", overload.thin_after_frames, 1, 10'000, "frames");
    const Value* below = table.number("return_below_pct", overload.return_below_pct, {5.0, 200.0, "%"});
    table.integer("return_after_frames", overload.return_after_frames, 1, 1'000'000, "frames");
    if (overload.return_below_pct >= overload.thin_above_pct) {
        const Value* at = below != nullptr ? below : table.any("thin_above_pct");
        if (at != nullptr) {
            table.error(
                *at, below != nullptr ? "return_below_pct" : "thin_above_pct",
                fmt::format("leaves no room between return_below_pct ({:g}) and thin_above_pct ({:g}): "
                            "what is left out would come and go",
                            overload.return_below_pct, overload.thin_above_pct));
        }
    }
    table.finish();
}

}  // namespace skyig::config
