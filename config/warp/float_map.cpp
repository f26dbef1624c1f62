#include "config/warp/float_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace skyig::config::warp {
namespace {

constexpr int kMostSide = 16384;
constexpr float kLeastPlace = -0.5F;
constexpr float kMostPlace = 1.5F;

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The header's words: each ends with one white character, more may stand before it.
class Header {
  public:
    explicit Header(std::string_view text) : text_(text) {}

    template <class T>
    bool number(T& out) {
        while (at_ < text_.size() && is_space(text_[at_]))
            ++at_;
        const std::size_t end = std::min(text_.find_first_of(" \t\n\r", at_), text_.size());
        const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + end, out);
        if (error != std::errc{} || stop != text_.data() + end || end == text_.size()) return false;
        at_ = end + 1;
        return true;
    }
    [[nodiscard]] std::size_t at() const noexcept { return at_; }

  private:
    std::string_view text_;
    std::size_t at_ = 2;
};

float float_of(const std::byte* bytes, bool little_endian) {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::byte, 4> four{};
    std::memcpy(four.data(), bytes, 4);
    if (!little_endian) std::reverse(four.begin(), four.end());
    return std::bit_cast<float>(four);
}

std::string not_finite(const FloatMap& map, std::size_t i) {
    const auto width = static_cast<std::size_t>(map.width);
    const std::size_t pixel = i / static_cast<std::size_t>(map.components);
    return fmt::format("holds no number at column {}, row {} from the lowest (infinite or NaN)",
                       pixel % width + 1, pixel / width + 1);
}

/// Bilinear, at a node's place counted in nodes of the map.
std::array<float, 2> place_at(const FloatMap& map, double column, double row) {
    const auto low = [](double at, int count) {
        return std::clamp(static_cast<int>(std::floor(at)), 0, std::max(count - 2, 0));
    };
    const int c = low(column, map.width);
    const int r = low(row, map.height);
    const auto across = static_cast<float>(column - c);
    const auto up = static_cast<float>(row - r);
    std::array<float, 2> place{};
    for (std::size_t k = 0; k < 2; ++k) {
        const auto at = [&](int right, int above) {
            const auto pixel = static_cast<std::size_t>(r + above) * static_cast<std::size_t>(map.width) +
                               static_cast<std::size_t>(c + right);
            return map.values[pixel * static_cast<std::size_t>(map.components) + k];
        };
        const float below = at(0, 0) + across * (at(1, 0) - at(0, 0));
        const float above = at(0, 1) + across * (at(1, 1) - at(0, 1));
        place[k] = below + up * (above - below);
    }
    return place;
}

WarpMesh thinned(const FloatMap& map, bool at_edges) {
    WarpMesh mesh{std::min(map.width, kMostWarpNodes), std::min(map.height, kMostWarpNodes), at_edges, {}};
    const auto of_map = [&](int node, int nodes, int count) {
        if (at_edges) return static_cast<double>(node) * (count - 1) / (nodes - 1);
        return (node + 0.5) * count / nodes - 0.5;
    };
    for (int row = 0; row < mesh.rows; ++row) {
        for (int column = 0; column < mesh.columns; ++column)
            mesh.picture.push_back(
                place_at(map, of_map(column, mesh.columns, map.width), of_map(row, mesh.rows, map.height)));
    }
    return mesh;
}

/// Twice the area of a triangle of nodes.
double area_of(const std::array<float, 2>& a, const std::array<float, 2>& b, const std::array<float, 2>& c) {
    return (static_cast<double>(b[0]) - static_cast<double>(a[0])) *
               (static_cast<double>(c[1]) - static_cast<double>(a[1])) -
           (static_cast<double>(b[1]) - static_cast<double>(a[1])) *
               (static_cast<double>(c[0]) - static_cast<double>(a[0]));
}

/// The first cell that lies over another, or has no area. \return empty if there is none
std::string folded_cell(const WarpMesh& mesh) {
    const auto node = [&](int column, int row) -> const std::array<float, 2>& {
        return mesh.picture[static_cast<std::size_t>(row) * static_cast<std::size_t>(mesh.columns) +
                            static_cast<std::size_t>(column)];
    };
    const bool mirrored = area_of(node(0, 0), node(1, 0), node(0, 1)) < 0.0;
    for (int row = 0; row + 1 < mesh.rows; ++row) {
        for (int column = 0; column + 1 < mesh.columns; ++column) {
            const double low = area_of(node(column, row), node(column + 1, row), node(column, row + 1));
            const double high =
                area_of(node(column + 1, row + 1), node(column, row + 1), node(column + 1, row));
            if ((mirrored ? std::max(low, high) < 0.0 : std::min(low, high) > 0.0)) continue;
            return fmt::format("folds over between columns {} and {}, rows {} and {} of {}x{}", column + 1,
                               column + 2, row + 1, row + 2, mesh.columns, mesh.rows);
        }
    }
    return {};
}

}  // namespace

FileRead<FloatMap> read_float_map(std::span<const std::byte> bytes) {
    const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    if (!text.starts_with("PF") && !text.starts_with("Pf"))
        return {std::nullopt, "is no PFM file: it begins with neither PF nor Pf"};
    FloatMap map;
    map.components = text[1] == 'F' ? 3 : 1;
    Header header(text.substr(0, 200));
    double scale = 0.0;
    if (!header.number(map.width) || !header.number(map.height) || !header.number(scale) ||
        !std::isfinite(scale) || scale == 0.0)
        return {std::nullopt, "has no PFM header: width, height and scale, each followed by white space"};
    if (map.width < 1 || map.height < 1 || map.width > kMostSide || map.height > kMostSide)
        return {std::nullopt, fmt::format("is {}x{}; sides must be 1..{}", map.width, map.height, kMostSide)};
    const auto count = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) *
                       static_cast<std::size_t>(map.components);
    if (bytes.size() - header.at() != 4 * count) {
        return {std::nullopt,
                fmt::format("has {} bytes of data; {}x{} of {} components need {}",
                            bytes.size() - header.at(), map.width, map.height, map.components, 4 * count)};
    }
    map.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        map.values[i] = float_of(bytes.data() + header.at() + 4 * i, scale < 0.0);
        if (!std::isfinite(map.values[i])) return {std::nullopt, not_finite(map, i)};
    }
    return {std::move(map), {}};
}

FileRead<WarpMesh> warp_mesh(const FloatMap& map, bool at_edges) {
    if (map.components < 2)
        return {std::nullopt, "has one component; a warp needs two, right and up (PF, not Pf)"};
    if (map.width < 2 || map.height < 2)
        return {std::nullopt, fmt::format("is {}x{}; a warp needs 2x2 nodes", map.width, map.height)};
    WarpMesh mesh = thinned(map, at_edges);
    for (std::size_t i = 0; i < mesh.picture.size(); ++i) {
        for (const float place : mesh.picture[i]) {
            if (place >= kLeastPlace && place <= kMostPlace) continue;
            const auto columns = static_cast<std::size_t>(mesh.columns);
            return {std::nullopt,
                    fmt::format("points to {:.4g} at column {}, row {} of {}x{}; places are parts of the "
                                "flat picture, {}..{}",
                                place, i % columns + 1, i / columns + 1, mesh.columns, mesh.rows, kLeastPlace,
                                kMostPlace)};
        }
    }
    if (std::string folded = folded_cell(mesh); !folded.empty()) return {std::nullopt, std::move(folded)};
    return {std::move(mesh), {}};
}

}  // namespace skyig::config::warp
