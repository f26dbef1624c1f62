// The toned cloud map as textures, one for each screen, and the dome drawn with it where clouds stand.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/channel.h"
#include "render/cloud_frame.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace skyig::render {

/// Uniforms of shaders/cloud/fetch.glsl in one program.
class CloudFetch {
  public:
    explicit CloudFetch(const gl::Program& program) : place_(program.uniform("u_cloud_place")) {}
    void set(const gl::Program& program, int map_size) const;
    /// \param lower  whether the second component's shift is that of the lower square
    [[nodiscard]] static glm::vec4 place(int map_size, bool lower) noexcept;

  private:
    int place_;
};

/// One of the eight parts of all directions in each of which none of their components changes its sign.
struct Octant {
    glm::vec3 signs{1.0F};
    /// Half spaces of the dome's mesh that it consists of. \see DomePatches::visible()
    std::array<glm::dvec4, 3> sides{};
};
inline constexpr int kOctants = 8;
[[nodiscard]] Octant octant_of(int index, const glm::dmat4& enu_from_mesh) noexcept;

class CloudPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    CloudPass(std::size_t screens, gl::Placement placement);

    /// Takes over the tiles that have changed. Textures are made with the first clouds.
    void prepare(const CloudFrame& clouds, bool dither);
    /// Binds the screen's map for all programs that fetch it.
    void bind(std::size_t screen) const;
    /// Makes the dome's program current, for one octant after the other; it needs three clip distances.
    /// \param share  Dome::share()
    void use_dome(const Channel& channel, const glm::dmat4& clip_from_mesh, const glm::dmat4& enu_from_mesh,
                  double share) const;
    void take(const Octant& octant) const;
    /// The program for clouds over what is drawn already, to be blended with gl::Blend::kOver.
    void use_over(const glm::dmat4& clip_from_mesh, const glm::dmat4& enu_from_mesh) const;

    [[nodiscard]] int map_size() const noexcept { return size_; }

  private:
    gl::Program program_;
    int clip_, enu_, share_, half_size_, dither_, place_, octant_;
    gl::Program over_;
    CloudFetch over_fetch_;
    int over_clip_, over_enu_;
    std::vector<gl::Texture> maps_;
    std::size_t screens_;
    std::uint64_t size_revision_ = 0;
    int size_ = 0;
};

}  // namespace skyig::render
