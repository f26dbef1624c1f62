#include "render/cloud/impostor/impostor_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "render/cloud/impostor/particle_field.h"
#include "tests/render/cloud/impostor/moments.h"
#include "tests/support/allocation_count.h"

namespace skyig::render::cloud::impostor {
namespace {

class Sky {
  public:
    explicit Sky(const ImpostorSettings& settings = {}) : clouds(settings) {}

    void show(const Moment& moment) {
        clouds.update(moment);
        freeze(moment.eye);
    }
    void freeze(const Eye& eye) {
        const ImpostorClouds* layer = &clouds;
        field.freeze({&layer, 1}, light, eye);
    }
    [[nodiscard]] CloudSample at(const glm::vec3& way, const CloudRange& range = {},
                                 float ray_rad = 1e-3F) const {
        const CloudRay ray{way};
        CloudSample sample;
        field.march({&ray, 1}, range, ray_rad, {&sample, 1});
        return sample;
    }

    ImpostorClouds clouds;
    ImpostorField field;
    CloudLight light = day_light();
};

ImpostorSettings few_cells() {
    ImpostorSettings settings;
    settings.cells = 16;
    settings.atlas.size = {1024, 1024};
    settings.atlas.pictures = 512;
    return settings;
}

/// Root mean square of the difference in display codes, over rays that see cloud.
double rms_codes(const Sky& sky, const Eye& eye, std::size_t count) {
    const ParticleField truth(sky.clouds, sky.light, eye);
    double squares = 0.0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const CloudRay way = spread_ray(i, count, 0.03, 0.9);
        const glm::vec3 ray = way.direction_enu;
        if (!beside_sun(way)) continue;
        CloudSample direct;
        truth.march({&way, 1}, {}, 0.0F, {&direct, 1});
        const CloudSample drawn = sky.at(ray, {}, 1e-4F);
        if (direct.transmittance > 0.999F && drawn.transmittance > 0.999F) continue;
        const double difference = code(drawn) - code(direct);
        squares += difference * difference;
        ++seen;
    }
    EXPECT_GT(seen, count / 10);
    return std::sqrt(squares / static_cast<double>(seen));
}

TEST(ImpostorField, LooksLikeTheParticlesThatItStandsFor) {
    Sky sky(few_cells());
    Moment moment = fair_weather();
    sky.show(moment);
    const double fresh = rms_codes(sky, moment.eye, 4000);
    // Half a minute past the clouds at 100 m/s, at 30 Hz.
    double worst = 0.0;
    for (int frame = 1; frame <= 900; ++frame) {
        moment.time_s += 1.0 / 30.0;
        moment.eye = moved_north(moment.eye, 100.0 / 30.0);
        sky.clouds.update(moment);
        if (frame % 300 != 0) continue;
        sky.freeze(moment.eye);
        worst = std::max(worst, rms_codes(sky, moment.eye, 4000));
    }
    std::printf("impostors against particles: %.2f / 255 rms when drawn, %.2f in flight at 100 m/s\n", fresh,
                worst);
    RecordProperty("rms_codes_fresh", std::to_string(fresh));
    RecordProperty("rms_codes_in_flight", std::to_string(worst));
    EXPECT_LE(fresh, 3.0);
    EXPECT_LE(worst, 3.0);
}

TEST(ImpostorField, ShadesTheGroundAsItsParticlesDo) {
    Sky sky(few_cells());
    const Moment moment = fair_weather();
    sky.show(moment);
    const CloudBeam beam{kSunWay, 0.0F};
    // To the north of the eye; the truth looks up from each place.
    constexpr std::size_t kPlaces = 300;
    constexpr double kApart_m = 25.0;
    std::vector<glm::vec2> places;
    for (std::size_t i = 0; i < kPlaces; ++i)
        places.emplace_back(0.0F, static_cast<float>(kApart_m * static_cast<double>(i)));
    std::vector<float> passed(kPlaces);
    sky.field.shadow(beam, 0.0F, places, passed);
    double worst = 0.0, darkest = 1.0, brightest = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
        Eye eye = moved_north(moment.eye, kApart_m * static_cast<double>(i));
        eye.height_m = 0.0;
        const ParticleField truth(sky.clouds, sky.light, eye);
        const CloudRay up{kSunWay};
        CloudSample sample;
        truth.march({&up, 1}, {}, 0.0F, {&sample, 1});
        const auto found = static_cast<double>(passed[i]);
        worst = std::max(worst, std::abs(found - static_cast<double>(sample.transmittance)));
        darkest = std::min(darkest, found);
        brightest = std::max(brightest, found);
        sum += found;
    }
    std::printf("of the beam is left %.3f..%.3f, %.3f off the particles' at most\n", darkest, brightest,
                worst);
    EXPECT_LT(darkest, 0.2);
    EXPECT_GT(brightest, 0.98);
    EXPECT_LT(worst, 0.06);
    // A coarse grain keeps the mean depth, of which more light is left.
    std::vector<float> coarse(kPlaces);
    sky.field.shadow(beam, 300.0F, places, coarse);
    double coarse_sum = 0.0;
    for (const float part : coarse)
        coarse_sum += static_cast<double>(part);
    std::printf("in the mean %.3f, with a grain of 300 m %.3f\n", sum / kPlaces, coarse_sum / kPlaces);
    EXPECT_NEAR(coarse_sum / kPlaces, sum / kPlaces, 0.1);
}

