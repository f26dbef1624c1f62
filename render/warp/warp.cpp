#include "render/warp/warp.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skyig::render::warp {

namespace {

constexpr int kSamples = 65;     // on a side of the screen, to measure it
constexpr double kBeyond = 1.0;  // how far off the screen the inverse may lie
constexpr double kMargin = 0.2;  // of what is shown, that the inverse knows around it
constexpr double kSlopeStep = 1e-4;

std::size_t index(int column, int row) noexcept {
    return static_cast<std::size_t>(row) * Warp::kNodes + static_cast<std::size_t>(column);
}

bool on_screen(const glm::dvec2& screen, double beyond) noexcept {
    return screen.x >= -beyond && screen.x <= 1.0 + beyond && screen.y >= -beyond && screen.y <= 1.0 + beyond;
}

}  // namespace

Warp::Warp(Mesh mesh, int width_px, int height_px) : mesh_(std::move(mesh)) {
    measure_shown();
    invert();
    settle({width_px, height_px});
}

Warp::Place Warp::place(double at, int count) const noexcept {
    const double node = mesh_.at_edges ? at * (count - 1) : at * count - 0.5;
    const int low = std::clamp(static_cast<int>(std::floor(node)), 0, count - 2);
    return {low, node - low};
}

glm::dvec2 Warp::node(int column, int row) const noexcept {
    return glm::dvec2{mesh_.picture[static_cast<std::size_t>(row) * static_cast<std::size_t>(mesh_.columns) +
                                    static_cast<std::size_t>(column)]};
}

namespace {

// From an end node outwards: a parabola for the half share of screen that is left, then straight on.
glm::dvec2 outwards(const glm::dvec2& end, const glm::dvec2& slope, const glm::dvec2& bend,
                    double t) noexcept {
    constexpr double kHalf = 0.5;
    if (t <= kHalf) return end + t * slope + 0.5 * t * t * bend;
    return end + t * slope + kHalf * (t - 0.5 * kHalf) * bend;
}

// Catmull and Rom 1974, tension 1/2.
glm::dvec2 spline(const glm::dvec2& before, const glm::dvec2& low, const glm::dvec2& high,
                  const glm::dvec2& after, double t) noexcept {
    const glm::dvec2 slope_low = 0.5 * (high - before);
    const glm::dvec2 slope_high = 0.5 * (after - low);
    if (t < 0.0) return outwards(low, -slope_low, before - 2.0 * low + high, -t);
    if (t > 1.0) return outwards(high, slope_high, low - 2.0 * high + after, t - 1.0);
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * low + (t3 - 2.0 * t2 + t) * slope_low +
           (3.0 * t2 - 2.0 * t3) * high + (t3 - t2) * slope_high;
}

// The neighbour beyond an end that goes on as evenly as four nodes tell: a parabola through the last three.
glm::dvec2 beyond(const glm::dvec2& last, const glm::dvec2& second, const glm::dvec2& third) noexcept {
    return 3.0 * last - 3.0 * second + third;
}

template <class At>
glm::dvec2 spline_of(At at, int count, int low, double t) noexcept {
    const glm::dvec2 a = at(low);
    const glm::dvec2 b = at(low + 1);
    const glm::dvec2 before = low > 0 ? at(low - 1) : count > 2 ? beyond(a, b, at(low + 2)) : 2.0 * a - b;
    const glm::dvec2 after = low + 2 < count ? at(low + 2)
                             : count > 2     ? beyond(b, a, at(low - 1))
                                             : 2.0 * b - a;
    return spline(before, a, b, after, t);
}

}  // namespace

glm::dvec2 Warp::along_row(int row, const Place& column) const noexcept {
    return spline_of([&](int c) { return node(c, row); }, mesh_.columns, column.node, column.share);
}

glm::dvec2 Warp::picture_of(const glm::dvec2& screen) const noexcept {
    const Place column = place(screen.x, mesh_.columns);
    const Place row = place(screen.y, mesh_.rows);
    return spline_of([&](int r) { return along_row(r, column); }, mesh_.rows, row.node, row.share);
}

