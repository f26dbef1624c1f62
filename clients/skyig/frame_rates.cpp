#include "clients/skyig/frame_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/skyig/still/still.h"
#include "server/clock.h"
#include "server/from_config.h"
#include "server/gl_painter.h"

namespace skyig::clients {

namespace {

struct Size {
    std::string_view name;
    int width_px;
    int height_px;
    int channels;
};
constexpr std::array<Size, 6> kSizes{{{"640x480", 640, 480, 1},
                                      {"1024x768", 1024, 768, 1},
                                      {"1280x1024", 1280, 1024, 1},
                                      {"1920x1080", 1920, 1080, 1},
                                      {"2048x1536", 2048, 1536, 1},
                                      {"3 x 1280x1024", 1280, 1024, 3}}};

struct Setting {
    std::string_view name;
    std::string_view utc;
    std::string_view weather;
    double height_m;
    double heading_deg;
    double pitch_deg;
};
constexpr std::array<Setting, 4> kSettings{
    {{"day", "2026-06-21T09:00:00Z", "", 600.0, 300.0, 5.0},
     {"night", "2026-01-15T23:00:00Z", "", 600.0, 150.0, 20.0},
     {"broken cloud", "2026-06-21T09:00:00Z", "broken", 300.0, 300.0, 5.0},
     {"in cloud", "2026-06-21T09:00:00Z", "broken", 900.0, 300.0, 5.0}}};

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

constexpr double kRate_hz = 60.0;
constexpr double kSpeed_m_s = 100.0;

/// A craft that flies east, so that clouds have to be followed.
void fly_on(render::Scene& scene) {
    constexpr double kMetresADegree = 111'320.0;
    scene.time_s += 1.0 / kRate_hz;
    ++scene.frame_number;
    scene.eye.longitude_deg +=
        kSpeed_m_s / kRate_hz / (kMetresADegree * std::cos(glm::radians(scene.eye.latitude_deg)));
}

/// The same view turned to the right about its own upward axis.
render::ChannelView turned(const render::ChannelView& view, double right_deg) {
    const double a = glm::radians(right_deg);
    const glm::dmat3 turn{glm::dvec3{std::cos(a), 0.0, -std::sin(a)}, glm::dvec3{0.0, 1.0, 0.0},
                          glm::dvec3{std::sin(a), 0.0, std::cos(a)}};
    render::ChannelView out = view;
    out.view_from_enu = turn * view.view_from_enu;
    return out;
}

Still still_of(const Setting& setting, const Size& size, const server::Clock& clock) {
    StillOptions options;
    options.utc = setting.utc;
    options.weather_preset = setting.weather;
    options.height_m = setting.height_m;
    options.heading_deg = setting.heading_deg;
    options.pitch_deg = setting.pitch_deg;
    options.width_px = size.width_px;
    options.height_px = size.height_px;
    Still still = make_still(options, clock);
    const config::Channel first = still.config.channels.front();
    for (int i = 1; i < size.channels; ++i) {
        still.config.channels.push_back(first);
        const auto index = static_cast<std::size_t>(i);
        still.scene.views[index] = turned(still.scene.views[0], i == 1 ? 60.0 : -60.0);
        still.scene.view_count = index + 1;
    }
    return still;
}

/// Draws frames of one rig.
class Rig {
  public:
    Rig(Still still, const server::Clock& clock)
        : clock_(clock),
          scene_(std::move(still.scene)),
          painter_({.channels = server::render_channels(still.config),
                    .display = server::display_settings(still.config),
                    .quality = server::quality(still.config)}) {}

    render::Scene& scene() noexcept { return scene_; }
    server::GlPainter& painter() noexcept { return painter_; }

    double frame_ms() {
        fly_on(scene_);
        const std::int64_t begin_ns = clock_.monotonic_ns();
        painter_.prepare(scene_);
        for (std::size_t channel = 0; channel < scene_.view_count; ++channel)
            painter_.draw(channel);
        return static_cast<double>(clock_.monotonic_ns() - begin_ns) * 1e-6;
    }

