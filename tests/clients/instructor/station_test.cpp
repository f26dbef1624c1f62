// What pages ask for, as the packets that a daemon reads.
#include "clients/instructor/station.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clients/instructor/almanac.h"
#include "config/presets.h"
#include "protocol/cigi/message.h"
#include "protocol/cigi/session.h"
#include "tests/e2e/process.h"

namespace skyig::clients::instructor {
namespace {

namespace cigi = protocol::cigi;
using Json = nlohmann::ordered_json;

/// A daemon as far as the station sees it: it keeps what packets say and tells it.
struct Daemon {
    std::vector<cigi::WeatherControl> layers;
    std::vector<cigi::AtmosphereControl> airs;
    std::vector<cigi::CelestialSphereControl> clocks;
    std::vector<cigi::TerrestrialSurfaceControl> grounds;
    int controls = 0;
    cigi::Counters counters;

    void operator()(const cigi::IgControl& packet) {
        ++controls;
        EXPECT_EQ(packet.ig_mode, cigi::IgMode::kOperate);
        EXPECT_EQ(packet.database_number, 0);
    }
    void operator()(const cigi::WeatherControl& packet) {
        std::erase_if(layers, [&](const auto& before) { return before.layer_id == packet.layer_id; });
        layers.push_back(packet);
    }
    void operator()(const cigi::AtmosphereControl& packet) { airs.push_back(packet); }
    void operator()(const cigi::CelestialSphereControl& packet) { clocks.push_back(packet); }
    void operator()(const cigi::TerrestrialSurfaceControl& packet) { grounds.push_back(packet); }

    /// Only what anything was said about.
    bool hear(std::span<const std::byte> bytes) {
        if (bytes.empty()) return false;
        const cigi::MessageSummary summary = cigi::decode_host_message(bytes, *this, counters);
        EXPECT_TRUE(summary.accepted && !summary.fault);
        return true;
    }
    [[nodiscard]] const cigi::WeatherControl* layer(int id) const {
        for (const auto& one : layers)
            if (one.layer_id == id && one.weather_enable) return &one;
        return nullptr;
    }
    [[nodiscard]] Json status(const std::string& utc, bool running = true) const {
        Json told = Json::array();
        for (const auto& one : layers)
            told.push_back({{"id", one.layer_id},
                            {"enabled", one.weather_enable},
                            {"cloud_type", static_cast<int>(one.cloud_type)},
                            {"severity", one.severity},
                            {"lightning", one.random_lightning},
                            {"base_m", one.base_elevation},
                            {"top_m", one.base_elevation + one.thickness},
                            {"bottom_band_m", one.transition_band},
                            {"top_band_m", one.top_transition_band},
                            {"coverage_pct", one.coverage},
                            {"visibility_m", one.visibility},
                            {"aerosol_g_m3", one.aerosol},
                            {"wind_m_s", one.wind_horizontal},
                            {"wind_from_deg", one.wind_direction}});
        const cigi::AtmosphereControl air = airs.empty() ? cigi::AtmosphereControl{} : airs.back();
        return {{"world",
                 {{"utc", utc},
                  {"clock_running", running},
                  {"air",
                   {{"visibility_m", airs.empty() ? 80000.0F : air.visibility},
                    {"temperature_c", airs.empty() ? 15.0F : air.air_temperature},
                    {"pressure_hpa", airs.empty() ? 1013.25F : air.pressure},
                    {"humidity_pct", airs.empty() ? 50 : air.humidity},
                    {"wind_horizontal_m_s", air.wind_horizontal},
                    {"wind_from_deg", air.wind_direction}}},
                  {"weather", {{"elevation_m", 432.0}, {"transition_s", 5.0}, {"layers", told}}}}}};
    }
};

class StationTest : public ::testing::Test {
  protected:
    StationTest() {
        station_.daemon_says(daemon_.status("2026-06-21T12:00:00.000Z"), 0.0);
        daemon_.hear(station_.due_message(0.0));
    }
    /// Expects it to be obeyed.
    void ask(const Json& wish) {
        EXPECT_EQ(station_.take(wish.dump(), time_s_), "") << wish;
        daemon_.hear(station_.due_message(time_s_));
    }
    [[nodiscard]] std::string refusal(const Json& wish) { return station_.take(wish.dump(), time_s_); }