glm::dmat2 Warp::slopes(const glm::dvec2& screen) const noexcept {
    const glm::dvec2 across{kSlopeStep, 0.0};
    const glm::dvec2 up{0.0, kSlopeStep};
    return {(picture_of(screen + across) - picture_of(screen - across)) / (2.0 * kSlopeStep),
            (picture_of(screen + up) - picture_of(screen - up)) / (2.0 * kSlopeStep)};
}

double Warp::area_ratio(const glm::dvec2& screen) const noexcept {
    return std::abs(glm::determinant(slopes(screen)));
}

// Newton's method, its steps held to a fifth of the screen.
glm::dvec2 Warp::solved(const glm::dvec2& picture, glm::dvec2 guess, bool& good) const noexcept {
    constexpr int kSteps = 30;
    constexpr double kLongest = 0.2;
    good = false;
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec2 off = picture - picture_of(guess);
        if (glm::length(off) < 1e-9) {
            good = on_screen(guess, kBeyond);
            return guess;
        }
        const glm::dmat2 slope = slopes(guess);
        if (!(std::abs(glm::determinant(slope)) > 1e-9)) return guess;
        glm::dvec2 step = glm::inverse(slope) * off;
        const double length = glm::length(step);
        if (length > kLongest) step *= kLongest / length;
        guess += step;
        if (!on_screen(guess, 2.0 * kBeyond)) return guess;
    }
    return guess;
}

std::optional<glm::dvec2> Warp::screen_of(const glm::dvec2& picture) const noexcept {
    bool good = false;
    const glm::dvec2 found = solved(picture, drawn_at(picture), good);
    return good ? std::optional{found} : std::nullopt;
}

glm::dvec2 Warp::drawn_at(const glm::dvec2& picture) const noexcept {
    const glm::dvec2 clip = 2.0 * picture - 1.0;
    const glm::dvec4 by{node_place_};
    const double last = kNodes - 1;
    const glm::dvec2 at = glm::clamp(clip * glm::dvec2{by.x, by.y} + glm::dvec2{by.z, by.w}, 0.0, last);
    const int column = std::min(static_cast<int>(at.x), kNodes - 2);
    const int row = std::min(static_cast<int>(at.y), kNodes - 2);
    const glm::dvec2 share = at - glm::dvec2{column, row};
    const auto moved = [&](int right, int up) {
        const glm::vec4& node = nodes_[index(column + right, row + up)];
        return glm::dvec2{node.x, node.y};
    };
    const glm::dvec2 low = glm::mix(moved(0, 0), moved(1, 0), share.x);
    const glm::dvec2 high = glm::mix(moved(0, 1), moved(1, 1), share.x);
    return picture + 0.5 * glm::mix(low, high, share.y);
}

void Warp::measure_shown() noexcept {
    glm::dvec2 low{1e9};
    glm::dvec2 high{-1e9};
    finest_pixel_ = 1e9;
    smallest_area_ = 1e9;
    for (int i = 0; i < kSamples * kSamples; ++i) {
        const glm::dvec2 screen = glm::dvec2{i % kSamples, i / kSamples} / (kSamples - 1.0);
        const glm::dvec2 picture = picture_of(screen);
        low = glm::min(low, picture);
        high = glm::max(high, picture);
        const glm::dmat2 slope = slopes(screen);
        finest_pixel_ = std::min(finest_pixel_, std::max(glm::length(slope[0]), glm::length(slope[1])));
        smallest_area_ = std::min(smallest_area_, std::abs(glm::determinant(slope)));
    }
    shown_ = {low, high};
}

