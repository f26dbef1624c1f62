#include "clients/bench/cloud_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>

#include "render/cloud/impostor/impostor_field.h"
#include "render/cloud/impostor/particle_field.h"
#include "render/scene_cloud_maker.h"

namespace skyig::clients::bench {

namespace {

namespace cloud = render::cloud;
using cloud::CloudRay;
using cloud::CloudSample;
using render::CloudModel;

constexpr float kRay_rad = 2e-3F;
constexpr std::size_t kRays = 4096;
constexpr std::array<CloudModel, 3> kModels{CloudModel::kLayer, CloudModel::kVolume, CloudModel::kImpostor};
constexpr std::array<std::string_view, 3> kNames{"drawn: layer", "drawn: volume", "drawn: impostor"};
constexpr std::array<std::string_view, 3> kWhat{
    "seed 001: one look where a ray crosses the layer", "marched through, lit step by step; the default",
    "seed 003: pictures of particles, met on their planes; the error is that against the particles"};

constexpr double kSun_lx = 1e5;
const glm::vec3 kSunWay = glm::normalize(glm::vec3{0.6F, 0.35F, 0.8F});

cloud::CloudLight fine_day() {
    cloud::CloudLight light;
    light.beams[cloud::CloudLight::kSun] = {true, kSunWay};
    light.beam_lx[cloud::CloudLight::kSun].fill(glm::vec3{static_cast<float>(kSun_lx)});
    light.above_cd_m2.fill({3000.0F, 4500.0F, 7500.0F});
    light.below_cd_m2.fill({2500.0F, 2600.0F, 2200.0F});
    return light;
}

render::Scene cumulus(CloudModel model) {
    render::Scene scene;
    scene.eye = {47.3, 8.1, 400.0};
    scene.weather.cloud_count = 1;
    render::CloudLayer& layer = scene.weather.clouds[0];
    layer.model = model;
    layer.thickness_m = 700.0;
    return scene;
}

// Evenly over the sky from 3 degrees up, neighbours beside each other.
std::vector<CloudRay> sky_rays() {
    std::vector<CloudRay> rays;
    for (std::size_t i = 0; i < kRays; ++i) {
        const double up =
            0.052 + 0.94 * (static_cast<double>(i / 64) + 0.5) / (static_cast<double>(kRays) / 64);
        const double turn = 2.0 * std::numbers::pi * (static_cast<double>(i % 64) + 0.5) / 64.0;
        const double across = std::sqrt(1.0 - up * up);
        rays.push_back({glm::vec3{glm::dvec3{across * std::cos(turn), across * std::sin(turn), up}}});
    }
    return rays;
}

// One moment as all models draw it.
struct Skies {
    render::SceneCloudMaker maker;
    std::vector<CloudRay> rays = sky_rays();
    std::array<const cloud::CloudSource*, kModels.size()> sources{};

    Skies() {
        const cloud::CloudLight light = fine_day();
        for (std::size_t i = 0; i < kModels.size(); ++i) {
            const render::Scene scene = cumulus(kModels[i]);
            maker.follow({scene, scene.eye, light}, kRay_rad, i == 0);
            sources[i] = &maker.freeze(i, {scene, scene.eye, light});
        }
    }
};

// Where a white sheet in the Sun is 255, before a sky of 4500 cd/m2.
double code(const CloudSample& sample) {
    const double white = kSun_lx / std::numbers::pi;
    const double seen =
        static_cast<double>(sample.light_cd_m2.y) + 4500.0 * static_cast<double>(sample.transmittance);
    return 255.0 * std::pow(std::clamp(seen / white, 0.0, 1.0), 1.0 / 2.2);
}

ErrorFigures against_particles() {
    const cloud::CloudLight light = fine_day();
    const render::Scene scene = cumulus(CloudModel::kImpostor);
    cloud::impostor::ImpostorSettings settings;
    settings.cells = 16;
    cloud::impostor::ImpostorClouds clouds(settings);
    clouds.update({.eye = scene.eye,
                   .layer = scene.weather.clouds[0],
                   .beams = light.beams,
                   .texel_rad = kRay_rad,
                   .jumped = true});
    cloud::impostor::ImpostorField drawn;
    const cloud::impostor::ImpostorClouds* layer = &clouds;
    drawn.freeze({&layer, 1}, light, scene.eye);
    const cloud::impostor::ParticleField particles(clouds, light, scene.eye);
    ErrorSamples errors;
    for (const CloudRay& ray : sky_rays()) {
        CloudSample ours;
        CloudSample truth;
        drawn.march({&ray, 1}, {}, kRay_rad, {&ours, 1});
        particles.march({&ray, 1}, {}, kRay_rad, {&truth, 1});
        // Near the Sun both are far beyond white.
        if (truth.transmittance > 0.999F || glm::dot(ray.direction_enu, kSunWay) > 0.9F) continue;
        errors.add(code(ours) - code(truth));
    }
    return errors.figures();
}

}  // namespace

std::vector<ModelEntry> cloud_pictures() {
    std::vector<ModelEntry> entries;
    for (std::size_t i = 0; i < kModels.size(); ++i)
        entries.push_back({std::string(kNames[i]), std::string(kWhat[i]), {}, {}});
    entries.back().errors.push_back(
        {"display code", "impostors against their particles", "/255", against_particles()});
    return entries;
}

std::vector<Contender> cloud_picture_contenders() {
    const auto skies = std::make_shared<const Skies>();
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < kModels.size(); ++i) {
        // As the map asks: a row of rays at a time.
        const auto march = [skies, i](std::uint64_t first, std::uint64_t count) {
            constexpr std::uint64_t kRow = 32;
            std::array<CloudSample, kRow> out;
            double sum = 0.0;
            for (std::uint64_t done = 0; done < count; done += kRow) {
                const std::uint64_t n = std::min(kRow, count - done);
                const std::uint64_t at = (first + done) / kRow * kRow % kRays;
                skies->sources[i]->march({&skies->rays[at], n}, {}, kRay_rad, {out.data(), n});
                sum += static_cast<double>(out[0].transmittance);
            }
            return sum;
        };
        contenders.push_back({std::string(kNames[i]), "ray", march, {}, kRays});
    }
    return contenders;
}

}  // namespace skyig::clients::bench
