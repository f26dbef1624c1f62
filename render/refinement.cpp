#include "render/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skyig::render {

namespace {
constexpr std::size_t kSlots = 65'536;  // a power of two, well above kMostAdded
}  // namespace

void Refinement::refine(std::span<const std::uint32_t> indices, std::span<const float> vertices,
                        std::size_t floats, double longest_rad) {
    // Chords.
    double longest = 2.0 * std::sin(0.5 * std::min(longest_rad, 3.0));
    while (!refine_to(indices, vertices, floats, longest))
        longest *= 1.5;
}

bool Refinement::refine_to(std::span<const std::uint32_t> indices, std::span<const float> vertices,
                           std::size_t floats, double longest) {
    vertex_count_ = static_cast<std::uint32_t>(vertices.size() / floats);
    indices_.clear();
    first_of_triangle_.clear();
    middles_.clear();
    slots_.assign(kSlots, 0);
    directions_.clear();
    for (std::size_t i = 0; i < vertex_count_; ++i)
        directions_.insert(directions_.end(),
                           {vertices[i * floats], vertices[i * floats + 1], vertices[i * floats + 2]});
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        first_of_triangle_.push_back(indices_.size());
        if (std::max({indices[i], indices[i + 1], indices[i + 2]}) >= vertex_count_) continue;
        cut(indices[i], indices[i + 1], indices[i + 2], longest * longest);
        if (middles_.size() >= kMostAdded) return false;
    }
    first_of_triangle_.push_back(indices_.size());
    return true;
}

double Refinement::length_squared(std::uint32_t a, std::uint32_t b) const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double apart = static_cast<double>(directions_[3 * std::size_t{a} + i]) -
                             static_cast<double>(directions_[3 * std::size_t{b} + i]);
        sum += apart * apart;
    }
    return sum;
}

// Both triangles of an edge cut it alike, so that no gap opens: its length alone decides.
void Refinement::cut(std::uint32_t a, std::uint32_t b, std::uint32_t c, double longest_squared) {
    const double ab = length_squared(a, b);
    const double bc = length_squared(b, c);
    const double ca = length_squared(c, a);
    if (std::max({ab, bc, ca}) <= longest_squared || middles_.size() >= kMostAdded) {
        indices_.insert(indices_.end(), {a, b, c});
        return;
    }
    if (bc >= ab && bc >= ca) {
        std::swap(a, b);
        std::swap(b, c);
    } else if (ca >= ab) {
        std::swap(a, c);
        std::swap(b, c);
    }
    const std::uint32_t middle = middle_of(a, b);
    cut(a, middle, c, longest_squared);
    cut(middle, b, c, longest_squared);
}

std::uint32_t Refinement::middle_of(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    std::size_t slot = (std::size_t{a} * 0x9E3779B1U ^ std::size_t{b} * 0x85EBCA77U) >> 7U & (kSlots - 1);
    while (slots_[slot] != 0) {
        const std::uint32_t held = slots_[slot] - 1;
        if (middles_[held].a == a && middles_[held].b == b) return vertex_count_ + held;
        slot = (slot + 1) & (kSlots - 1);
    }
    const auto number = static_cast<std::uint32_t>(middles_.size());
    slots_[slot] = number + 1;
    middles_.push_back({a, b});
    for (std::size_t i = 0; i < 3; ++i)
        directions_.push_back(0.5F *
                              (directions_[3 * std::size_t{a} + i] + directions_[3 * std::size_t{b} + i]));
    return vertex_count_ + number;
}

IndexRange Refinement::range(const IndexRange& range) const noexcept {
    const std::size_t first = first_of_triangle_[range.first / 3];
    return {first, first_of_triangle_[(range.first + range.count) / 3] - first};
}

std::span<const float> Refinement::added(std::span<const float> vertices, std::size_t floats) {
    added_.resize(middles_.size() * floats);
    for (std::size_t i = 0; i < middles_.size(); ++i) {
        const auto values = [&](std::uint32_t vertex) {
            return vertex < vertex_count_ ? vertices.data() + std::size_t{vertex} * floats
                                          : added_.data() + std::size_t{vertex - vertex_count_} * floats;
        };
        const float* a = values(middles_[i].a);
        const float* b = values(middles_[i].b);
        for (std::size_t k = 0; k < floats; ++k)
            added_[i * floats + k] = 0.5F * (a[k] + b[k]);
    }
    return added_;
}

}  // namespace skyig::render
