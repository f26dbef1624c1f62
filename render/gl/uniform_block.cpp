#include "render/gl/uniform_block.h"

#include <epoxy/gl.h>

#include <utility>

namespace skyig::render::gl {

UniformBlock::UniformBlock(std::span<const float> values) {
    glCreateBuffers(1, &name_);
    glNamedBufferStorage(name_, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), 0);
}

UniformBlock::~UniformBlock() {
    if (name_ != 0) glDeleteBuffers(1, &name_);
}

UniformBlock::UniformBlock(UniformBlock&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}

UniformBlock& UniformBlock::operator=(UniformBlock&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

void UniformBlock::bind(unsigned binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, name_);
}

}  // namespace skyig::render::gl
