// What clouds leave of the Sun's or the Moon's beam on the ground round the eye, single clouds told apart:
// three squares of cells, one round the other, on a lattice that drifts with the clouds. Made row by row over
// frames from frozen moments; a finished one takes the place of the one before it while the next is made.
// What a frame sees depends on the frames before it alone. Free of GL and of light.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/cloud/cloud_maker.h"
#include "render/cloud/shadow_cells.h"

namespace skyig::render::cloud {

/// What the map asks of a frame.
struct ShadowFrame {
    CloudMoment moment;
    /// Towards the source, unit vector, above the horizon; the angle of its disc.
    glm::dvec3 source_enu{0.0, 0.0, 1.0};
    double source_diameter_rad = 0.0093;
    /// What clouds leave of the beam as a mean over the area (CloudShade): shadows and gaps make it up.
    double mean = 1.0;
    /// Another scene altogether: everything is made at once, as it is for an eye that has_leapt().
    bool jumped = false;
};

class ShadowMap {
  public:
    /// On the side of each square.
    static constexpr int kCells = kShadowSide;
    static constexpr int kLevels = kShadowLevels;
    static constexpr std::array<float, kLevels> kCell_m{64.0F, 192.0F, 576.0F};
    /// Beyond it there is the mean alone.
    static constexpr float kReach_m = 0.5F * kCells * kCell_m[kLevels - 1];
    static constexpr int kRowsAFrame = 6;
    static constexpr int kFrames = kLevels * kCells / kRowsAFrame;

    /// Takes all the memory that it ever needs.
    void reserve();
    /// Allocates at the first call, unless reserve() was called.
    void update(CloudMaker& maker, const ShadowFrame& frame);
    /// Forgets all; the next update() begins at once.
    /// Clouds or light that come later come in from the mean, over as many frames as a map takes.
    void stop() noexcept;

    [[nodiscard]] bool shown() const noexcept { return shown_; }
    [[nodiscard]] float mean() const noexcept { return mean_; }
    /// How far shadows and gaps are off the mean, root mean square.
    [[nodiscard]] float contrast() const noexcept { return contrast_; }

    /// Part of the beam, 0..1. \param ground_m  east and north of below the eye
    [[nodiscard]] float at(const glm::vec2& ground_m) const noexcept;
    /// Its mean along a stretch of the ground whose middle and half are given.
    [[nodiscard]] float along(const glm::vec2& middle_m, const glm::vec2& half_m) const noexcept;

    /// What at() and along() look into, until the next update(); of the ground it knows nothing.
    [[nodiscard]] ShadowCells as_cells() const noexcept;

    /// Rises whenever cells have changed.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
    /// That with which everything was made at once the last time: nothing from before it is of use.
    [[nodiscard]] std::uint64_t begun() const noexcept { return begun_; }
    /// Of the lattice from below the eye: what the shown cells have moved by, metres.
    [[nodiscard]] const glm::dvec2& origin_m() const noexcept { return origin_m_; }
    /// The shown cells, a square after the other, the southernmost row first, and where a square begins.
    [[nodiscard]] std::span<const float> cells() const noexcept { return cells_; }
    [[nodiscard]] const glm::vec2& corner_m(int level) const noexcept {
        return corners_m_[static_cast<std::size_t>(level)];
    }

  private:
    struct Grid {
        std::vector<float> passed;
        std::array<glm::ivec2, kLevels> low{};  // the first cell
    };
    [[nodiscard]] bool stands_still(const ShadowFrame& frame) const noexcept;
    void follow(const ShadowFrame& frame) noexcept;
    void begin(CloudMaker& maker, const ShadowFrame& frame);
    void lay(Grid& grid) const noexcept;
    void begin_plain() noexcept;
    void make_rows(int count) noexcept;
    void blur(Grid& grid) const noexcept;
    void show(double share) noexcept;
    void level() noexcept;
    bool lead_level(const Weather& weather, bool at_once) noexcept;

    std::array<Grid, 3> grids_;
    std::size_t old_ = 0;
    std::size_t new_ = 1;
    std::size_t next_ = 2;
    std::vector<float> cells_;
    std::array<glm::ivec2, kLevels> low_{};
    glm::dvec2 origin_m_{0.0};
    std::array<glm::vec2, kLevels> corners_m_{};
    bool shown_ = false;
    bool making_ = false;
    int rows_ = 0;   // made of the next one
    int blend_ = 0;  // rows' worth of frames since the last took over; kLevels * kCells: it has
    float mean_ = 1.0F;
    float levelled_ = 1.0F;  // how far brought to the mean
    float contrast_ = 0.0F;
    std::uint64_t revision_ = 0;
    std::uint64_t begun_ = 0;

    // Of the moment in the making.
    const CloudSource* source_ = nullptr;
    CloudBeam beam_;
    glm::dvec2 made_origin_m_{0.0};
    double penumbra_m_ = 0.0;
    // What it was made for, and of the frame before.
    Weather made_weather_;
    glm::dvec3 made_source_enu_{0.0};
    Eye made_eye_;
    std::optional<Eye> last_eye_;
    glm::dvec2 last_drift_m_{0.0};
    std::uint32_t seed_ = 0;
};

}  // namespace skyig::render::cloud
