// A linked pair of a vertex and a fragment shader from render/shaders.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

namespace skyig::render::gl {

/// Whether vertex shaders take what they draw to where a warped channel shows it. \see common/place.glsl
enum class Placement { kFlat, kWarped };

class Program {
  public:
    /// \param vertex, fragment  names as in render/shaders, e.g. "sky/dome.vert"; `#include "x.glsl"` is
    /// resolved \throws std::runtime_error with the file and the driver's text
    Program(std::string_view vertex, std::string_view fragment, Placement placement = Placement::kFlat);
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const;

    /// Location of a uniform. \throws std::runtime_error if the program has no such active uniform.
    [[nodiscard]] int uniform(const char* name) const;

    void set(int location, float value) const;
    void set(int location, const glm::vec2& value) const;
    void set(int location, const glm::vec3& value) const;
    void set(int location, const glm::vec4& value) const;
    void set(int location, const glm::mat3& value) const;
    void set(int location, const glm::mat4& value) const;

  private:
    unsigned id_ = 0;
};

}  // namespace skyig::render::gl
