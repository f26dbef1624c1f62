// Owns the direction tables of sunlit and moonlit air and keeps them fresh without ever holding a frame up: a
// new table is built in slices, a fixed number of rows a frame, beside the one in use; new air is computed on
// a thread of its own and taken over a fixed number of frames later. What a frame sees depends on frame
// numbers alone, never on measured time.
#pragma once

#include <cstdint>
#include <future>
#include <optional>

#include "render/plan.h"
#include "render/scene.h"
#include "render/sky/air_tables.h"
#include "render/sky/sky_view.h"
#include "render/sky_light.h"

namespace skyig::render {

class LightTables {
  public:
    /// Frames from the first sight of new air to its use, and over which one direction table is built.
    static constexpr std::uint64_t kAirLatencyFrames = 20;
    static constexpr int kRowsAFrame = 10;

    LightTables();
    ~LightTables();
    LightTables(const LightTables&) = delete;
    LightTables& operator=(const LightTables&) = delete;

    [[nodiscard]] Held held() const noexcept;

    /// Follows the plan. The first call, and one that finds the source or the eye somewhere else altogether,
    /// builds whole tables at once.
    void update(const Scene& scene, const Plan& plan);

    /// The frame's light, from the tables in use.
    [[nodiscard]] SkyLight light(const Scene& scene, const Plan& plan) const noexcept;

    /// Rises by one whenever a table in use is replaced.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

    /// Precondition: update() was called.
    [[nodiscard]] const sky::AirTables& air() const noexcept { return *air_; }

  private:
    struct View {
        sky::SkyView front;
        sky::SkyView back;
        std::uint64_t front_air = 0;  // revision of the air it was made of, 0: none
        std::uint64_t back_air = 0;
        bool building = false;
    };
    void update_air(const Scene& scene, const Plan& plan);
    void update_view(View& view, bool needed, double elevation_rad, double height_m);

    std::optional<sky::AirTables> air_;
    Air air_state_;
    std::uint64_t air_revision_ = 0;
    std::future<sky::AirTables> next_air_;
    Air next_air_state_;
    std::uint64_t next_air_age_ = 0;

    View sun_;
    View moon_;
    std::uint64_t revision_ = 0;
};

}  // namespace skyig::render
