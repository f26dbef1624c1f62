#include "clients/bench/sky_models.h"

#include <array>
#include <optional>

#include "render/sky/sky_view.h"

namespace skyig::clients::bench {

namespace {

namespace sky = render::sky;

class Multi final : public MeasuredSky {
  public:
    void enter(const sky::AirModel& air) override { tables_.emplace(air); }
    void place(double eye_height_m, double source_elevation_rad) override {
        view_.begin(*tables_, eye_height_m, source_elevation_rad);
        view_.build_all();
    }
    [[nodiscard]] glm::vec3 xyz(float elevation_rad, float relative_azimuth_rad) const override {
        return view_.xyz(elevation_rad, relative_azimuth_rad);
    }

  private:
    std::optional<sky::AirTables> tables_;
    sky::SkyView view_;
};

template <class Model>
std::unique_ptr<MeasuredSky> make() {
    return std::make_unique<Model>();
}

constexpr std::array<SkyContestant, 1> kContestants{{
    {"multi", "all orders by angular moments, sixteen wavelengths, a table of 60 x 33 directions",
     make<Multi>},
}};

}  // namespace

std::span<const SkyContestant> sky_contestants() noexcept {
    return kContestants;
}

}  // namespace skyig::clients::bench
