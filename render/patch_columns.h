// Patches of fog round the eye for things among them: how much fog there is up to each place on the ground,
// by direction. The cloud map tells one distance for all that lies in a direction, which is too little where
// a thing stands between one patch and the next. Free of GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/cloud/cloud_maker.h"
#include "render/scene.h"
#include "render/shaders/shared.h"

namespace skyig::render {

/// Of the first layer of genus CloudGenus::kFogPatches; others are left to the cloud map.
class PatchColumns {
  public:
    /// Directions round the eye from south by west, the first of them again as the last.
    static constexpr int kAzimuths = 256;
    static constexpr int kColumns = kAzimuths + 1;
    /// Rings on the ground. \see patch_ring_m()
    static constexpr int kRings = 160;

    /// Follows the frame's layer, or stops without one. Allocates at the first layer.
    void update(cloud::CloudMaker& maker, const cloud::CloudMoment& moment);
    void stop() noexcept { shown_ = false; }

    [[nodiscard]] bool shown() const noexcept { return shown_; }
    /// Of each ring and direction: metres of full density on the ground from below the eye to there.
    [[nodiscard]] std::span<const float> texels() const noexcept { return texels_; }
    /// Rises when they are others.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
    /// Over the eye.
    [[nodiscard]] const shaders64::PatchHeights& heights_m() const noexcept { return heights_m_; }
    [[nodiscard]] double extinction_per_m() const noexcept { return extinction_per_m_; }
    [[nodiscard]] double eye_radius_m() const noexcept { return eye_radius_m_; }
    /// Of places on the ground beyond all rings, in the mean.
    [[nodiscard]] double mean() const noexcept { return mean_; }

    /// Of the patches up to there. \param direction_enu  unit vector
    [[nodiscard]] double optical_depth(const glm::dvec3& direction_enu, double distance_m) const noexcept;

  private:
    void lay(const cloud::CloudSource& source);
    [[nodiscard]] double sum_at(double azimuth_rad, double ground_m) const noexcept;

    Scene scene_;  // the layer alone
    CloudLayer layer_;
    Eye eye_;
    bool shown_ = false;
    std::vector<float> texels_;
    std::vector<glm::vec2> places_m_;
    std::vector<float> passed_;
    shaders64::PatchHeights heights_m_{};
    double extinction_per_m_ = 0.0;
    double eye_radius_m_ = 6371e3;
    double mean_ = 0.0;
    std::uint64_t revision_ = 0;
};

}  // namespace skyig::render
