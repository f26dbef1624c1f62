// The warp of a channel: its screen shows another picture than its frustum's flat one, moved so that it looks
// straight on the surface it falls on. Free of GL.
//
// Places are parts of a whole, right and up from the lower left corner: of the screen (the raster that is put
// out) and of the picture (the frustum's image plane). What is drawn are directions, so that drawing needs
// the way from the picture to the screen, and files hold the other way.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace skyig::render::warp {

/// What each node of a screen shows. Rows from the lowest.
struct Mesh {
    /// Each >= 2.
    int columns = 0;
    int rows = 0;
    /// Whether the outer nodes stand on the screen's edges; else each in the middle of its share of the
    /// screen, like a pixel.
    bool at_edges = false;
    /// Places of the picture, finite; cells must not fold over.
    std::vector<glm::vec2> picture;
};

class Warp {
  public:
    /// Nodes of the inverse on a side.
    static constexpr int kNodes = 161;
    /// Displacements below this count as none: what a file's floats make of an identity.
    static constexpr double kNone_px = 1e-3;

    /// Takes some 30 ms. \param width_px, height_px  of the screen
    Warp(Mesh mesh, int width_px, int height_px);

    /// Place of the picture that a place of the screen shows: between nodes a Catmull-Rom spline, beyond the
    /// outer ones a parabola, and straight on off the screen.
    [[nodiscard]] glm::dvec2 picture_of(const glm::dvec2& screen) const noexcept;
    /// The other way, exact; none where no place within a whole screen of the screen shows it.
    [[nodiscard]] std::optional<glm::dvec2> screen_of(const glm::dvec2& picture) const noexcept;
    /// The same as shaders have it: linear between nodes().
    [[nodiscard]] glm::dvec2 drawn_at(const glm::dvec2& picture) const noexcept;
    /// Size of a bit of the picture over that of the bit of screen that shows it, both parts of a whole.
    [[nodiscard]] double area_ratio(const glm::dvec2& screen) const noexcept;

    /// As common/place.glsl takes them: (right, up) from the picture's place to the screen's, each in
    /// clip space (-1..1), area_ratio(), 0; rows from the lowest.
    [[nodiscard]] std::span<const glm::vec4> nodes() const noexcept { return nodes_; }
    /// (scale, shift) of a place in clip space to a node's number.
    [[nodiscard]] const glm::vec4& node_place() const noexcept { return node_place_; }
    [[nodiscard]] bool is_identity() const noexcept { return is_identity_; }

    /// The part of the picture that is shown: left, bottom, right, top.
    [[nodiscard]] const glm::dvec4& shown() const noexcept { return shown_; }
    /// Of the screen's pixels by those of the flat picture: the least angle, the least area.
    [[nodiscard]] double finest_pixel() const noexcept { return finest_pixel_; }
    [[nodiscard]] double smallest_area() const noexcept { return smallest_area_; }
    /// Longest line of the picture, in parts of it, that is drawn straight and off by no more than that.
    [[nodiscard]] double longest_line(double error_px) const noexcept;

  private:
    struct Place {
        int node = 0;
        double share = 0.0;
    };
    [[nodiscard]] Place place(double at, int count) const noexcept;
    [[nodiscard]] glm::dvec2 node(int column, int row) const noexcept;
    [[nodiscard]] glm::dvec2 along_row(int row, const Place& column) const noexcept;
    [[nodiscard]] glm::dmat2 slopes(const glm::dvec2& screen) const noexcept;
    [[nodiscard]] glm::dvec2 solved(const glm::dvec2& picture, glm::dvec2 guess, bool& good) const noexcept;
    void measure_shown() noexcept;
    void invert();
    void fill_gaps(std::vector<bool>& good) noexcept;
    void settle(const glm::dvec2& size_px) noexcept;
    [[nodiscard]] double bend_px(std::size_t node, const glm::dvec2& size_px) const noexcept;

    Mesh mesh_;
    std::vector<glm::vec4> nodes_;
    glm::vec4 node_place_{1.0F, 1.0F, 0.0F, 0.0F};
    glm::dvec4 shown_{0.0, 0.0, 1.0, 1.0};
    double finest_pixel_ = 1.0;
    double smallest_area_ = 1.0;
    double most_bend_px_ = 0.0;
    bool is_identity_ = false;
};

}  // namespace skyig::render::warp
