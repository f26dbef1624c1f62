#include "clients/skyig/frame/preview_cost.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/skyig/frame/rig.h"
#include "render/gl/headless_context.h"
#include "render/output/jpeg.h"
#include "server/from_config.h"
#include "server/preview.h"

namespace skyig::clients {

namespace {

constexpr std::array<RigSetting, 2> kSettings{kDay, kBroken};

/// Frames of some time one after the other, as fast as they go.
struct Stretch {
    std::vector<double> times_ms;
    /// A frame, of all threads.
    double processor_ms = 0.0;
    double seconds = 0.0;
    int pictures = 0;
};

class WatchedRig {
  public:
    WatchedRig(const RigSetting& setting, const server::Clock& clock)
        : clock_(clock),
          still_(still_of(setting, kThreeChannels, clock)),
          rig_(still_, clock),
          preview_(server::render_channels(still_.config),
                   {.rate_hz = still_.config.preview.rate_hz,
                    .width_px = still_.config.preview.width_px,
                    .quality = still_.config.preview.quality},
                   render::output::encode_jpeg) {
        for (int i = 0; i < kWarmUpFrames; ++i)
            rig_.frame();
    }

    Stretch draw_for(double seconds, bool watched) {
        constexpr int kFewest = 4;
        Stretch stretch;
        // What is encoded for the stretch before ends in the first frames.
        for (int i = 0; i < 2; ++i)
            rig_.frame();
        const std::uint64_t made_before = pictures_made();
        const std::int64_t begin_ns = clock_.monotonic_ns();
        const std::int64_t processor_ns = clock_.processor_ns();
        const auto passed_s = [&] { return static_cast<double>(clock_.monotonic_ns() - begin_ns) * 1e-9; };
        for (int i = 0; i < kFewest || passed_s() < seconds; ++i) {
            const double offered_ms = watched ? offer_ms() : 0.0;
            stretch.times_ms.push_back(rig_.frame().wall_ms + offered_ms);
        }
        stretch.seconds = passed_s();
        stretch.processor_ms = static_cast<double>(clock_.processor_ns() - processor_ns) * 1e-6 /
                               static_cast<double>(stretch.times_ms.size());
        stretch.pictures = static_cast<int>(pictures_made() - made_before);
        return stretch;
    }

  private:
    std::uint64_t pictures_made() {
        std::uint64_t made = 0;
        for (std::size_t i = 0; i < rig_.scene().view_count; ++i)
            made += preview_.newest(i, asked_ns_).number;
        return made;
    }

    double offer_ms() {
        const std::int64_t begin_ns = asked_ns_ = clock_.monotonic_ns();
        (void)pictures_made();
        preview_.offer(begin_ns, [this](std::size_t channel, std::span<std::byte> rgba) {
            rig_.renderer().read_back(channel, rgba);
        });
        return static_cast<double>(clock_.monotonic_ns() - begin_ns) * 1e-6;
    }

    const server::Clock& clock_;
    Still still_;
    Rig rig_;
    server::Preview preview_;
    std::int64_t asked_ns_ = 0;
};

struct Cost {
    std::string_view where;
    double frame_ms = 0.0;
    /// Watched over unwatched: medians of the pairs' mean times, wall and processor; p95 of all frames.
    double wall_ratio = 0.0;
    double processor_ratio = 0.0;
    double p95_ratio = 0.0;
    double pictures_a_second = 0.0;
};

Cost cost_of(const RigSetting& setting, int pairs, const server::Clock& clock) {
    constexpr double kStretch_s = 1.0;
    WatchedRig rig(setting, clock);
    std::array<std::vector<double>, 2> times_ms;
    std::vector<double> wall_ratios, processor_ratios;
    double pictures = 0.0, seconds = 0.0;
    const auto draw = [&](bool watched) {
        Stretch stretch = rig.draw_for(kStretch_s, watched);
        std::vector<double>& all_ms = times_ms[watched ? 1 : 0];
        all_ms.insert(all_ms.end(), stretch.times_ms.begin(), stretch.times_ms.end());
        if (watched) {
            pictures += stretch.pictures;
            seconds += stretch.seconds;
        }
        return stretch;
    };
    for (int pair = 0; pair < pairs; ++pair) {
        const bool first = pair % 2 == 1;
        const Stretch one = draw(first);
        const Stretch other = draw(!first);
        const Stretch& watched = first ? one : other;
        const Stretch& unwatched = first ? other : one;
        wall_ratios.push_back(mean(watched.times_ms) / mean(unwatched.times_ms));
        processor_ratios.push_back(watched.processor_ms / unwatched.processor_ms);
    }
    return {setting.name,
            quantile(times_ms[0], 0.5),
            quantile(wall_ratios, 0.5),
            quantile(processor_ratios, 0.5),
            quantile(times_ms[1], 0.95) / quantile(times_ms[0], 0.95),
            pictures / seconds};
}

void print_text(const std::string& renderer, int pairs, const std::vector<Cost>& costs) {
    fmt::print(
        "Frames with their pictures read back and made previews of, over such without, drawn as fast as they "
        "go, {}, {} pairs of a second each, on {} (`skyig bench preview --rounds {}`):\n\n",
        kThreeChannels.name, pairs, renderer, pairs);
    fmt::print(
        "| scene | a frame, ms | time, median of pairs | of the processors | p95 | pictures a second |\n");
    fmt::print("|---|---|---|---|---|---|\n");
    for (const Cost& cost : costs) {
        fmt::print("| {} | {:.1f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n", cost.where, cost.frame_ms,
                   cost.wall_ratio, cost.processor_ratio, cost.p95_ratio, cost.pictures_a_second);
    }
}

void print_json(const std::string& renderer, const std::vector<Cost>& costs) {
    nlohmann::ordered_json json;
    json["renderer"] = renderer;
    json["preview"] = nlohmann::ordered_json::array();
    for (const Cost& cost : costs) {
        json["preview"].push_back({{"scene", cost.where},
                                   {"frame_ms", cost.frame_ms},
                                   {"time_ratio", cost.wall_ratio},
                                   {"processor_time_ratio", cost.processor_ratio},
                                   {"p95_ratio", cost.p95_ratio},
                                   {"pictures_a_second", cost.pictures_a_second}});
    }
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_preview_cost(const BenchOptions& options) {
    try {
        const auto context = render::gl::HeadlessContext::create(false);
        const server::SystemClock clock;
        std::vector<Cost> costs;
        for (const RigSetting& setting : kSettings)
            costs.push_back(cost_of(setting, options.rounds, clock));
        if (options.json)
            print_json(context.description(), costs);
        else
            print_text(context.description(), options.rounds, costs);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig bench preview: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
