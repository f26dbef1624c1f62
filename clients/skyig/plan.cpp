#include "clients/skyig/plan.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/skyig/still/still.h"
#include "render/clouds.h"
#include "render/screens.h"
#include "render/sky_frame.h"
#include "server/clock.h"
#include "server/from_config.h"
#include "server/scene_builder.h"

namespace skyig::clients {

namespace {

/// The plan of the first frame, which builds all tables, and of one that finds them fresh.
struct StillPlan {
    std::string utc;
    server::SkyAngles sky;
    render::Quality quality;
    double adaptation_cd_m2 = 0.0;
    /// Of each different screen.
    std::vector<render::ClippedLight> clipped;
    render::Plan first;
    render::Plan next;
};

StillPlan plan_still(const PlanOptions& options) {
    const server::SystemClock clock;
    const Still still = make_still(options.still, clock);
    StillPlan out;
    out.utc = server::ephemeris::to_iso(still.utc);
    out.sky = server::sky_angles(still.scene);
    out.quality = server::quality(still.config);
    const render::DisplaySettings display = server::display_settings(still.config);
    const std::vector<render::Channel> channels = server::render_channels(still.config);
    const render::Screens screens = render::screens_of(channels, display);
    render::SkyFrame frame(display, out.quality, screens.distinct);
    const double pixel_rad = render::finest_pixel_rad(channels, still.scene.channel_views());
    const double smallest_sr = render::smallest_pixel_sr(channels, still.scene.channel_views());
    if (still.scene.weather.cloud_count > 0) frame.draw_clouds(render::scene_clouds());
    frame.prepare(still.scene, pixel_rad, smallest_sr);
    out.first = frame.plan();
    render::plan_screens(out.first, channels);
    frame.prepare(still.scene, pixel_rad, smallest_sr);
    out.next = frame.plan();
    render::plan_screens(out.next, channels);
    out.adaptation_cd_m2 = frame.adaptation_cd_m2();
    for (std::size_t i = 0; i < screens.distinct.size(); ++i)
        out.clipped.push_back(frame.clipped(i));
    return out;
}

void print_text(const StillPlan& plan) {
    fmt::print("UTC         {}\n", plan.utc);
    fmt::print("Sun         elevation {:.2f} deg\n", plan.sky.sun_elevation_deg);
    fmt::print("Moon        elevation {:.2f} deg, {:.0f} % lit\n", plan.sky.moon_elevation_deg,
               plan.sky.moon_lit_fraction * 100.0);
    fmt::print("adaptation  {:.4g} cd/m2\n", plan.adaptation_cd_m2);
    for (const render::ClippedLight& clipped : plan.clipped) {
        fmt::print(
            "screen      cannot show {:.0f} % of the directions, being below its black, and {:.0f} % in "
            "full\n",
            100.0 * clipped.below_black, 100.0 * clipped.above_white);
    }
    fmt::print("sky         {}\n", render::name_of(plan.first.sky_model));
    fmt::print("budget      {:g} display codes\n\n", plan.quality.error_codes);
    fmt::print("{:<11} {:<6} {:<6} {:<12} {:>10} {:>7}  {}\n", "pass", "first", "later", "cost", "resolution",
               "codes", "why");
    for (std::size_t i = 0; i < render::kPassCount; ++i) {
        const render::PlannedPass& first = plan.first.passes[i];
        const render::PlannedPass& next = plan.next.passes[i];
        const bool sized = first.resolution.rows > 0;
        fmt::print("{:<11} {:<6} {:<6} {:<12} {:>10} {:>7}  {}\n", render::pass_name(first.pass),
                   first.needed ? "yes" : "no", next.needed ? "yes" : "no", render::cost_name(first.cost),
                   sized ? fmt::format("{} x {}", first.resolution.rows, first.resolution.columns) : "-",
                   sized ? fmt::format("{:.2f}", first.error_codes) : "-", first.reason);
    }
}

void print_json(const StillPlan& plan) {
    nlohmann::ordered_json json;
    json["utc"] = plan.utc;
    json["sun_elevation_deg"] = plan.sky.sun_elevation_deg;
    json["moon"] = {{"elevation_deg", plan.sky.moon_elevation_deg},
                    {"lit_fraction", plan.sky.moon_lit_fraction}};
    json["adaptation_cd_m2"] = plan.adaptation_cd_m2;
    json["screens"] = nlohmann::ordered_json::array();
    for (const render::ClippedLight& clipped : plan.clipped)
        json["screens"].push_back(
            {{"below_black", clipped.below_black}, {"above_white", clipped.above_white}});
    json["sky_model"] = render::name_of(plan.first.sky_model);
    json["budget_codes"] = plan.quality.error_codes;
    json["passes"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < render::kPassCount; ++i) {
        const render::PlannedPass& first = plan.first.passes[i];
        const render::PlannedPass& next = plan.next.passes[i];
        nlohmann::ordered_json pass{
            {"pass", render::pass_name(first.pass)}, {"needed", first.needed},
            {"needed_later", next.needed},           {"reason", first.reason},
            {"reason_later", next.reason},           {"cost", render::cost_name(first.cost)}};
        if (first.resolution.rows > 0) {
            pass["rows"] = first.resolution.rows;
            pass["columns"] = first.resolution.columns;
            pass["error_codes"] = first.error_codes;
        }
        json["passes"].push_back(std::move(pass));
    }
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_plan(const PlanOptions& options) {
    try {
        const StillPlan plan = plan_still(options);
        options.json ? print_json(plan) : print_text(plan);
        return 0;
    } catch (const StillErrors&) {
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig plan: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
