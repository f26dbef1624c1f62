// A sorted list that never grows beyond what it has reserved.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace skyig::server::world {

/// Puts `item` at its place, over the one of the same key if there is one. \return where it stands and
/// whether it is new there, or nothing when there is no room.
struct Stored {
    std::size_t index = 0;
    bool added = false;
};

template <class Item, class Key>
std::optional<Stored> store_sorted(std::vector<Item>& items, const Item& item, std::size_t most,
                                   Key key) noexcept {
    const auto place = std::lower_bound(items.begin(), items.end(), item,
                                        [key](const Item& a, const Item& b) { return key(a) < key(b); });
    const auto index = static_cast<std::size_t>(place - items.begin());
    if (place != items.end() && key(*place) == key(item)) {
        *place = item;
        return Stored{index, false};
    }
    if (items.size() >= most) return std::nullopt;
    items.insert(place, item);
    return Stored{index, true};
}

}  // namespace skyig::server::world