void Warp::invert() {
    const glm::dvec2 low{shown_.x, shown_.y};
    const glm::dvec2 high{shown_.z, shown_.w};
    const glm::dvec2 from = low - kMargin * (high - low);
    const glm::dvec2 step = (1.0 + 2.0 * kMargin) * (high - low) / (kNodes - 1.0);
    // A place of the picture is half of one in clip space, and a half.
    node_place_ = glm::vec4{0.5 / step.x, 0.5 / step.y, (0.5 - from.x) / step.x, (0.5 - from.y) / step.y};
    nodes_.assign(std::size_t{kNodes} * kNodes, glm::vec4{0.0F, 0.0F, 1.0F, 0.0F});
    std::vector<bool> good(nodes_.size(), false);
    glm::dvec2 row_start{0.0};
    for (int row = 0; row < kNodes; ++row) {
        glm::dvec2 guess = row_start;
        for (int column = 0; column < kNodes; ++column) {
            const glm::dvec2 picture = from + step * glm::dvec2{column, row};
            bool found = false;
            glm::dvec2 screen = solved(picture, guess, found);
            if (!found) screen = solved(picture, glm::dvec2{0.5}, found);
            if (!found) continue;
            guess = screen;
            if (column == 0) row_start = screen;
            good[index(column, row)] = true;
            nodes_[index(column, row)] =
                glm::vec4{glm::dvec4{2.0 * (screen - picture), std::max(area_ratio(screen), 1e-6), 0.0}};
        }
    }
    fill_gaps(good);
}

// Places far off the screen may have none there: they go with their neighbours.
void Warp::fill_gaps(std::vector<bool>& good) noexcept {
    for (int round = 0; round < kNodes; ++round) {
        bool whole = true;
        for (int i = 0; i < kNodes * kNodes; ++i) {
            const int column = i % kNodes;
            const int row = i / kNodes;
            if (good[index(column, row)]) continue;
            whole = false;
            for (const auto& [right, up] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                const int c = column + right;
                const int r = row + up;
                if (c < 0 || c >= kNodes || r < 0 || r >= kNodes || !good[index(c, r)]) continue;
                nodes_[index(column, row)] = nodes_[index(c, r)];
                good[index(column, row)] = true;
                break;
            }
        }
        if (whole) return;
    }
}

void Warp::settle(const glm::dvec2& size_px) noexcept {
    is_identity_ = true;
    for (glm::vec4& node : nodes_) {
        const glm::dvec2 moved_px = 0.5 * glm::dvec2{node.x, node.y} * size_px;
        if (glm::length(moved_px) < kNone_px)
            node = {0.0F, 0.0F, std::abs(node.z - 1.0F) < 1e-3F ? 1.0F : node.z, 0.0F};
        else
            is_identity_ = false;
    }
    if (is_identity_) {
        shown_ = {0.0, 0.0, 1.0, 1.0};
        finest_pixel_ = smallest_area_ = 1.0;
    }
    most_bend_px_ = 0.0;
    for (int row = 1; row + 1 < kNodes; ++row) {
        for (int column = 1; column + 1 < kNodes; ++column)
            most_bend_px_ = std::max(most_bend_px_, bend_px(index(column, row), size_px));
    }
}

// Second derivative of the way to the screen, pixels, along the worst line of the picture; only of what
// shows.
double Warp::bend_px(std::size_t node, const glm::dvec2& size_px) const noexcept {
    const glm::dvec2 step{0.5 / static_cast<double>(node_place_.x), 0.5 / static_cast<double>(node_place_.y)};
    const auto moved = [&](std::size_t i) { return 0.5 * glm::dvec2{nodes_[i].x, nodes_[i].y} * size_px; };
    const glm::dvec2 from = (0.5 - glm::dvec2{node_place_.z, node_place_.w} * step);
    const glm::dvec2 picture = from + step * glm::dvec2{node % kNodes, node / kNodes};
    if (!on_screen(picture + moved(node) / size_px, 0.05)) return 0.0;
    const glm::dvec2 here = 2.0 * moved(node);
    const double across = glm::length(moved(node - 1) + moved(node + 1) - here) / (step.x * step.x);
    const double up = glm::length(moved(node - kNodes) + moved(node + kNodes) - here) / (step.y * step.y);
    const double aslant = glm::length(moved(node + kNodes + 1) - moved(node + kNodes - 1) -
                                      moved(node - kNodes + 1) + moved(node - kNodes - 1)) /
                          (4.0 * step.x * step.y);
    return std::max({across, up, 0.5 * (across + up) + aslant});
}

double Warp::longest_line(double error_px) const noexcept {
    return std::sqrt(8.0 * error_px / std::max(most_bend_px_, 1e-6));
}

}  // namespace skyig::render::warp
