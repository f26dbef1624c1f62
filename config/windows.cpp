// The [[window]] tables and [channel.viewport]: each for itself, then against one another.
#include <fmt/format.h>

#include "config/schema.h"

namespace skyig::config {
namespace {

/// On the desktop; a window that covers a monitor has none of its own.
void read_place(TableReader& table, bool covers_monitor, Window& window) {
    if (covers_monitor) {
        for (const std::string_view key : {"x_px", "y_px", "width_px", "height_px", "frame"}) {
            if (const Value* value = table.any(key); value != nullptr)
                table.error(*value, key,
                            "stands beside monitor, which the window covers whole; give one of them");
        }
        return;
    }
    table.integer("x_px", window.x_px, -kMaxDesktop_px, kMaxDesktop_px, "pixels");
    table.integer("y_px", window.y_px, -kMaxDesktop_px, kMaxDesktop_px, "pixels");
    table.integer("width_px", window.width_px, 1, kMaxChannelSize_px, "pixels");
    table.integer("height_px", window.height_px, 1, kMaxChannelSize_px, "pixels");
    table.boolean("frame", window.frame);
}

void read_window(TableReader& table, Window& window) {
    const Value* name = table.text("name", window.name);
    table.require("name", "a short text such as \"left\"");
    if (name != nullptr && !is_short_name(window.name)) {
        table.error(*name, "name",
                    fmt::format("is \"{}\"; it must be 1..32 of letters, digits, '-' and '_'", window.name));
    }
    const Value* monitor = table.text("monitor", window.monitor);
    if (monitor != nullptr && window.monitor.empty())
        table.error(*monitor, "monitor",
                    "is empty; it must be a monitor's name or number, or be left out for a window");
    read_place(table, monitor != nullptr, window);
    table.finish();
}

/// One framed window for each channel, one beside the other.
void stand_in(Config& config) {
    int x_px = 0;
    for (std::size_t i = 0; i < config.channels.size(); ++i) {
        Channel& channel = config.channels[i];
        Window& window = config.windows.emplace_back();
        window.name = channel.name;
        window.x_px = x_px;
        window.width_px = channel.width_px;
        window.height_px = channel.height_px;
        channel.viewport = Viewport{.window = static_cast<int>(i)};
        x_px += channel.width_px;
    }
}

/// Of a window on the desktop, whose size is known.
void check_inside(ErrorList& errors, const Channel& channel, const Place& place, const std::string& path,
                  const Window& window) {
    const Viewport& view = *channel.viewport;
    const int right_px = view.x_px + (view.width_px > 0 ? view.width_px : channel.width_px);
    const int bottom_px = view.y_px + (view.height_px > 0 ? view.height_px : channel.height_px);
    if (!window.monitor.empty() || (right_px <= window.width_px && bottom_px <= window.height_px)) return;
    errors.add(place, path,
               fmt::format("reaches to {} x {} pixels; window \"{}\" has {} x {}", right_px, bottom_px,
                           window.name, window.width_px, window.height_px));
}

}  // namespace

void read_windows(TableReader& root, ErrorList& errors, std::vector<Window>& windows) {
    const Value* value = root.any("window");
    if (value == nullptr) return;
    const auto* list = std::get_if<Array>(&value->data);
    if (list == nullptr || list->items.size() > kMaxWindows) {
        root.error(*value, "window",
                   fmt::format("must be 1 to {} tables: write [[window]] in double brackets", kMaxWindows));
        return;
    }
    for (const Value& item : list->items) {
        const auto* table = std::get_if<Table>(&item.data);
        const std::string path = fmt::format("window[{}]", windows.size() + 1);
        if (table == nullptr) {
            root.error(item, "window", fmt::format("holds {}; write [[window]] tables", type_name(item)));
            return;
        }
        TableReader reader(errors, table, item.place, path);
        Window window;
        read_window(reader, window);
        for (const Window& other : windows) {
            if (is_short_name(window.name) && other.name == window.name)
                errors.add(item.place, path + ".name", fmt::format("is \"{}\" a second time", window.name));
        }
        windows.push_back(std::move(window));
    }
}

void read_viewport(TableReader& table, ErrorList& errors, const std::vector<Window>& windows,
                   Channel& channel) {
    const Value* key = table.any("viewport");
    if (key == nullptr) return;
    TableReader own = table.table("viewport");
    Viewport view;
    std::vector<std::string_view> names;
    for (const Window& window : windows)
        names.push_back(window.name);
    std::size_t index = 0;
    const Value* window = nullptr;
    if (names.empty()) {
        table.error(*key, "viewport", "has no window to lie in; add a [[window]] with its name");
    } else {
        window = own.choice("window", index, names);
        own.require("window", "the name of a [[window]]");
    }
    view.window = static_cast<int>(index);
    own.integer("x_px", view.x_px, 0, kMaxDesktop_px, "pixels");
    own.integer("y_px", view.y_px, 0, kMaxDesktop_px, "pixels");
    std::optional<int> width_px, height_px;
    own.integer("width_px", width_px, 1, kMaxChannelSize_px, "pixels");
    own.integer("height_px", height_px, 1, kMaxChannelSize_px, "pixels");
    view.width_px = width_px.value_or(view.width_px);
    view.height_px = height_px.value_or(view.height_px);
    if (names.empty()) return;
    own.finish();
    channel.viewport = view;
    if (window != nullptr)
        check_inside(errors, channel, key->place, table.key_path("viewport"), windows[index]);
}

void place_channels(ErrorList& errors, Config& config) {
    if (config.windows.empty()) {
        if (config.output.kind == OutputKind::kWindow) stand_in(config);
        return;
    }
    for (std::size_t i = 0; i < config.channels.size(); ++i) {
        if (config.channels[i].viewport || !errors.empty()) continue;
        errors.add({}, fmt::format("channel[{}].viewport", i + 1),
                   "is missing; where there are [[window]] tables each channel says which one shows it");
    }
}

}  // namespace skyig::config
