// A small block of uniforms that several programs share.
#pragma once

#include <span>

namespace skyig::render::gl {

class UniformBlock {
  public:
    /// \param values  as std140 lays them out
    explicit UniformBlock(std::span<const float> values);
    ~UniformBlock();
    UniformBlock(UniformBlock&& other) noexcept;
    UniformBlock& operator=(UniformBlock&& other) noexcept;
    UniformBlock(const UniformBlock&) = delete;
    UniformBlock& operator=(const UniformBlock&) = delete;

    /// For the draws that follow.
    void bind(unsigned binding) const;

  private:
    unsigned name_ = 0;
};

}  // namespace skyig::render::gl
