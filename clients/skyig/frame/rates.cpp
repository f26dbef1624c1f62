#include "clients/skyig/frame/rates.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clients/skyig/frame/rig.h"
#include "render/gl/headless_context.h"

namespace skyig::clients {

namespace {

constexpr std::array<RigSize, 6> kSizes{{{"640x480", 640, 480, 1},
                                         {"1024x768", 1024, 768, 1},
                                         kOneChannel,
                                         {"1920x1080", 1920, 1080, 1},
                                         {"2048x1536", 2048, 1536, 1},
                                         kThreeChannels}};
constexpr std::array<RigSetting, 4> kSettings{kDay, kNight, kBroken, kInCloud};

/// What others say of their own programs, on their own hardware.
struct Claim {
    std::string_view what;
    double frames_a_second;
};
constexpr std::array<Claim, 5> kClaims{{{"scattering sky by day, 1280x1024, GeForce GTX 260", 210.0},
                                        {"the same by night", 320.0},
                                        {"sky and clouds over 80,000 polygons, 1024x768, Radeon X700", 120.0},
                                        {"another sky, size and card not told", 67.0},
                                        {"sky with clouds, mobile Radeon HD 5870", 50.0}}};

struct Rate {
    std::string_view setting;
    std::string_view size;
    double frames_a_second = 0.0;
    double median_ms = 0.0;
    double p95_ms = 0.0;
};

Rate rate_of(const RigSetting& setting, const RigSize& size, int frames, const server::Clock& clock) {
    Rig rig(still_of(setting, size, clock), clock);
    for (int i = 0; i < kWarmUpFrames; ++i)
        rig.frame();
    std::vector<double> times_ms;
    for (int i = 0; i < frames; ++i)
        times_ms.push_back(rig.frame().wall_ms);
    return {setting.name, size.name, 1e3 / mean(times_ms), quantile(times_ms, 0.5), quantile(times_ms, 0.95)};
}

/// Setting by setting, in the order of the sizes.
std::vector<Rate> measure(int frames) {
    const server::SystemClock clock;
    std::vector<Rate> rates;
    for (const RigSetting& setting : kSettings) {
        for (const RigSize& size : kSizes)
            rates.push_back(rate_of(setting, size, frames, clock));
    }
    return rates;
}

void print_text(const std::string& renderer, int frames, const std::vector<Rate>& rates) {
    fmt::print(
        "Frames a second (shared work, all channels, finished) and the 95th percentile of a frame's "
        "milliseconds, on {} (`skyig bench frame --rounds {}`):\n\n| pictures |",
        renderer, frames);
    for (const RigSetting& setting : kSettings)
        fmt::print(" {} |", setting.name);
    fmt::print("\n|---|{}\n", "---|---|---|---|");
    static_assert(kSettings.size() == 4);
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
        fmt::print("| {} |", kSizes[size].name);
        for (std::size_t setting = 0; setting < kSettings.size(); ++setting) {
            const Rate& rate = rates[setting * kSizes.size() + size];
            fmt::print(" {:.1f}, {:.1f} ms |", rate.frames_a_second, rate.p95_ms);
        }
        fmt::print("\n");
    }
    fmt::print(
        "\nWhat others say of theirs, on their hardware:\n\n| program | frames a second |\n|---|---|\n");
    for (const Claim& claim : kClaims)
        fmt::print("| {} | {:.0f} |\n", claim.what, claim.frames_a_second);
}

void print_json(const std::string& renderer, const std::vector<Rate>& rates) {
    nlohmann::ordered_json json;
    json["renderer"] = renderer;
    json["rates"] = nlohmann::ordered_json::array();
    for (const Rate& rate : rates) {
        json["rates"].push_back({{"scene", rate.setting},
                                 {"size", rate.size},
                                 {"frames_a_second", rate.frames_a_second},
                                 {"median_ms", rate.median_ms},
                                 {"p95_ms", rate.p95_ms}});
    }
    json["claims"] = nlohmann::ordered_json::array();
    for (const Claim& claim : kClaims)
        json["claims"].push_back({{"what", claim.what}, {"frames_a_second", claim.frames_a_second}});
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_frame_rates(const BenchOptions& options) {
    try {
        const auto context = render::gl::HeadlessContext::create(false);
        const std::vector<Rate> rates = measure(options.rounds);
        if (options.json)
            print_json(context.description(), rates);
        else
            print_text(context.description(), options.rounds, rates);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig bench frame: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