TEST(ImpostorField, MeetsNothingWhereThereIsNothing) {
    Sky sky(few_cells());
    sky.show(fair_weather(0.0));
    EXPECT_EQ(sky.field.cloud_count(), 0U);
    for (std::size_t i = 0; i < 1000; ++i)
        EXPECT_EQ(sky.at(spread_ray(i, 1000, -1.0, 1.0).direction_enu), CloudSample{});
    // And below the horizon, where the ground ends rays before clouds on the far side.
    sky.show(fair_weather(0.9));
    for (std::size_t i = 0; i < 1000; ++i)
        EXPECT_EQ(sky.at(spread_ray(i, 1000, -1.0, -0.05).direction_enu), CloudSample{});
}

TEST(ImpostorField, KeepsToTheAreaOfItsLayer) {
    Sky sky(few_cells());
    Moment moment = fair_weather(0.9);
    WeatherArea area;
    area.centre_m = {0.0, 6000.0};
    area.corner_radius_m = 3000.0;
    moment.layer.area = area;
    sky.show(moment);
    double north = 1.0;
    for (std::size_t i = 0; i < 1000; ++i) {
        const glm::vec3 way = spread_ray(i, 1000, 0.05, 1.0).direction_enu;
        const CloudSample sample = sky.at(way);
        if (way.y < 0.0F) {
            EXPECT_EQ(sample, CloudSample{});
        }
        north = std::min(north, static_cast<double>(sample.transmittance));
    }
    EXPECT_LT(north, 0.05);
}

TEST(ImpostorField, AnswersFinitelyEverywhere) {
    Sky sky(few_cells());
    Moment moment = fair_weather(0.7);
    for (const double height_m : {-400.0, 1000.0, 1350.0, 1350.0001, 1700.0, 20000.0, 400000.0}) {
        moment.eye.height_m = height_m;
        moment.jumped = true;
        sky.show(moment);
        for (const glm::vec3 way : {glm::vec3{0.0F, 0.0F, 1.0F},
                                    {0.0F, 0.0F, -1.0F},
                                    {1.0F, 0.0F, 0.0F},
                                    {-1.0F, 1e-7F, 0.0F},
                                    {0.0F, -1.0F, 1e-7F},
                                    {1e-7F, 1e-7F, -1.0F},
                                    kSunWay}) {
            for (const float ray_rad : {0.0F, 1e-3F, 0.5F}) {
                const CloudSample sample = sky.at(way, {}, ray_rad);
                EXPECT_TRUE(std::isfinite(sample.light_cd_m2.x + sample.distance_m));
                EXPECT_GE(std::min({sample.light_cd_m2.x, sample.light_cd_m2.y, sample.light_cd_m2.z}), 0.0F);
                EXPECT_GE(sample.transmittance, 0.0F);
                EXPECT_LE(sample.transmittance, 1.0F);
                EXPECT_GE(sample.distance_m, 0.0F);
            }
        }
    }
}

TEST(ImpostorField, AnswersByTheRayAloneAndNearAndFarMakeTheWhole) {
    Sky sky(few_cells());
    sky.show(fair_weather(0.5));
    constexpr std::size_t kCount = 600;
    std::vector<CloudRay> rays;
    for (std::size_t i = 0; i < kCount; ++i)
        rays.push_back(spread_ray(i, kCount, 0.02, 1.0));
    std::vector<CloudSample> together(kCount);
    std::vector<CloudSample> near(kCount);
    std::vector<CloudSample> far(kCount);
    constexpr float kSplit_m = 2500.0F;
    sky.field.march(rays, {}, 1e-3F, together);
    sky.field.march(rays, {0.0F, kSplit_m}, 1e-3F, near);
    sky.field.march(rays, {kSplit_m, 1e7F}, 1e-3F, far);
    double worst = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
        EXPECT_EQ(sky.at(rays[i].direction_enu), together[i]);
        CloudSample joined = near[i];
        joined.light_cd_m2 += near[i].transmittance * far[i].light_cd_m2;
        joined.transmittance *= far[i].transmittance;
        worst = std::max(worst, std::abs(code(joined) - code(together[i])));
    }
    std::printf("near and far joined: within %.2f codes of the whole\n", worst);
    EXPECT_LT(worst, 1.0);
}

