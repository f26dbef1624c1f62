#include "render/cloud/impostor/atlas_rectangles.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "render/cloud/impostor/picture.h"

namespace skyig::render::cloud::impostor {

RectangleAtlas::RectangleAtlas(const AtlasSettings& settings)
    : Atlas(settings), blocks_(settings.size / kSizeStep) {
    const auto count = static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y);
    taken_.resize(count);
    right_.resize(count);
    down_.resize(count);
    free_blocks_ = count;
    places_.assign(sizes_.size(), glm::ivec2{-1});
    if (settings.scheme == AtlasScheme::kDefragmented) {
        new_places_ = places_;
        order_.reserve(sizes_.size());
        scratch_.resize(texels_.size());
    }
}

void RectangleAtlas::mark(glm::ivec2 place, glm::ivec2 size, bool taken) noexcept {
    for (int y = place.y; y < place.y + size.y; ++y) {
        const auto row = taken_.begin() + static_cast<std::ptrdiff_t>(y) * blocks_.x + place.x;
        std::fill_n(row, size.x, static_cast<std::uint8_t>(taken));
    }
}

glm::ivec2 RectangleAtlas::best_place(glm::ivec2 size) noexcept {
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_.x) +
               static_cast<std::size_t>(x);
    };
    for (int y = blocks_.y - 1; y >= 0; --y) {
        for (int x = blocks_.x - 1; x >= 0; --x) {
            const std::size_t i = at(x, y);
            const bool taken = taken_[i] != 0;
            const int to_right = x + 1 < blocks_.x ? right_[i + 1] : 0;
            const int to_down = y + 1 < blocks_.y ? down_[at(x, y + 1)] : 0;
            right_[i] = static_cast<std::int16_t>(taken ? 0 : to_right + 1);
            down_[i] = static_cast<std::int16_t>(taken ? 0 : to_down + 1);
        }
    }
    glm::ivec2 best{-1};
    int least = std::numeric_limits<int>::max();
    for (int y = 0; y + size.y <= blocks_.y; ++y) {
        for (int x = 0; x + size.x <= blocks_.x; ++x) {
            const std::size_t i = at(x, y);
            // Only where something ends on the left and above: any other place wastes both sides.
            if (right_[i] < size.x || down_[i] < size.y) continue;
            if (x > 0 && right_[i - 1] > 0 && y > 0 && down_[at(x, y - 1)] > 0) continue;
            const int left_over = std::min(right_[i] - size.x, down_[i] - size.y);
            if (left_over >= least) continue;
            bool fits = true;
            for (int row = 1; row < size.y && fits; ++row)
                fits = right_[at(x, y + row)] >= size.x;
            if (!fits) continue;
            best = {x, y};
            least = left_over;
        }
    }
    return best;
}

bool RectangleAtlas::take(Id id, glm::ivec2 size) noexcept {
    const glm::ivec2 blocks = size / kSizeStep;
    const auto needed = static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y);
    const glm::ivec2 place = needed <= free_blocks_ ? best_place(blocks) : glm::ivec2{-1};
    if (place.x < 0) {
        cramped_ = true;
        return false;
    }
    mark(place, blocks, true);
    free_blocks_ -= needed;
    places_[static_cast<std::size_t>(id)] = place;
    return true;
}

void RectangleAtlas::give_back(Id id) noexcept {
    glm::ivec2& place = places_[static_cast<std::size_t>(id)];
    const glm::ivec2 blocks = size(id) / kSizeStep;
    mark(place, blocks, false);
    free_blocks_ += static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y);
    place = glm::ivec2{-1};
}

void RectangleAtlas::write(Id id, const Texel* picture) noexcept {
    const glm::ivec2 place = places_[static_cast<std::size_t>(id)] * kSizeStep;
    const glm::ivec2 count = size(id);
    for (int y = 0; y < count.y; ++y)
        std::copy_n(picture + static_cast<std::ptrdiff_t>(y) * count.x, count.x, texel(place.x, place.y + y));
}

const Texel* RectangleAtlas::corner(Id id, glm::ivec2 at, int& stride) const noexcept {
    const glm::ivec2 place = places_[static_cast<std::size_t>(id)] * kSizeStep + at;
    stride = settings_.size.x;
    return texel(place.x, place.y);
}

bool RectangleAtlas::tidy(double time_s) noexcept {
    if (settings_.scheme != AtlasScheme::kDefragmented) return false;
    const double interval_s = 1.0 / settings_.defragmentations_per_s;
    // A clock that went back must not hold it up.
    if (timed_ && time_s < next_s_ && time_s > next_s_ - 2.0 * interval_s) return false;
    if (!std::exchange(cramped_, false)) return false;
    next_s_ = time_s + interval_s;
    timed_ = true;
    return repack();
}

bool RectangleAtlas::repack() noexcept {
    order_.clear();
    for (std::size_t id = 0; id < places_.size(); ++id) {
        if (places_[id].x >= 0) order_.push_back(static_cast<Id>(id));
    }
    std::sort(order_.begin(), order_.end(), [this](Id a, Id b) {
        const glm::ivec2 one = size(a);
        const glm::ivec2 other = size(b);
        if (one.y != other.y) return one.y > other.y;
        return one.x != other.x ? one.x > other.x : a < b;
    });
    std::fill(taken_.begin(), taken_.end(), std::uint8_t{0});
    bool fits = true;
    for (const Id id : order_) {
        const glm::ivec2 blocks = size(id) / kSizeStep;
        const glm::ivec2 place = best_place(blocks);
        new_places_[static_cast<std::size_t>(id)] = place;
        fits = place.x >= 0;
        if (!fits) break;
        mark(place, blocks, true);
    }
    if (fits) {
        scratch_.swap(texels_);
        for (const Id id : order_) {
            const auto i = static_cast<std::size_t>(id);
            const glm::ivec2 from = places_[i] * kSizeStep;
            places_[i] = new_places_[i];
            const glm::ivec2 to = places_[i] * kSizeStep;
            for (int y = 0; y < size(id).y; ++y)
                std::copy_n(
                    scratch_.data() + static_cast<std::ptrdiff_t>(from.y + y) * settings_.size.x + from.x,
                    size(id).x, texel(to.x, to.y + y));
        }
        return true;
    }
    std::fill(taken_.begin(), taken_.end(), std::uint8_t{0});
    for (const Id id : order_)
        mark(places_[static_cast<std::size_t>(id)], size(id) / kSizeStep, true);
    return false;
}

std::size_t RectangleAtlas::free_texels() const noexcept {
    return free_blocks_ * static_cast<std::size_t>(kSizeStep * kSizeStep);
}

void RectangleAtlas::places(Id id, std::vector<glm::ivec4>& out) const {
    const glm::ivec2 place = places_[static_cast<std::size_t>(id)] * kSizeStep;
    out.emplace_back(place, size(id));
}

}  // namespace skyig::render::cloud::impostor
