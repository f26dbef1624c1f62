#include "render/gl/mesh.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace skyig::render::gl {

Mesh::Mesh(std::initializer_list<int> components, std::size_t max_vertices) {
    glCreateVertexArrays(1, &array_);
    glCreateBuffers(1, &vertices_);
    GLuint location = 0;
    GLuint offset = 0;
    for (const int count : components) {
        glEnableVertexArrayAttrib(array_, location);
        glVertexArrayAttribFormat(array_, location, count, GL_FLOAT, GL_FALSE, offset);
        glVertexArrayAttribBinding(array_, location, 0);
        offset += static_cast<GLuint>(static_cast<std::size_t>(count) * sizeof(float));
        ++location;
    }
    stride_bytes_ = offset;
    capacity_bytes_ = std::size_t{offset} * max_vertices;
    glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(std::max<std::size_t>(capacity_bytes_, 4)),
                         nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (offset > 0) glVertexArrayVertexBuffer(array_, 0, vertices_, 0, static_cast<GLsizei>(offset));
}

Mesh::~Mesh() {
    if (array_ == 0) return;
    glDeleteVertexArrays(1, &array_);
    glDeleteBuffers(1, &vertices_);
    if (indices_ != 0) glDeleteBuffers(1, &indices_);
}

Mesh::Mesh(Mesh&& other) noexcept
    : array_(std::exchange(other.array_, 0U)),
      vertices_(std::exchange(other.vertices_, 0U)),
      indices_(std::exchange(other.indices_, 0U)),
      stride_bytes_(other.stride_bytes_),
      capacity_bytes_(other.capacity_bytes_),
      index_capacity_bytes_(other.index_capacity_bytes_) {}

Mesh& Mesh::operator=(Mesh&& other) noexcept {
    std::swap(array_, other.array_);
    std::swap(vertices_, other.vertices_);
    std::swap(indices_, other.indices_);
    std::swap(stride_bytes_, other.stride_bytes_);
    std::swap(capacity_bytes_, other.capacity_bytes_);
    std::swap(index_capacity_bytes_, other.index_capacity_bytes_);
    return *this;
}

void Mesh::set_indices(std::span<const std::uint32_t> indices) {
    if (indices.size_bytes() > index_capacity_bytes_) {
        if (indices_ != 0) glDeleteBuffers(1, &indices_);
        index_capacity_bytes_ = indices.size_bytes();
        glCreateBuffers(1, &indices_);
        glNamedBufferStorage(indices_, static_cast<GLsizeiptr>(index_capacity_bytes_), nullptr,
                             GL_DYNAMIC_STORAGE_BIT);
        glVertexArrayElementBuffer(array_, indices_);
    }
    glNamedBufferSubData(indices_, 0, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data());
}

void Mesh::update(std::span<const float> vertices, std::size_t first) {
    const std::size_t offset = std::min(first * stride_bytes_, capacity_bytes_);
    const std::size_t bytes = std::min(vertices.size_bytes(), capacity_bytes_ - offset);
    if (bytes > 0)
        glNamedBufferSubData(vertices_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                             vertices.data());
}

void Mesh::draw_triangles(std::size_t first, std::size_t count) const {
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void Mesh::draw_points(std::size_t count) const {
    glBindVertexArray(array_);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
}

void Mesh::draw_strip(std::size_t count) const {
    glBindVertexArray(array_);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, static_cast<GLsizei>(count));
}

}  // namespace skyig::render::gl
