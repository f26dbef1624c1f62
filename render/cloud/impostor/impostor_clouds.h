// The clouds of one layer round the eye, kept from frame to frame: which cells have one, their particles,
// light and pictures, each renewed when it is no longer true enough, a fixed number of them at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "render/channel.h"
#include "render/cloud/impostor/atlas.h"
#include "render/cloud/impostor/light.h"
#include "render/cloud/impostor/particles.h"
#include "render/cloud/impostor/picture.h"
#include "render/scene.h"

namespace skyig::render::cloud::impostor {

struct ImpostorSettings {
    LightMethod light = LightMethod::kDepths;
    AtlasSettings atlas;
    /// Cells along a side of the square round the eye that has clouds; a power of two.
    int cells = 32;
    /// A frame, at most: clouds made or lit anew, pictures drawn anew.
    int lights_per_update = 4;
    int pictures_per_update = 6;
    /// Of scene time, from one picture of a cloud to the next; and from none to its first.
    double fade_s = 2.2;
    double first_fade_s = 3.0;
    /// How far what stands before or behind a picture's plane may be displaced, texels. Rays see some of it
    /// in relief: what is left over is less.
    float most_shift = 1.0F;
};

/// What the layer's clouds are to be true to.
struct Moment {
    Eye eye;
    CloudLayer layer;
    std::array<Beam, CloudLight::kSources> beams{};
    /// Angle that a texel may take: that of the map's rays.
    float texel_rad = 2e-3F;
    double time_s = 0.0;
    /// Nothing seen before is of use: everything is made at once, without fading; no slot is held any more.
    bool jumped = false;
};

/// One picture of a cloud. id kNone: none.
struct Picture {
    Atlas::Id id = Atlas::kNone;
    Capture capture;
    /// Of the cloud that it shows.
    float bound_m = 0.0F;
    /// That it was wanted with; the atlas may have had less room.
    float wanted_texel_m = 0.0F;
};

struct Cloud {
    std::int64_t east = 0;  ///< of its cell
    std::int64_t north = 0;
    std::uint32_t key = 0;
    bool alive = false;
    bool made = false;
    /// That it was made with.
    CloudShape shape;
    float grown = 0.0F;
    double age_s = 0.0;
    /// From the middle to where its farthest particle ends.
    float bound_m = 0.0F;
    std::size_t particles = 0;
    std::array<glm::vec3, CloudLight::kSources> lit_from{};
    std::array<bool, CloudLight::kSources> lit_by{};
    bool stale = true;  ///< lit since its last picture
    /// The newest, and the one that it takes over from.
    std::array<Picture, 2> pictures{};
    double fade_from_s = 0.0;
    double fade_s = 2.2;
    /// No picture is tried before: the atlas had no room.
    double wait_s = -1e300;
};

/// From `kDirect` bounds on a cloud is shown by pictures alone, below `kPictures` by its particles alone, and
/// by both in between.
inline constexpr float kDirect = 2.6F;
inline constexpr float kPictures = 2.0F;

/// Of a cloud, 0..1: they fade over the last part of their layer's range. \param range_m  range_m()
[[nodiscard]] float shown_part(float distance_m, float range_m) noexcept;

/// Allocates at construction alone. A CloudSource that was frozen from it reads the atlas in place:
/// update() only when no march is under way, and hold() for what is to be marched after another update().
class ImpostorClouds {
  public:
    explicit ImpostorClouds(const ImpostorSettings& settings);

    /// Sources frozen at different times that may be marched still.
    static constexpr std::size_t kSlots = 8;

    void update(const Moment& moment) noexcept;
    /// Keeps the present pictures for who has frozen them, until the slot is held anew or let go; what it
    /// held before may go. May be called while other slots are marched. \param slot  < kSlots
    void hold(std::size_t slot) noexcept;
    void let_go(std::size_t slot) noexcept;

    /// From the eye, along its east, north and up, over a spherical Earth.
    [[nodiscard]] glm::dvec3 middle_m(const Cloud& cloud, const Eye& eye) const noexcept;
    /// Part of the newest picture in what is shown; the other one has the rest.
    [[nodiscard]] float newest_part(const Cloud& cloud) const noexcept;
    /// Beyond this there are no clouds of this layer; they fade over the last part of it.
    [[nodiscard]] double range_m() const noexcept;

    [[nodiscard]] std::span<const Cloud> clouds() const noexcept { return clouds_; }
    [[nodiscard]] std::span<const Particle> particles(const Cloud& cloud) const noexcept;
    [[nodiscard]] std::span<const Lit> lit(const Cloud& cloud) const noexcept;
    [[nodiscard]] const Atlas& atlas() const noexcept { return *atlas_; }
    [[nodiscard]] const Shading& shading() const noexcept { return shading_; }
    [[nodiscard]] const Moment& moment() const noexcept { return moment_; }

    struct Work {
        int lit = 0;
        int drawn = 0;
        bool packed = false;
    };
    /// Of the last update().
    [[nodiscard]] const Work& work() const noexcept { return work_; }

  private:
    struct Need {
        float urgency;  ///< >= 1: past its limit
        std::uint32_t cloud;
    };
    void find_cells() noexcept;
    void find_velocity(double step_s) noexcept;
    void clear(Cloud& cloud) noexcept;
    /// Of a picture that is not shown from now on.
    void retire(Atlas::Id id) noexcept;
    void release_retired() noexcept;
    void end_fade(Cloud& cloud) noexcept;
    void renew_light() noexcept;
    void renew_pictures() noexcept;
    [[nodiscard]] float light_urgency(const Cloud& cloud) const noexcept;
    [[nodiscard]] float picture_urgency(const Cloud& cloud) const noexcept;
    void make(Cloud& cloud) noexcept;
    void light(Cloud& cloud) noexcept;
    void take_picture(Cloud& cloud) noexcept;
    /// The most urgent first, ties in the order of cells. \return how many are due
    template <class Urgency>
    std::span<const Need> most_urgent(int most, const Urgency& urgency) noexcept;
    [[nodiscard]] std::size_t index(const Cloud& cloud) const noexcept {
        return static_cast<std::size_t>(&cloud - clouds_.data());
    }
    [[nodiscard]] float growth_now(const Cloud& cloud) const noexcept;

    ImpostorSettings settings_;
    std::unique_ptr<Atlas> atlas_;
    LightBuffer buffer_;
    Shading shading_;
    Moment moment_;
    CloudShape shape_;
    bool begun_ = false;
    /// Of the eye through the layer's air, east, north, up, and where it was.
    glm::dvec3 velocity_m_s_{0.0};
    glm::dvec3 place_m_{0.0};
    std::vector<Cloud> clouds_;
    std::vector<Particle> particles_;
    std::vector<Lit> lit_;
    std::vector<Need> needs_;
    /// By Atlas::Id, a bit for each slot that holds it.
    std::vector<std::uint8_t> holders_;
    std::vector<Atlas::Id> retired_;  // while somebody holds them
    std::vector<Texel> canvas_;
    std::vector<Shaded> shaded_;
    Work work_;
};

}  // namespace skyig::render::cloud::impostor
