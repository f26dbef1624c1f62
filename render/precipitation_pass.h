// Draws what falls near the eye into a channel.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/channel.h"
#include "render/deferred.h"
#include "render/discs.h"
#include "render/gl/mesh.h"
#include "render/gl/program.h"
#include "render/precipitation/streak_field.h"
#include "render/rain_light.h"
#include "render/scene.h"
#include "render/shaders/shared.h"

namespace skyig::render {

class PrecipitationPass {
  public:
    /// \throws std::runtime_error when the program cannot be made
    explicit PrecipitationPass(gl::Placement placement);

    /// Once a frame whose plan needs it. \param pixel_rad  of the finest channel: edges are softened over it
    /// \param density  of the streaks \see precipitation::StreakField::update()
    void prepare(const Scene& scene, const SkyLight& light, double pixel_rad, double density = 1.0);

    /// Blends by coverage over whatever the channel holds, into the framebuffer that is bound.
    void draw(const ChannelView& view, const shaders32::ToneParameters& tone);
    /// The same; where `input` has something nearer, it hides what falls. The first call makes a program.
    void draw_before(const ChannelView& view, const shaders32::ToneParameters& tone,
                     const DeferredInput& input);

    /// In the last channel drawn.
    [[nodiscard]] std::size_t drawn() const noexcept { return drawn_; }

  private:
    /// As shaders/precipitation/streak.vert takes it, four times.
    struct Vertex {
        glm::vec3 head_enu_m;
        glm::vec3 tail_enu_m;
        glm::vec2 shape;
    };
    struct Shader {
        explicit Shader(std::string_view fragment, gl::Placement placement = gl::Placement::kFlat);
        gl::Program program;
        ToneUniforms tone;
        int view, plane_origin, plane_size, pixel, mean, gradient;
    };
    void draw_with(const Shader& shader, const ChannelView& view, const shaders32::ToneParameters& tone);
    void choose(std::span<const precipitation::Streak> streaks, const ChannelView& view) noexcept;

    precipitation::StreakField field_;
    Shader sky_;
    std::optional<Shader> things_;
    int far_ = -1;
    std::vector<Vertex> vertices_;
    gl::Mesh mesh_;
    std::array<Surroundings, precipitation::StreakField::kKinds> shown_{};
    double pixel_rad_ = 1e-3;
    std::size_t chosen_ = 0;
    std::size_t drawn_ = 0;
};

}  // namespace skyig::render