TEST(ImpostorField, IsTheSameForTwoWhoWereToldTheSame) {
    Sky one(few_cells());
    Sky other(few_cells());
    Moment moment = fair_weather();
    for (int frame = 0; frame < 60; ++frame) {
        moment.time_s = frame / 30.0;
        moment.eye = moved_north(moment.eye, 8.0);
        one.clouds.update(moment);
        other.clouds.update(moment);
    }
    one.freeze(moment.eye);
    other.freeze(moment.eye);
    for (std::size_t i = 0; i < 2000; ++i) {
        const glm::vec3 way = spread_ray(i, 2000, -0.1, 1.0).direction_enu;
        EXPECT_EQ(one.at(way), other.at(way));
    }
}

TEST(ImpostorField, DriftsWithTheWindForADayWithoutAJump) {
    // 20 m/s for 24 h: the same picture as an eye that was carried the other way.
    Sky sky(few_cells());
    Moment moment = fair_weather();
    moment.layer.drift_m = {0.0, 20.0 * 86400.0};
    sky.show(moment);
    const glm::vec3 there = glm::normalize(glm::vec3{0.2F, 0.5F, 0.4F});
    const CloudSample before = sky.at(there);
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 way = spread_ray(static_cast<std::size_t>(i), 40, 0.1, 1.0).direction_enu;
        const double still = code(sky.at(way));
        moment.layer.drift_m.y += 1e-3;
        sky.show(moment);
        worst = std::max(worst, std::abs(code(sky.at(way)) - still));
    }
    std::printf("a millimetre of drift after a day: %.4f codes\n", worst);
    EXPECT_LT(worst, 0.5);
    EXPECT_NEAR(code(sky.at(there)), code(before), 0.5);
}

TEST(ImpostorField, AllocatesNothingOnceItStands) {
    Sky sky(few_cells());
    Moment moment = fair_weather();
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int frame = 0; frame < 90; ++frame) {
        moment.time_s = frame / 30.0;
        moment.eye = moved_north(moment.eye, 30.0);
        moment.layer.coverage = 0.3 + 0.001 * frame;
        sky.show(moment);
        EXPECT_GE(sky.at({0.0F, 1.0F, 0.0F}).transmittance, 0.0F);
    }
    EXPECT_EQ(skyig::tests::allocation_count() - before, 0U);
}

TEST(ImpostorField, Costs) {
    Sky sky;
    Moment moment = fair_weather();
    const double begin_ms = cpu_ms();
    sky.clouds.update(moment);
    const double all_ms = cpu_ms() - begin_ms;
    const ImpostorClouds::Work work = sky.clouds.work();
    std::printf("whole sky at once: %d clouds made, lit and drawn in %.0f ms (%.2f ms each)\n", work.lit,
                all_ms, all_ms / work.lit);
    double freeze_ms = 1e9;
    for (int i = 0; i < 5; ++i) {
        const double start_ms = cpu_ms();
        sky.freeze(moment.eye);
        freeze_ms = std::min(freeze_ms, cpu_ms() - start_ms);
    }
    std::printf("freeze of %zu clouds: %.2f ms\n", sky.field.cloud_count(), freeze_ms);
    for (const auto& [name, low, high] :
         {std::tuple{"0..20 deg up", 0.0, 0.34}, {"20..90 deg up", 0.34, 1.0}}) {
        constexpr std::size_t kCount = 20000;
        std::vector<CloudRay> rays;
        std::vector<CloudSample> out(kCount);
        for (std::size_t i = 0; i < kCount; ++i)
            rays.push_back(spread_ray(i, kCount, low, high));
        double best_ms = 1e9;
        for (int i = 0; i < 5; ++i) {
            const double start_ms = cpu_ms();
            sky.field.march(rays, {}, 2e-3F, out);
            best_ms = std::min(best_ms, cpu_ms() - start_ms);
        }
        const double ns = best_ms * 1e6 / kCount;
        std::printf("a ray %s: %.0f ns\n", name, ns);
        EXPECT_GT(ns, 0.0);
    }
    // One cloud's picture at two sizes.
    const auto clouds = sky.clouds.clouds();
    const auto grown = std::max_element(clouds.begin(), clouds.end(), [](const Cloud& a, const Cloud& b) {
        return a.particles < b.particles;
    });
    const glm::vec3 middle{0.0F, 6000.0F, 500.0F};
    std::vector<Shaded> shaded(grown->particles);
    shade(sky.clouds.particles(*grown), sky.clouds.lit(*grown), sky.clouds.shading(), middle, shaded);
    for (const int side : {128, 256}) {
        const Capture capture = capture_of(shaded, middle, 1e-6F, side);
        std::vector<Texel> picture(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        double best_ms = 1e9;
        for (int i = 0; i < 5; ++i) {
            const double start_ms = cpu_ms();
            draw(shaded, capture, picture);
            best_ms = std::min(best_ms, cpu_ms() - start_ms);
        }
        std::printf("a picture of %zu particles, %d x %d: %.2f ms\n", shaded.size(), capture.size.x,
                    capture.size.y, best_ms);
        EXPECT_GT(best_ms, 0.0);
    }
}

}  // namespace
}  // namespace skyig::render::cloud::impostor
