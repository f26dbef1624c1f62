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
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/milky_way.h"
#include "render/refined_mesh.h"

namespace skyig::render {

class MilkyWayPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    MilkyWayPass(std::size_t screens, gl::Placement placement);

    /// Uploads what has changed. \param light  of the frame \param longest_edge_rad  of a triangle
    void prepare(const MilkyWay& milky_way, const SkyLight& light, bool dither, double longest_edge_rad);
    /// Draws nothing where the belt is out of view. \param shown_from_clip  what of the picture shows
    /// \param clouds  the map that is bound; null: there are none
    void draw(MilkyWay& milky_way, const Channel& channel, std::size_t screen,
              const glm::dmat4& clip_from_enu, const glm::dmat4& shown_from_clip, const CloudPass* clouds);

  private:
    struct Variant {
        Variant(std::string_view fragment, gl::Placement placement);
        gl::Program program;
        int clip, half_size, up, horizon_sine, dither;
    };
    struct Clouded : Variant {
        explicit Clouded(gl::Placement placement);
        CloudFetch fetch;
        int enu;
    };
    void draw_ranges(const Variant& variant, const Channel& channel, std::size_t screen,
                     const glm::dmat4& clip_from_galactic, std::span<const IndexRange> ranges) const;

    gl::Placement placement_;
    Variant plain_;
    std::optional<Clouded> clouded_;   // once it is needed
    std::vector<RefinedMesh> meshes_;  // one a screen
    std::optional<gl::Texture> map_;
    std::uint64_t map_revision_ = 0;
    double longest_edge_rad_ = 0.0;
    glm::dmat3 enu_from_galactic_{1.0};
    glm::vec3 up_galactic_{0.0F};
    float horizon_sine_ = 0.0F;
    bool dither_ = false;
};

}  // namespace skyig::render
