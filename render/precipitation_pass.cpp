#include "render/precipitation_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/gl/texture.h"

namespace skyig::render {

namespace {

// Of one kind in one channel. What a field has more is left out: it is filled shell by shell from the
// nearest.
constexpr std::size_t kMost = 8192;
constexpr std::array<std::uint32_t, 6> kQuad{0, 1, 2, 2, 1, 3};

std::vector<std::uint32_t> quads() {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t quad = 0; quad < kMost; ++quad) {
        for (const std::uint32_t corner : kQuad)
            indices.push_back(4 * quad + corner);
    }
    return indices;
}

}  // namespace

PrecipitationPass::Shader::Shader(std::string_view fragment, gl::Placement placement)
    : program("precipitation/streak.vert", fragment, placement),
      tone(program, true),
      view(program.uniform("u_view_from_enu")),
      plane_origin(program.uniform("u_plane_origin")),
      plane_size(program.uniform("u_plane_size")),
      pixel(program.uniform("u_pixel_rad")),
      mean(program.uniform("u_mean_cd_m2")),
      gradient(program.uniform("u_gradient_cd_m2")) {}

PrecipitationPass::PrecipitationPass(gl::Placement placement)
    : sky_("precipitation/streak.frag", placement), vertices_(4 * kMost), mesh_({3, 3, 2}, 4 * kMost) {
    mesh_.set_indices(quads());
}

void PrecipitationPass::prepare(const Scene& scene, const SkyLight& light, double pixel_rad, double density) {
    pixel_rad_ = pixel_rad;
    field_.update(scene, density);
    const Surroundings around = surroundings(light);
    for (const auto& group : field_.groups())
        shown_[static_cast<std::size_t>(group.kind)] = shown_by(group.kind, around);
}

// Those that may reach into the frustum.
void PrecipitationPass::choose(std::span<const precipitation::Streak> streaks,
                               const ChannelView& view) noexcept {
    constexpr float kNear_m = 0.05F;
    const ImagePlane plane = image_plane(view.frustum);
    const glm::mat3 view_from_enu{view.view_from_enu};
    const auto left = static_cast<float>(plane.left);
    const auto right = static_cast<float>(plane.right);
    const auto bottom = static_cast<float>(plane.bottom);
    const auto top = static_cast<float>(plane.top);
    const auto pixel = static_cast<float>(pixel_rad_);
    chosen_ = 0;
    for (const precipitation::Streak& streak : streaks) {
        const glm::vec3 head = view_from_enu * streak.head_enu_m;
        const glm::vec3 tail = view_from_enu * streak.tail_enu_m;
        if (std::max(-head.z, -tail.z) < kNear_m) continue;
        // Its width, and half a pixel, seen aslant.
        const float spare = 4.0F * (streak.half_width_m + pixel * std::max(-head.z, -tail.z));
        const auto outside = [&](float head_m, float tail_m) { return std::max(head_m, tail_m) < -spare; };
        if (outside(head.x + left * head.z, tail.x + left * tail.z) ||
            outside(-head.x - right * head.z, -tail.x - right * tail.z) ||
            outside(head.y + bottom * head.z, tail.y + bottom * tail.z) ||
            outside(-head.y - top * head.z, -tail.y - top * tail.z))
            continue;
        const Vertex vertex{streak.head_enu_m, streak.tail_enu_m, {streak.half_width_m, streak.opacity}};
        std::fill_n(vertices_.begin() + static_cast<std::ptrdiff_t>(4 * chosen_), 4, vertex);
        if (++chosen_ == kMost) break;
    }
}

void PrecipitationPass::draw_with(const Shader& shader, const ChannelView& view,
                                  const shaders32::ToneParameters& tone) {
    const ImagePlane plane = image_plane(view.frustum);
    const gl::Program& program = shader.program;
    program.use();
    shader.tone.set(program, tone);
    program.set(shader.view, glm::mat3{view.view_from_enu});
    program.set(shader.plane_origin, glm::vec2{glm::dvec2{plane.left, plane.bottom}});
    program.set(shader.plane_size, glm::vec2{glm::dvec2{plane.right - plane.left, plane.top - plane.bottom}});
    program.set(shader.pixel, static_cast<float>(pixel_rad_));
    drawn_ = 0;
    for (const auto& group : field_.groups()) {
        choose(group.streaks, view);
        if (chosen_ == 0) continue;
        const Surroundings& shown = shown_[static_cast<std::size_t>(group.kind)];
        program.set(shader.mean, shown.mean_cd_m2);
        program.set(shader.gradient, shown.gradient_cd_m2);
        mesh_.update({&vertices_.front().head_enu_m.x, 4 * chosen_ * sizeof(Vertex) / sizeof(float)});
        mesh_.draw_triangles(0, kQuad.size() * chosen_);
        drawn_ += chosen_;
    }
}

void PrecipitationPass::draw(const ChannelView& view, const shaders32::ToneParameters& tone) {
    draw_with(sky_, view, tone);
}

void PrecipitationPass::draw_before(const ChannelView& view, const shaders32::ToneParameters& tone,
                                    const DeferredInput& input) {
    if (!things_) {
        things_.emplace("precipitation/streak_before.frag");
        far_ = things_->program.uniform("u_far_m");
    }
    things_->program.set(far_, static_cast<float>(input.far_m));
    gl::bind_texture(0, input.depth_texture);
    draw_with(*things_, view, tone);
}

}  // namespace skyig::render
