// The mesh that carries all smooth light: vertices are directions round the eye, colours are toned at the
// vertices, for all channels of a screen. Rows and columns stand where the toned light bends. What changes
// because a table was replaced fades in over some frames. Free of GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/dome_bend.h"
#include "render/dome_patches.h"
#include "render/shaders/shared.h"
#include "render/sky_light.h"

namespace skyig::render {

/// As the vertex shader sky/dome.vert takes it. Mesh frame: y towards the light source's azimuth, z up.
/// Colours are display codes 0..1 before dither: at the begin of a fade and at its end.
struct DomeVertex {
    glm::vec3 direction;
    glm::vec3 from;
    glm::vec3 to;
};

/// What decides where rows and columns lie.
struct DomeLayout {
    double horizon_elevation_rad = 0.0;
    /// Angle over which the horizon's edge is softened, radians.
    double edge_rad = 1e-3;
    /// Azimuth that the mesh is turned to: the Sun's if it lights the air, else the Moon's.
    double azimuth_rad = 0.0;
    double first_elevation_rad = 0.0;
    bool first_lights = false;
    /// A second source, its azimuth from the first.
    double second_elevation_rad = 0.0;
    double second_azimuth_rad = 0.0;
    bool second_lights = false;
    double adaptation_cd_m2 = 1.0;
    /// LightTables::air_in_use()
    std::uint64_t air = 0;
    /// The ground mirrors the sources.
    bool sea = false;
    /// SkyVeil::bends_revision()
    std::uint64_t veil = 0;
};

[[nodiscard]] DomeLayout dome_layout(const SkyLight& light, double edge_rad, double adaptation_cd_m2,
                                     std::uint64_t air) noexcept;

/// Whether a mesh laid out for `held` still serves `wanted`: no source off by 0.3 deg, the horizon by a tenth
/// of its dip.
[[nodiscard]] bool still_serves(const DomeLayout& held, const DomeLayout& wanted) noexcept;
/// Whether its nodes still stand where the light bends: the same air and ground, the adaptation within a
/// tenth.
[[nodiscard]] bool still_fits(const DomeLayout& held, const DomeLayout& wanted) noexcept;

class Dome {
  public:
    /// Colours of a replaced table fade in by at most this much a frame, unless that takes kLongestFade
    /// frames.
    static constexpr double kFadeStep_codes = 0.125;
    static constexpr int kLongestFade = 60;
    /// Where replacements keep following one another fast, a fade takes twice the frames between them (the
    /// longest of three times), but not less than this: what is shown keeps up with a day in a hurry.
    static constexpr int kHurriedFade = 12;
    static constexpr std::size_t kMaxVertices =
        static_cast<std::size_t>(DomeBend::kMost.sky_rows + DomeBend::kMost.ground_rows + 2) *
        static_cast<std::size_t>(DomeBend::kMost.columns + 1);

    /// Allocates for the largest size; nothing later does.
    /// \param screens  different ones that the light is toned for, >= 1
    explicit Dome(std::size_t screens = 1);

    /// Places the vertices; what they showed before is carried over to them.
    void lay_out(const DomeLayout& layout, const DomeBend& bend, const DomeSize& size);

    /// Why the light is asked anew.
    enum class Change {
        kAtOnce,    ///< another scene altogether
        kReplaced,  ///< a table was replaced or the mesh laid out anew: fades in
        kScaled     ///< the same tables by other factors: shows at once, a running fade goes on
    };
    /// Asks the light of every vertex, absolute. \param azimuth_rad  of the mesh in this frame
    void look_up(const SkyLight& light, double azimuth_rad, Change change);
    /// Colours the vertices. \param tones  one for each screen
    void encode(std::span<const shaders64::ToneParameters> tones);
    void encode(const shaders64::ToneParameters& tone) { encode(std::span{&tone, 1}); }
    /// Leaves out columns where a patch of the dome can do without, and cuts each quad along the diagonal
    /// that is closer to the light in its middle: on the first screen, whose tone is given, for the others
    /// show the same bends. Precondition: encode() with the same light. \param error_codes  largest error
    /// that the picture may have \return the largest error in the middle of a quad, display codes
    double triangulate(const SkyLight& light, double azimuth_rad, const shaders64::ToneParameters& tone,
                       double error_codes);
    /// One frame further in the fade. To be called once a frame.
    void step() noexcept;