    Station station_{SavedSettings::open("").value()};
    Daemon daemon_;
    double time_s_ = 10.0;
};

TEST_F(StationTest, APresetIsOneMessageOfItsAirAndLayers) {
    ask({{"do", "preset"}, {"name", "storm"}});
    ASSERT_EQ(daemon_.airs.size(), 1U);
    EXPECT_FLOAT_EQ(daemon_.airs[0].visibility, 6000.0F);
    EXPECT_EQ(daemon_.airs[0].humidity, 90);
    EXPECT_TRUE(daemon_.airs[0].model_enable);
    const auto* cloud = daemon_.layer(1);
    ASSERT_NE(cloud, nullptr);
    EXPECT_EQ(cloud->cloud_type, cigi::CloudType::kCumulonimbus);
    EXPECT_NEAR(cloud->base_elevation, 432.0 + 2000 * 0.3048, 0.01);
    EXPECT_NEAR(cloud->thickness, 38000 * 0.3048, 0.01);
    EXPECT_FLOAT_EQ(cloud->coverage, 75.0F);
    EXPECT_TRUE(cloud->random_lightning);
    const auto* rain = daemon_.layer(4);
    ASSERT_NE(rain, nullptr);
    // 0.0889 R^0.84 g/m3.
    EXPECT_NEAR(rain->aerosol, 0.0889 * std::pow(15.0, 0.84), 1e-3);
    EXPECT_TRUE(daemon_.clocks.empty()) << "the clock was not asked for";
}

TEST_F(StationTest, EveryPresetComesThroughPacketsAndStatusUnchanged) {
    for (const std::string_view name : config::kPresetNames) {
        station_.daemon_says(daemon_.status("2026-06-21T12:00:00Z"), time_s_);
        ask({{"do", "preset"}, {"name", name}});
        const Json world = daemon_.status("2026-06-21T12:00:00Z")["world"];
        EXPECT_TRUE(is_shown(station_.weather(), world)) << name;
        const Setting back = setting_from_status(world);
        EXPECT_TRUE(is_shown(back, world)) << name;
        const auto again = setting_from_json(to_json(station_.weather()));
        ASSERT_TRUE(again) << name << again.error();
        EXPECT_EQ(again->layers, station_.weather().layers) << name;
        EXPECT_FALSE(preset_title(name).empty());
    }
    EXPECT_EQ(daemon_.counters[cigi::Count::kOutOfRange], 0U);
}

TEST_F(StationTest, LayersOfBeforeAreSwitchedOff) {
    ask({{"do", "preset"}, {"name", "storm"}});
    station_.daemon_says(daemon_.status("2026-06-21T12:00:11Z"), 11.0);
    ask({{"do", "preset"}, {"name", "cavok"}});
    EXPECT_EQ(daemon_.layer(1), nullptr);
    EXPECT_EQ(daemon_.layer(4), nullptr);
    EXPECT_FLOAT_EQ(daemon_.airs.back().visibility, 50000.0F);
}

TEST_F(StationTest, ADragIsOneStepBackAndUndoGoesBothWays) {
    ask({{"do", "preset"}, {"name", "broken"}});
    Json weather = to_json(station_.weather());
    const double base_m = weather["layers"][0]["base_m"];
    for (int i = 1; i <= 5; ++i) {
        weather["layers"][0]["base_m"] = base_m + 30.0 * i;
        ask({{"do", "weather"}, {"weather", weather}, {"what", "base"}, {"gesture", "drag-1"}});
    }
    EXPECT_NEAR(daemon_.layer(1)->base_elevation, 432.0 + base_m + 150.0, 0.01);
    ask({{"do", "undo"}});
    EXPECT_NEAR(daemon_.layer(1)->base_elevation, 432.0 + base_m, 0.01);
    ask({{"do", "redo"}});
    EXPECT_NEAR(daemon_.layer(1)->base_elevation, 432.0 + base_m + 150.0, 0.01);
    ask({{"do", "undo"}});
    ask({{"do", "undo"}});
    EXPECT_NE(refusal({{"do", "undo"}}), "");
}

TEST_F(StationTest, TheClockIsSetFrozenAndHurried) {
    ask({{"do", "clock"}, {"utc", "2026-12-24T17:30:15Z"}});
    ASSERT_EQ(daemon_.clocks.size(), 1U);
    const cigi::CelestialSphereControl set = daemon_.clocks[0];
    EXPECT_EQ(set.date, 12242026U);
    EXPECT_EQ(set.hour, 17);
    EXPECT_EQ(set.minute, 30);
    EXPECT_FLOAT_EQ(set.seconds, 15.0F);
    EXPECT_TRUE(set.date_time_valid && set.ephemeris_enable && set.sun_enable && set.moon_enable &&
                set.star_enable);
    EXPECT_FLOAT_EQ(set.star_intensity, 100.0F);
    time_s_ = 20.0;
    ask({{"do", "clock"}, {"running", false}});
    EXPECT_FALSE(daemon_.clocks.back().ephemeris_enable);
    EXPECT_NEAR(daemon_.clocks.back().seconds, 25.0, 0.01);
    ask({{"do", "clock"}, {"running", true}, {"speed", 60.0}});
    const std::size_t before = daemon_.clocks.size();
    // No step of the clock reaches the 2 s that count as a jump.
    float last_s = daemon_.clocks.back().seconds;
    for (int i = 0; i < 20; ++i) {
        time_s_ += 0.0255;
        if (!daemon_.hear(station_.due_message(time_s_))) continue;
        const float step_s = std::fmod(daemon_.clocks.back().seconds - last_s + 60.0F, 60.0F);
        EXPECT_LT(step_s, 2.0F);
        last_s = daemon_.clocks.back().seconds;
    }
    EXPECT_EQ(daemon_.clocks.size(), before + 20);
    ask({{"do", "undo"}});
    ask({{"do", "undo"}});
    ask({{"do", "undo"}});
    EXPECT_EQ(daemon_.clocks.back().hour, 12) << "as the daemon had it before";
}

TEST_F(StationTest, AReportIsShownThenMadeTheWeather) {
    const std::string text = "METAR LSZH 011250Z 24012KT 3000 RA BKN010 15/08 Q1008";
    const Json shown = Json::parse(station_.take(Json{{"do", "decode"}, {"text", text}}.dump(), time_s_));
    EXPECT_NE(shown["page"].get<std::string>().find("LSZH"), std::string::npos);
    EXPECT_EQ(shown["problems"], "");
    EXPECT_FALSE(daemon_.hear(station_.due_message(0.1)));
    (void)station_.take(Json{{"do", "metar"}, {"text", text}}.dump(), time_s_);
    ASSERT_TRUE(daemon_.hear(station_.due_message(time_s_)));
    EXPECT_NEAR(daemon_.airs.back().wind_horizontal, 12 * 1852.0 / 3600.0, 0.01);
    EXPECT_FLOAT_EQ(daemon_.airs.back().wind_direction, 240.0F);
    EXPECT_NE(daemon_.layer(4), nullptr);
    EXPECT_NEAR(daemon_.layer(1)->base_elevation, 432.0 + 1000 * 0.3048, 0.01);
}

TEST_F(StationTest, ARunwayRangeBecomesAVisibility) {
    ask({{"do", "rvr"}, {"rvr_m", 600}});
    EXPECT_GT(daemon_.airs.back().visibility, 200.0F);
    EXPECT_LT(daemon_.airs.back().visibility, 600.0F);
    EXPECT_NEAR(Json::parse(station_.state_text())["rvr_m"].get<double>(), 600.0, 1.0);
}

TEST_F(StationTest, SaysAgainWhatTheDaemonDoesNotShowAndKeepsTheLinkAlive) {
    const int controls = daemon_.controls;
    EXPECT_EQ(station_.due_message(0.2).size(), 0U);
    EXPECT_TRUE(daemon_.hear(station_.due_message(0.3)));
    EXPECT_EQ(daemon_.controls, controls + 1);
    EXPECT_TRUE(daemon_.airs.empty());
    const Json before = daemon_.status("2026-06-21T12:00:12Z");
    ask({{"do", "preset"}, {"name", "fog"}});
    // The datagram was lost.
    station_.daemon_says(before, 11.5);
    (void)daemon_.hear(station_.due_message(11.6));
    EXPECT_EQ(daemon_.airs.size(), 2U);
    station_.daemon_says(daemon_.status("2026-06-21T12:00:14Z"), 13.5);
    (void)daemon_.hear(station_.due_message(13.6));
    EXPECT_EQ(daemon_.airs.size(), 2U);
}

TEST_F(StationTest, RefusesWithAReason) {
    Json weather = to_json(station_.weather());
    const auto reason = [&](const Json& value) { return refusal({{"do", "weather"}, {"weather", value}}); };
    EXPECT_NE(station_.take("{", 0.0), "");
    EXPECT_NE(station_.take("[1]", 0.0).find("one JSON object"), std::string::npos);
    EXPECT_NE(refusal({{"do", "reposition"}}).find("reposition"), std::string::npos);
    EXPECT_NE(refusal({{"do", "preset"}, {"name", "../x"}}), "");
    EXPECT_NE(refusal({{"do", "clock"}, {"utc", "2026-02-30T00:00:00Z"}}), "");
    EXPECT_NE(refusal({{"do", "clock"}, {"speed", 61}}), "");
    EXPECT_NE(refusal({{"do", "rvr"}, {"rvr_m", "far"}}), "");
    EXPECT_NE(refusal({{"do", "metar"}, {"text", " "}}), "");
    Json bad = weather;
    bad["air"]["visibility_m"] = 1;
    EXPECT_NE(reason(bad).find("air.visibility_m is 1"), std::string::npos);
    bad = weather;
    bad["layers"].push_back({{"type", "cumulus"}, {"base_m", 100}, {"top_m", 90}});
    EXPECT_NE(reason(bad).find("layers[0].top_m is 90"), std::string::npos);
    bad["layers"][0]["type"] = "candyfloss";
    EXPECT_NE(reason(bad).find("candyfloss"), std::string::npos);
    bad["layers"] = std::vector<int>(33);
    EXPECT_NE(reason(bad).find("at most 32"), std::string::npos);
    EXPECT_FALSE(daemon_.hear(station_.due_message(0.1))) << "nothing was asked for";
}

TEST_F(StationTest, WhatIsNoDaemonOfOursIsSilent) {
    const Json good = daemon_.status("2026-06-21T12:00:00.000Z");
    const auto silence = [&](const std::string& member, const Json& value) {
        Json status = good;
        status[Json::json_pointer(member)] = value;
        station_.daemon_says(status, time_s_);
        return Json::parse(station_.status_text(time_s_, {})).at("silence").get<std::string>();
    };
    EXPECT_EQ(silence("/world/utc", good["world"]["utc"]), "");
    EXPECT_EQ(silence("/world/utc", 5), "what answers there is not skyigd");
    EXPECT_EQ(silence("/world/air", "clear"), "what answers there is not skyigd");
    EXPECT_EQ(silence("/world/weather/layers", {1, 2}), "what answers there is not skyigd");
    EXPECT_EQ(silence("/world/ownship", {{"latitude_deg", "north"}}), "what answers there is not skyigd");
    EXPECT_EQ(silence("/channels", {{{"name", 1}}}), "what answers there is not skyigd");
    EXPECT_EQ(silence("/world/utc", good["world"]["utc"]), "");
}

TEST(SavedSettings, OutliveTheProgramAndRefuseWhatIsNotTheirs) {
    const skyig::tests::ScratchDirectory scratch;
    const std::string path = scratch.file("own/presets.json");
    {
        auto saved = SavedSettings::open(path).value();
        EXPECT_EQ(saved.save("low overcast", *preset_setting("cat1")), "");
        EXPECT_NE(saved.save("", {}), "");
        EXPECT_NE(saved.save(std::string(49, 'x'), {}), "");
        EXPECT_NE(saved.forget("nothing"), "");
    }
    const auto again = SavedSettings::open(path);
    ASSERT_TRUE(again);
    ASSERT_EQ(again->all().count("low overcast"), 1U);
    EXPECT_EQ(again->all().at("low overcast").layers, preset_setting("cat1")->layers);
    const auto other = SavedSettings::open(scratch.write("other.json", "{\"version\": 2}"));
    EXPECT_FALSE(other);
    EXPECT_NE(other.error().find("version 1"), std::string::npos);
    const auto strange = SavedSettings::open(scratch.write("strange.json", "{\"version\": \"1\"}"));
    EXPECT_FALSE(strange);
    EXPECT_NE(strange.error().find("strange.json: holds no presets"), std::string::npos);
}

TEST(Almanac, TellsTheDayOfASite) {
    const Json day = Json::parse(
        almanac_text(*server::ephemeris::parse_utc("2026-06-21T19:00:00Z"), {47.4582, 8.5555, 0.0}));
    EXPECT_EQ(day["date"], "2026-06-21");
    EXPECT_EQ(day["sun"].size(), 97U);
    // Solstice: 90 - 47.458 + 23.44 at local noon, near 11:27 UTC.
    EXPECT_NEAR(day["sun"][46].get<double>(), 65.97, 0.1);
    std::string sunset;
    for (const Json& event : day["events"])
        if (event["body"] == "sun" && event["kind"] == "set") sunset = event["utc"];
    // The almanac of Zurich: 21:25 summer time.
    EXPECT_EQ(sunset.substr(0, 15), "2026-06-21T19:2");
}

}  // namespace
}  // namespace skyig::clients::instructor
