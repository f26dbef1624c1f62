#include "clients/skyig/frame/thinning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clients/skyig/frame/rig.h"
#include "render/gl/headless_context.h"
#include "render/plan.h"

namespace skyig::clients {

namespace {

using render::Thin;

struct ThinCase {
    RigSetting setting;
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
    const auto nothing = [](render::Scene&) {};
    return {{kDay, nothing},
            {kNight, nothing},
            {{"Sun in view", kDay.utc, "", 600.0, 103.0, 42.0}, nothing},
            {{"full Moon in view", "2026-01-03T22:00:00Z", "", 600.0, 140.0, 55.0}, nothing},
            {{"sea below", kDay.utc, "", 30.0, 300.0, -20.0}, add_waves},
            {{"rain", kDay.utc, "rain", 100.0, 0.0, 5.0}, nothing},
            {kBroken, nothing},
            {kInCloud, nothing},
            {{"below cloud, down", kDay.utc, "broken", 300.0, 300.0, -10.0}, nothing},
            {{"above cloud", kDay.utc, "broken", 3000.0, 300.0, -20.0}, nothing}};
}

struct Saving {
    Thin thin = Thin::kCloudRefresh;
    std::string_view where;
    double whole_ms = 0.0;
    /// Of a whole frame's time, median of the pairs: of wall time, of processor time of all threads.
    double saved_wall = 0.0;
    double saved_processor = 0.0;
};

/// Two rigs fly the same way, one of them thinned, and take turns some frames at a time: what else runs on
/// the machine touches both, and a thread that marches clouds for one is soon done.
Saving saving_of(Thin thin, const ThinCase& what, int frames, const server::Clock& clock) {
    constexpr int kAtATime = 12;
    Rig whole(still_of(what.setting, kOneChannel, clock), clock);
    Rig thinned(still_of(what.setting, kOneChannel, clock), clock);
    render::Thinned left_out;
    left_out.set(static_cast<std::size_t>(thin));
    thinned.renderer().thin(left_out);
    for (Rig* rig : {&whole, &thinned}) {
        what.change(rig->scene());
        for (int i = 0; i < kWarmUpFrames; ++i)
            rig->frame();
    }
    const auto some = [](Rig& rig) {
        FrameTime sum;
        for (int i = 0; i < kAtATime; ++i) {
            const FrameTime time = rig.frame();
            sum.wall_ms += time.wall_ms / kAtATime;
            sum.processor_ms += time.processor_ms / kAtATime;
        }
        return sum;
    };
    std::vector<double> whole_ms, saved_wall, saved_processor;
    for (int turn = 0; turn < std::max(2, frames / kAtATime); ++turn) {
        const bool first = turn % 2 == 0;
        const FrameTime one = some(first ? whole : thinned);
        const FrameTime other = some(first ? thinned : whole);
        const FrameTime& all = first ? one : other;
        const FrameTime& less = first ? other : one;
        whole_ms.push_back(all.wall_ms);
        saved_wall.push_back(1.0 - less.wall_ms / all.wall_ms);
        saved_processor.push_back(1.0 - less.processor_ms / all.processor_ms);
    }
    return {thin, what.setting.name, quantile(whole_ms, 0.5), quantile(saved_wall, 0.5),
            quantile(saved_processor, 0.5)};
}

/// What could be left out of a scene.
render::Thinned things_of(const ThinCase& what, const server::Clock& clock) {
    Rig rig(still_of(what.setting, kOneChannel, clock), clock);
    what.change(rig.scene());
    return render::thinnable(rig.renderer().prepare(rig.scene()).plan);
}

/// Tells of each as it is measured.
void measure(int frames, const std::function<void(const Saving&)>& tell) {
    const server::SystemClock clock;
    for (const ThinCase& what : thin_cases()) {
        const render::Thinned things = things_of(what, clock);
        for (std::size_t i = 0; i < render::kThinCount; ++i)
            if (things[i]) tell(saving_of(static_cast<Thin>(i), what, frames, clock));
    }
}

void print_text(const std::string& renderer, int frames) {
    fmt::print(
        "What each thing saves of a whole frame, {}, on {} (`skyig bench thinning --rounds {}`):\n\n"
        "| scene | left out | a whole frame, ms | saved, of its time | of the processors' |\n"
        "|---|---|---|---|---|\n",
        kOneChannel.name, renderer, frames);
    measure(frames, [](const Saving& saving) {
        fmt::print("| {} | `{}` | {:.1f} | {:.0f} % | {:.0f} % |\n", saving.where,
                   render::thin_name(saving.thin), saving.whole_ms, 100.0 * saving.saved_wall,
                   100.0 * saving.saved_processor);
        std::fflush(stdout);
    });
}

void print_json(const std::string& renderer, int frames) {
    nlohmann::ordered_json json;
    json["renderer"] = renderer;
    json["thinning"] = nlohmann::ordered_json::array();
    measure(frames, [&](const Saving& saving) {
        json["thinning"].push_back({{"what", render::thin_name(saving.thin)},
                                    {"scene", saving.where},
                                    {"whole_ms", saving.whole_ms},
                                    {"saved_of_wall_time", saving.saved_wall},
                                    {"saved_of_processor_time", saving.saved_processor}});
    });
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_thinning(const BenchOptions& options) {
    try {
        const auto context = render::gl::HeadlessContext::create(false);
        options.json ? print_json(context.description(), options.rounds)
                     : print_text(context.description(), options.rounds);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig bench thinning: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
