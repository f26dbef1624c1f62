#include "render/scene_cloud_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "render/plan.h"
#include "tests/support/allocation_count.h"

namespace skyig::render {
namespace {

using cloud::CloudRange;
using cloud::CloudRay;
using cloud::CloudSample;
using cloud::CloudSource;

/// One and the same cloud everywhere.
class Even final : public CloudSource {
  public:
    explicit Even(const CloudSample& sample) : sample_(sample) {}
    void march(std::span<const CloudRay> /*rays*/, const CloudRange& /*range*/, float /*ray_rad*/,
               std::span<CloudSample> out) const noexcept override {
        for (CloudSample& each : out)
            each = sample_;
    }

  private:
    CloudSample sample_;
};

CloudSample joined(const CloudSample& one, const CloudSample& other) {
    const Even first(one);
    const Even second(other);
    JoinedClouds both;
    both.join(first, second);
    const std::vector<CloudRay> rays(150);
    std::vector<CloudSample> out(rays.size());
    both.march(rays, {}, 1e-3F, out);
    for (const CloudSample& each : out)
        EXPECT_EQ(each, out.front());
    return out.front();
}

TEST(JoinedClouds, StandBeforeEachOtherByTheirDistance) {
    const CloudSample near{glm::vec3{100.0F}, 0.25F, 1000.0F};
    const CloudSample far{glm::vec3{800.0F}, 0.5F, 5000.0F};
    for (const CloudSample& both : {joined(near, far), joined(far, near)}) {
        EXPECT_FLOAT_EQ(both.light_cd_m2.x, 100.0F + 0.25F * 800.0F);
        EXPECT_FLOAT_EQ(both.transmittance, 0.125F);
        // The near one has 0.75 of 0.875, the far one what shines through it.
        EXPECT_FLOAT_EQ(both.distance_m, (0.75F * 1000.0F + 0.125F * 5000.0F) / 0.875F);
    }
    EXPECT_EQ(joined(near, {}), near);
    EXPECT_EQ(joined({}, near), near);
    EXPECT_EQ(joined({}, {}), CloudSample{});
}

CloudLayer layer_of(CloudModel model, std::uint32_t seed) {
    CloudLayer layer;
    layer.model = model;
    layer.coverage = 0.15;
    layer.seed = seed;
    return layer;
}

Scene scene_with(std::initializer_list<CloudModel> models) {
    Scene scene;
    scene.eye = {47.3, 8.1, 400.0};
    for (const CloudModel model : models) {
        Weather& weather = scene.weather;
        weather.clouds[weather.cloud_count] =
            layer_of(model, static_cast<std::uint32_t>(weather.cloud_count));
        ++weather.cloud_count;
    }
    return scene;
}

TEST(CloudModels, AreToldByThePlan) {
    const auto reason = [](const Scene& scene) {
        Plan plan;
        plan_clouds(plan, scene, 1024, 64, false);
        return std::string(plan[Pass::kClouds].reason);
    };
    EXPECT_EQ(reason(scene_with({})), "no layer has any");
    EXPECT_NE(reason(scene_with({CloudModel::kAuto})).find("volumes"), std::string::npos);
    Scene ice = scene_with({CloudModel::kAuto});
    ice.weather.clouds[0].genus = CloudGenus::kCirrus;
    EXPECT_NE(reason(ice).find("sheets"), std::string::npos);
    EXPECT_EQ(reason(ice).find("volumes"), std::string::npos);
    const std::string both = reason(scene_with({CloudModel::kImpostor, CloudModel::kVolume}));
    EXPECT_NE(both.find("impostors"), std::string::npos);
    EXPECT_NE(both.find("volumes"), std::string::npos);
    EXPECT_EQ(both.find("sheets"), std::string::npos);
}

TEST(CloudModels, BeyondTheCapImpostorsAreVolumes) {
    const Scene scene = scene_with({CloudModel::kImpostor, CloudModel::kLayer, CloudModel::kImpostor,
                                    CloudModel::kImpostor, CloudModel::kAuto});
    EXPECT_EQ(drawn_as(scene.weather, 0), CloudModel::kImpostor);
    EXPECT_EQ(drawn_as(scene.weather, 1), CloudModel::kLayer);
    EXPECT_EQ(drawn_as(scene.weather, 2), CloudModel::kImpostor);
    EXPECT_EQ(drawn_as(scene.weather, 3), CloudModel::kVolume);
    EXPECT_EQ(drawn_as(scene.weather, 4), CloudModel::kVolume);
    EXPECT_NE(drawn_models(scene.weather).find("further ones as volumes"), std::string_view::npos);
}

cloud::CloudLight day() {
    cloud::CloudLight light;
    light.beams[0] = {true, glm::normalize(glm::vec3{0.6F, 0.35F, 0.8F})};
    light.beam_lx[0].fill(glm::vec3{1e5F});
    light.above_cd_m2.fill({3000.0F, 4500.0F, 7500.0F});
    light.below_cd_m2.fill(glm::vec3{2500.0F});
    return light;
}

std::vector<CloudSample> seen(const CloudSource& source) {
    std::vector<CloudRay> rays;
    for (int i = 0; i < 1500; ++i) {
        const float z = 0.02F + 0.6F * static_cast<float>(i) / 1500.0F;
        const float across = std::sqrt(1.0F - z * z);
        const float turn = 2.39996F * static_cast<float>(i);
        rays.push_back({{across * std::cos(turn), across * std::sin(turn), z}});
    }
    std::vector<CloudSample> out(rays.size());
    source.march(rays, {}, 2e-3F, out);
    return out;
}

std::size_t clouded(const std::vector<CloudSample>& samples) {
    std::size_t count = 0;
    for (const CloudSample& sample : samples)
        count += sample.transmittance < 0.5F ? 1U : 0U;
    return count;
}

TEST(SceneCloudMaker, DrawsEachLayerByItsModelAndKeepsWhatWasFrozen) {
    SceneCloudMaker maker;
    SceneCloudMaker other;
    const cloud::CloudLight light = day();
    Scene scene = scene_with({CloudModel::kImpostor});
    const auto follow = [&](bool jumped) {
        for (SceneCloudMaker* each : {&maker, &other})
            each->follow({scene, scene.eye, light}, 2e-3F, jumped);
    };
    follow(true);
    const CloudSource& first = maker.freeze(0, {scene, scene.eye, light});
    const std::vector<CloudSample> as_frozen = seen(first);
    EXPECT_GT(clouded(as_frozen), 50U);

    // Flown on past many pictures: the first moment is still there to be marched, no memory is asked for, and
    // another one who was told the same sees the same.
    (void)maker.freeze(1, {scene, scene.eye, light});
    (void)maker.freeze(3, {scene, scene.eye, light});
    const std::uint64_t before = skyig::tests::allocation_count();
    for (int frame = 1; frame <= 90; ++frame) {
        scene.time_s = frame / 15.0;
        scene.eye.latitude_deg += 20.0 / 111195.0;
        follow(false);
        (void)maker.freeze(3, {scene, scene.eye, light});
        if (frame % 30 == 0) (void)maker.freeze(1, {scene, scene.eye, light});
    }
    EXPECT_EQ(skyig::tests::allocation_count() - before, 0U);
    EXPECT_EQ(seen(first), as_frozen);
    const std::vector<CloudSample> now = seen(maker.freeze(2, {scene, scene.eye, light}));
    EXPECT_NE(now, as_frozen);
    EXPECT_EQ(now, seen(other.freeze(2, {scene, scene.eye, light})));

    // With volumes over them there is more cloud, and without the impostors the field's alone.
    scene.weather.clouds[1] = layer_of(CloudModel::kVolume, 9);
    scene.weather.clouds[1].base_m = 3000.0;
    scene.weather.cloud_count = 2;
    follow(false);
    const std::vector<CloudSample> both = seen(maker.freeze(2, {scene, scene.eye, light}));
    EXPECT_GT(clouded(both), clouded(now));
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_LE(both[i].transmittance, now[i].transmittance + 1e-6F);
    scene.weather.clouds[0] = scene.weather.clouds[1];
    scene.weather.cloud_count = 1;
    follow(false);
    cloud::field::FieldMaker field;
    EXPECT_EQ(seen(maker.freeze(2, {scene, scene.eye, light})),
              seen(field.freeze(2, {scene, scene.eye, light})));
}

}  // namespace
}  // namespace skyig::render
