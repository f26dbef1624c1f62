// A homogeneous slab of cloud through the whole chain, from the map to the pixel, against truth: the light
// that the picture holds, cd/m2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "tests/render/light_fixture.h"

namespace skyig::render {
namespace {

using namespace tests;

constexpr float kSun_lx = 1e5F;

/// Light from where the scene's Moon is, which is switched off, on a dark sky and a dark ground: what the
/// scene's own air has is not asked.
void beam_light(const Scene& scene, const Plan& /*plan*/, const LightTables& /*tables*/,
                const SkyLight& /*sky*/, cloud::CloudLight& on_clouds) {
    on_clouds = {};
    on_clouds.beams[cloud::CloudLight::kSun] = {true, glm::vec3(scene.moon.direction_enu)};
    on_clouds.beam_lx[cloud::CloudLight::kSun].fill(glm::vec3(kSun_lx));
}

struct Row {
    double depth = 0.0, g = 0.0, albedo = 0.0, sun_zenith_deg = 0.0;
    char side = 0;
    double view_zenith_deg = 0.0, azimuth_deg = 0.0;
    double brf = 0.0;
};

std::vector<Row> truth() {
    std::ifstream file(SKYIG_TEST_DATA "/weather/cloud_slab_truth.csv");
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        Row row;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%c_brf,%lf,%lf,%lf", &row.depth, &row.g, &row.albedo,
                        &row.sun_zenith_deg, &row.side, &row.view_zenith_deg, &row.azimuth_deg,
                        &row.brf) == 8 &&
            row.albedo == 1.0 && row.brf >= 1e-4)
            rows.push_back(row);
    }
    return rows;
}

class SlabPicture : public GlTest {
  protected:
    static constexpr std::size_t kViews = 10;
    static constexpr int kSide = 16;

    SlabPicture() {
        Clouds clouds = scene_clouds();
        clouds.light = beam_light;
        renderer_.draw_clouds(std::move(clouds));
    }

    /// Each row's view as a channel of the rig, at most kViews of one Sun and side.
    /// \return pi L / (mu0 F0) in the middle of each
    std::vector<double> drawn(const std::vector<Row>& rows, double eye_from_slab_m) {
        constexpr double kBase_m = 3000.0, kThickness_m = 400.0;
        const bool above = rows.front().side == 'R';
        const double sun_zenith_deg = rows.front().sun_zenith_deg;
        Scene scene =
            make_scene(-60.0, 0.0, 90.0 - sun_zenith_deg, 180.0,
                       above ? kBase_m + kThickness_m + eye_from_slab_m : kBase_m - eye_from_slab_m);
        scene.moon.enabled = scene.stars.enabled = scene.air.model_enabled = false;
        // An eye that has leapt sees a map of its own.
        scene.eye.latitude_deg = 0.1 * ++cases_;
        CloudLayer& slab = scene.weather.clouds[scene.weather.cloud_count++];
        slab.genus = CloudGenus::kStratus;
        slab.model = CloudModel::kVolume;
        slab.base_m = kBase_m;
        slab.thickness_m = kThickness_m;
        slab.coverage = 1.0;
        slab.extinction_per_m = rows.front().depth / kThickness_m;
        for (std::size_t i = 0; i < kViews; ++i) {
            const Row& row = rows[std::min(i, rows.size() - 1)];
            const double up_deg = above ? row.view_zenith_deg - 90.0 : 90.0 - row.view_zenith_deg;
            // Light that travels on to the north is seen looking south, where the Sun is.
            add_view(scene, symmetric_frustum(0.5, kSide, kSide),
                     view_from_enu(180.0 - row.azimuth_deg, up_deg, 0.0));
        }
        std::vector<double> brf;
        const double mu0 = std::cos(sun_zenith_deg * kDegree);
        for (const LightPicture& picture : draw_light(renderer_, scene))
            brf.push_back(picture.at(kSide / 2, kSide / 2).y * std::numbers::pi /
                          (mu0 * static_cast<double>(kSun_lx)));
        return brf;
    }

    /// Of all rows of one depth, drawn over true, less 1.
    std::vector<double> errors_at(double depth, double eye_from_slab_m) {
        const std::vector<Row> all = truth();
        std::vector<double> errors;
        for (const double sun_zenith_deg : {0.0, 30.0, 60.0, 80.0}) {
            for (const char side : {'R', 'T'}) {
                std::vector<Row> rows;
                std::copy_if(all.begin(), all.end(), std::back_inserter(rows), [&](const Row& row) {
                    return row.depth == depth && row.sun_zenith_deg == sun_zenith_deg && row.side == side;
                });
                // Two methods tell some of the views.
                rows.resize(std::min(rows.size(), kViews));
                if (rows.empty()) continue;
                const std::vector<double> brf = drawn(rows, eye_from_slab_m);
                for (std::size_t i = 0; i < rows.size(); ++i)
                    errors.push_back(std::abs(brf[i] / rows[i].brf - 1.0));
            }
        }
        std::sort(errors.begin(), errors.end());
        return errors;
    }

  private:
    static std::vector<Channel> channels() {
        std::vector<Channel> made;
        for (std::size_t i = 0; i < kViews; ++i)
            made.push_back({"view" + std::to_string(i), kSide, kSide, {}});
        return made;
    }

    Renderer renderer_{channels(), without_glare(), {}, Target::kLuminance};
    int cases_ = 0;
};

TEST_F(SlabPicture, HoldsTheTrueLight) {
    struct Case {
        double depth, eye_from_slab_m;
    };
    // Through the far map, and once through the near one.
    for (const Case& c : {Case{1.0, 1500.0}, Case{4.0, 1500.0}, Case{16.0, 1500.0}, Case{4.0, 50.0}}) {
        const std::vector<double> errors = errors_at(c.depth, c.eye_from_slab_m);
        ASSERT_GE(errors.size(), 40U);
        const double median = errors[errors.size() / 2];
        std::printf("depth %2.0f from %4.0f m: %zu views, median %.1f %%, 90 of 100 %.1f %%, worst %.1f %%\n",
                    c.depth, c.eye_from_slab_m, errors.size(), 100.0 * median,
                    100.0 * errors[errors.size() * 9 / 10], 100.0 * errors.back());
        EXPECT_LT(median, 0.1);
        EXPECT_LT(errors.back(), 0.3);
    }
}

}  // namespace
}  // namespace skyig::render
