// Vertices of interleaved floats, with or without indices, that are rewritten now and then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace skyig::render::gl {

class Mesh {
  public:
    /// \param components   floats of each vertex attribute, in order of location (0, 1, ...)
    /// \param max_vertices storage is allocated once
    Mesh(std::initializer_list<int> components, std::size_t max_vertices);
    ~Mesh();
    Mesh(Mesh&& other) noexcept;
    Mesh& operator=(Mesh&& other) noexcept;
    Mesh(const Mesh&) = delete;
    Mesh& operator=(const Mesh&) = delete;

    /// Triangles, three indices each. Storage is made anew only when it must grow.
    void set_indices(std::span<const std::uint32_t> indices);
    /// Replaces the vertices from `first` on; at most max_vertices.
    void update(std::span<const float> vertices, std::size_t first = 0);

    /// `count` indices from the `first` on.
    void draw_triangles(std::size_t first, std::size_t count) const;
    void draw_points(std::size_t count) const;
    void draw_strip(std::size_t count) const;

  private:
    unsigned array_ = 0;
    unsigned vertices_ = 0;
    unsigned indices_ = 0;
    std::size_t stride_bytes_ = 0;
    std::size_t capacity_bytes_ = 0;
    std::size_t index_capacity_bytes_ = 0;
};

}  // namespace skyig::render::gl