    [[nodiscard]] std::span<const DomeVertex> vertices(std::size_t screen = 0) const noexcept {
        return vertices_[screen];
    }
    /// Of each vertex, linear Rec.709, cd/m2: what the fade leads to, and, while it lasts, what it began
    /// with.
    [[nodiscard]] std::span<const glm::vec3> light() const noexcept { return to_; }
    [[nodiscard]] std::span<const glm::vec3> light_before() const noexcept { return from_; }
    [[nodiscard]] std::span<const std::uint32_t> indices() const noexcept { return patches_.indices(); }
    /// How far the fade is, 0..1: 1 shows DomeVertex::to.
    [[nodiscard]] double share() const noexcept { return share_; }
    /// What of the indices a view needs; valid until the next call. \param clip_from_mesh  as the vertex
    /// shader has it \param rows  whole patches, from the nadir
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_mesh,
                                                      const QuadRows& rows = {},
                                                      Marked which = Marked::kAll) noexcept {
        return patches_.visible(clip_from_mesh, rows, which);
    }
    /// The same within more half spaces. \see DomePatches::visible()
    [[nodiscard]] std::span<const IndexRange> visible(const glm::dmat4& clip_from_mesh,
                                                      std::span<const glm::dvec4> inside,
                                                      const QuadRows& rows, Marked which) noexcept {
        return patches_.visible(clip_from_mesh, inside, rows, which);
    }
    /// Marks patches for visible(). \see DomePatches::mark()
    template <class Meets>
    void mark(Meets meets) noexcept {
        patches_.mark(meets);
    }
    [[nodiscard]] const DomeLayout& layout() const noexcept { return layout_; }
    [[nodiscard]] const DomeSize& size() const noexcept { return size_; }

    /// Turns mesh axes about the vertical so that y points to `azimuth_rad`, and shifts all vertices along it
    /// so that the horizon stands at `horizon_rad`: to be applied to (direction, 1).
    [[nodiscard]] glm::dmat4 enu_from_mesh(double azimuth_rad, double horizon_rad) const noexcept;

  private:
    struct Row {
        double above_horizon_rad;
        Side side;
    };
    [[nodiscard]] std::size_t stride() const noexcept { return azimuths_rad_.size(); }
    void place_rows(const DomeBend& bend);
    void settle_mix() noexcept;
    template <class Keep>
    void carry_over(std::span<const glm::vec3> values, double turn_rad, const Keep& keep) const;
    void carry_codes(std::vector<DomeVertex>& vertices, std::size_t count, double turn_rad);
    template <class Keep>
    void encode_one(const std::vector<glm::vec3>& light, const shaders32::ToneParameters& tone,
                    const Keep& keep);
    void encode_before(const shaders32::ToneParameters& tone, std::size_t screen);
    [[nodiscard]] glm::vec3 bend_at(std::size_t row, std::size_t column) const noexcept;
    [[nodiscard]] float thinning_error(std::size_t row, std::size_t column, std::size_t columns,
                                       std::size_t step) const noexcept;
    [[nodiscard]] float thinning_error(const DomePatches::Quad& corner, std::uint32_t rows,
                                       std::uint32_t columns) const noexcept;
    /// What is missed in the middle of a quad by cutting it along each diagonal, of 1.
    struct DiagonalErrors {
        float rising = 0.0F;
        float falling = 0.0F;
    };
    [[nodiscard]] DiagonalErrors diagonal_errors(const DomePatches::Quad& quad,
                                                 const glm::vec3& middle) const noexcept;
    void begin_fade() noexcept;

    DomeLayout layout_;
    DomeSize size_;
    std::vector<Row> rows_;
    std::vector<Row> old_rows_;
    std::vector<double> azimuths_rad_;
    std::vector<double> old_azimuths_rad_;
    std::vector<std::vector<DomeVertex>> vertices_;  // of each screen
    /// What `from_` shows, of each screen, while a fade lasts.
    std::vector<std::vector<glm::vec3>> from_codes_;
    std::vector<glm::vec3> directions_;
    std::vector<glm::vec3> from_;  // linear Rec.709, cd/m2
    std::vector<glm::vec3> to_;
    /// Of `to_` on the first screen, before they are moved to balance the error.
    std::vector<glm::vec3> codes_;
    DomePatches patches_;
    double share_ = 1.0;
    double fade_step_ = 1.0;
    int frames_since_replaced_ = kLongestFade;
    std::array<int, 2> earlier_gaps_{kLongestFade, kLongestFade};  // between replacements, frames
    bool replaced_ = false;                                        // by the last look_up()
    bool laid_ = false;                                            // anew, and not encoded since
};

}  // namespace skyig::render