  private:
    const server::Clock& clock_;
    render::Scene scene_;
    server::GlPainter painter_;
};

double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

struct Row {
    std::string_view setting;
    std::string_view size;
    double frames_a_second = 0.0;
    double median_ms = 0.0;
    double p95_ms = 0.0;
};

/// Shaders are compiled late, and the first cloud map is blended in.
constexpr int kWarmUp = 20;

Row rate_of(const Setting& setting, const Size& size, int frames, const server::Clock& clock,
            std::string& renderer) {
    Rig rig(still_of(setting, size, clock), clock);
    renderer = rig.painter().description();
    for (int i = 0; i < kWarmUp; ++i)
        rig.frame_ms();
    std::vector<double> times_ms;
    double sum_ms = 0.0;
    for (int i = 0; i < frames; ++i)
        sum_ms += times_ms.emplace_back(rig.frame_ms());
    return {setting.name, size.name, 1e3 * frames / sum_ms, quantile(times_ms, 0.5),
            quantile(times_ms, 0.95)};
}

struct Saving {
    render::Thin thin;
    std::string_view where;
    double whole_ms = 0.0;
    double thinned_ms = 0.0;
};

struct ThinCase {
    render::Thin thin;
    std::string_view where;
    Setting setting;
    std::function<void(render::Scene&)> change;
};

void add_waves(render::Scene& scene) {
    scene.ground.kind = render::Ground::Kind::kSea;
    scene.ground.wind_m_s = 5.0;
    for (const render::Wave& wave :
         {render::Wave{.height_m = 2.0, .length_m = 110.0, .period_s = 8.4, .direction_rad = 0.9},
          render::Wave{.height_m = 0.5, .length_m = 27.0, .period_s = 4.2, .direction_rad = 0.5}})
        scene.sea.waves[scene.sea.wave_count++] = wave;
}

std::vector<ThinCase> thin_cases() {
    using render::Thin;
    const auto nothing = [](render::Scene&) {};
    const Setting day = kSettings[0], night = kSettings[1], broken = kSettings[2];
    Setting sea = day;
    sea.height_m = 30.0;
    sea.pitch_deg = -20.0;
    Setting sun = day;
    sun.heading_deg = 103.0;
    sun.pitch_deg = 42.0;
    Setting rain = day;
    rain.weather = "rain";
    return {{Thin::kCloudRefresh, "broken cloud", broken, nothing},
            {Thin::kCloudMotion, "broken cloud", broken, nothing},
            {Thin::kDome, "day", day, nothing},
            {Thin::kStars, "night", night, nothing},
            {Thin::kPrecipitation, "rain", rain, nothing},
            {Thin::kWaves, "sea below", sea, add_waves},
            {Thin::kGlare, "Sun in view", sun, nothing},
            {Thin::kMilkyWay, "night", night, nothing}};
}

/// Whole and thinned frames take turns, some at a time, so that what else runs on the machine touches both.
Saving saving_of(const ThinCase& what, int frames, const server::Clock& clock) {
    constexpr int kAtATime = 30;
    Rig rig(still_of(what.setting, kSizes[2], clock), clock);
    what.change(rig.scene());
    for (int i = 0; i < kWarmUp; ++i)
        rig.frame_ms();
    render::Thinned thinned;
    thinned.set(static_cast<std::size_t>(what.thin));
    std::array<std::vector<double>, 2> times_ms;
    for (int turn = 0; turn < std::max(2, 2 * frames / kAtATime); ++turn) {
        rig.painter().thin(turn % 2 == 1 ? thinned : render::Thinned{});
        for (int i = 0; i < kAtATime; ++i) {
            const double frame_ms = rig.frame_ms();
            // A thing fades.
            if (i >= kAtATime / 3) times_ms[static_cast<std::size_t>(turn % 2)].push_back(frame_ms);
        }
    }
    const auto mean_ms = [](std::vector<double> values) {
        // Without the tenth that was disturbed most.
        std::sort(values.begin(), values.end());
        const std::size_t count = values.size() - values.size() / 10;
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            sum += values[i];
        return sum / static_cast<double>(count);
    };
    return {what.thin, what.where, mean_ms(times_ms[0]), mean_ms(times_ms[1])};
}

struct Result {
    std::string renderer;
    std::vector<Row> rows;
    std::vector<Saving> savings;
};

Result measure(int frames) {
    const server::SystemClock clock;
    Result result;
    for (const Setting& setting : kSettings) {
        for (const Size& size : kSizes)
            result.rows.push_back(rate_of(setting, size, frames, clock, result.renderer));
    }
    for (const ThinCase& what : thin_cases())
        result.savings.push_back(saving_of(what, frames, clock));
    return result;
}

void print_text(const Result& result) {
    fmt::print("OpenGL {}\n\nframes a second (shared work, all channels, finished)\n{:<15}", result.renderer,
               "");
    for (const Setting& setting : kSettings)
        fmt::print("{:>14}", setting.name);
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
        fmt::print("\n{:<15}", kSizes[size].name);
        for (std::size_t setting = 0; setting < kSettings.size(); ++setting)
            fmt::print("{:>14.1f}", result.rows[setting * kSizes.size() + size].frames_a_second);
    }
    fmt::print("\n\nwhat others say of theirs, on their hardware\n");
    for (const Claim& claim : kClaims)
        fmt::print("{:>6.0f}  {}\n", claim.frames_a_second, claim.what);
    fmt::print("\nwhat thinning saves, 1280x1024, ms a frame\n{:<15}{:<14}{:>8}{:>10}{:>8}\n", "", "in",
               "whole", "thinned", "saved");
    for (const Saving& saving : result.savings) {
        fmt::print("{:<15}{:<14}{:>8.2f}{:>10.2f}{:>7.0f}%\n", render::thin_name(saving.thin), saving.where,
                   saving.whole_ms, saving.thinned_ms, 100.0 * (1.0 - saving.thinned_ms / saving.whole_ms));
    }
}

void print_json(const Result& result) {
    nlohmann::ordered_json json;
    json["renderer"] = result.renderer;
    json["rates"] = nlohmann::ordered_json::array();
    for (const Row& row : result.rows) {
        json["rates"].push_back({{"scene", row.setting},
                                 {"size", row.size},
                                 {"frames_a_second", row.frames_a_second},
                                 {"median_ms", row.median_ms},
                                 {"p95_ms", row.p95_ms}});
    }
    json["claims"] = nlohmann::ordered_json::array();
    for (const Claim& claim : kClaims)
        json["claims"].push_back({{"what", claim.what}, {"frames_a_second", claim.frames_a_second}});
    json["thinning"] = nlohmann::ordered_json::array();
    for (const Saving& saving : result.savings) {
        json["thinning"].push_back({{"what", render::thin_name(saving.thin)},
                                    {"scene", saving.where},
                                    {"whole_ms", saving.whole_ms},
                                    {"thinned_ms", saving.thinned_ms}});
    }
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_frame_rates(const BenchOptions& options) {
    try {
        const Result result = measure(options.rounds);
        options.json ? print_json(result) : print_text(result);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig bench frame: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
