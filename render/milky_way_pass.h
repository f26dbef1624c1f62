// Draws the Milky Way's belt into a channel, by adding.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/channel.h"
#include "render/cloud_pass.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/milky_way.h"

namespace skyig::render {

class MilkyWayPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit MilkyWayPass(std::size_t screens);

    /// Uploads what has changed. \param light  of the frame
    void prepare(const MilkyWay& milky_way, const SkyLight& light, bool dither);
    /// Draws nothing where the belt is out of view. \param clouds  the map that is bound; null: there are
    /// none
    void draw(MilkyWay& milky_way, const Channel& channel, std::size_t screen,
              const glm::dmat4& clip_from_enu, const CloudPass* clouds);

  private:
    struct Variant {
        explicit Variant(std::string_view fragment);
        gl::Program program;
        int clip, half_size, up, horizon_sine, dither;
    };
    struct Clouded : Variant {
        Clouded();
        CloudFetch fetch;
        int enu;
    };
    void draw_ranges(const Variant& variant, const Channel& channel, std::size_t screen,
                     const glm::dmat4& clip_from_galactic, std::span<const IndexRange> ranges) const;

    Variant plain_;
    std::optional<Clouded> clouded_;  // once it is needed
    std::vector<gl::Mesh> meshes_;    // one a screen
    std::optional<gl::Texture> map_;
    std::uint64_t map_revision_ = 0;
    glm::dmat3 enu_from_galactic_{1.0};
    glm::vec3 up_galactic_{0.0F};
    float horizon_sine_ = 0.0F;
    bool dither_ = false;
};

}  // namespace skyig::render
