#include "clients/instructor/station.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clients/skyig/metar/json.h"
#include "clients/skyig/metar/page.h"
#include "config/presets.h"
#include "protocol/metar/decode.h"
#include "render/fog/rvr.h"
#include "server/start_weather/metar_weather.h"

namespace skyig::clients::instructor {

namespace ephemeris = server::ephemeris;
using Json = nlohmann::ordered_json;

namespace {

/// Runway lights before a bright day, as skyig rvr takes them.
constexpr double kLights_cd = 10e3;
constexpr double kDay_cd_m2 = 10e3;

std::string told(std::string_view type, std::string_view text) {
    return Json{{"type", type}, {"text", text}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string refused(std::string_view text) {
    return told("refused", text);
}

std::string text_of(const Json& message, const char* key) {
    const auto found = message.find(key);
    return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Json range_json(const config::Air& air) {
    const double extinction = -std::log(air.visibility_contrast) / air.visibility_m;
    return render::fog::runway_visual_range(extinction, kLights_cd, kDay_cd_m2, air.visibility_contrast)
        .range_m;
}

}  // namespace

Station::Station(SavedSettings saved) : saved_(std::move(saved)) {}

std::string Station::take(std::string_view message, double time_s) {
    const Json json = Json::parse(message, nullptr, false);
    if (!json.is_object()) return refused("a message is one JSON object");
    try {
        return obey(json, time_s);
    } catch (const Json::exception& error) {
        // A member of another type than every page sends.
        return refused(error.what());
    }
}

std::string Station::obey(const Json& message, double time_s) {
    const std::string verb = text_of(message, "do");
    if (verb == "weather") return set_weather(message);
    if (verb == "preset") return set_preset(message);
    if (verb == "recall") return set_saved(message);
    if (verb == "decode") return read_metar(message, false);
    if (verb == "metar") return read_metar(message, true);
    if (verb == "rvr") return set_range(message);
    if (verb == "clock") return set_clock(message, time_s);
    if (verb == "undo") return go_back(undo_, redo_);
    if (verb == "redo") return go_back(redo_, undo_);
    if (verb == "save" || verb == "forget") {
        const std::string name = text_of(message, "name");
        const std::string fault = verb == "save" ? saved_.save(name, now_.weather) : saved_.forget(name);
        if (!fault.empty()) return refused(fault);
        ++revision_;
        return {};
    }
    return refused(fmt::format("\"do\" is \"{}\"; nothing here is called so", verb));
}

void Station::remember(std::string what, const Json& message, Part part) {
    const std::string gesture = text_of(message, "gesture");
    redo_.clear();
    if (!gesture.empty() && !undo_.empty() && undo_.back().gesture == gesture) return;
    if (undo_.size() == kMostSteps) undo_.erase(undo_.begin());
    undo_.push_back({std::move(what), gesture, part, now_});
}

void Station::put_weather(Setting setting, std::string preset) {
    now_.weather = std::move(setting);
    now_.preset = std::move(preset);
    weather_asked_ = true;
    weather_changed_ = true;
    ++revision_;
}

std::string Station::set_weather(const Json& message) {
    const auto setting = setting_from_json(message.value("weather", Json()));
    if (!setting) return refused(setting.error());
    const std::string what = text_of(message, "what");
    remember(what.empty() ? "weather" : what.substr(0, 80), message);
    put_weather(*setting, {});
    return {};
}

std::string Station::set_preset(const Json& message) {
    const std::string name = text_of(message, "name");
    auto setting = preset_setting(name);
    if (!setting) return refused(fmt::format("there is no preset \"{}\"", name));
    remember(fmt::format("preset {}", name), message);
    put_weather(std::move(*setting), name);
    return {};
}

std::string Station::set_saved(const Json& message) {
    const std::string name = text_of(message, "name");
    const auto found = saved_.all().find(name);
    if (found == saved_.all().end()) return refused(fmt::format("there is no preset \"{}\"", name));
    remember(fmt::format("own preset {}", name), message);
    put_weather(found->second, {});
    return {};
}

/// \param apply  else it is only told what the report says
std::string Station::read_metar(const Json& message, bool apply) {
    const std::string text = text_of(message, "text");
    std::string_view rest = text;
    const auto one = protocol::metar::next_report(rest);
    if (!one) return refused("there is no report to read");
    const protocol::metar::Report report = protocol::metar::decode(*one);
    if (apply) {
        server::MetarWeather made = server::metar_weather(report, now_.weather.air);
        Setting setting{made.air, std::move(made.layers), 0.0};
        number_layers(setting);
        remember(fmt::format("report of {}", report.station), message);
        put_weather(std::move(setting), {});
    }
    const Json json{{"type", "metar"},
                    {"page", metar::to_text(report)},
                    {"problems", metar::problems_text(report)},
                    {"applied", apply}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Station::set_range(const Json& message) {
    const Json range = message.value("rvr_m", Json());
    const double range_m = range.is_number() ? range.get<double>() : 0.0;
    if (!(range_m >= 10.0 && range_m <= 10'000.0)) return refused("rvr_m must be a number, 10..10000");
    Setting setting = now_.weather;
    const double contrast = setting.air.visibility_contrast;
    const double extinction = render::fog::extinction_for_range(range_m, kLights_cd, kDay_cd_m2, contrast);
    setting.air.visibility_m = std::clamp(-std::log(contrast) / extinction, 10.0, 400'000.0);
    remember(fmt::format("RVR {:.0f} m", range_m), message);
    put_weather(std::move(setting), {});
    return {};
}

std::string Station::set_clock(const Json& message, double time_s) {
    ClockSetting clock = now_.clock;
    clock.utc = clock.now(time_s);
    clock.at_s = time_s;
    std::string what = "clock";
    if (message.contains("utc")) {
        const auto utc = ephemeris::parse_utc(text_of(message, "utc"));
        const int year = utc ? utc->civil().year : 0;
        if (year < 1900 || year > 2100) return refused("utc must be a time such as 2026-06-21T19:30:00Z");
        clock.utc = *utc;
        what = fmt::format("time {}", ephemeris::to_iso(*utc));
    }
    if (message.contains("running")) {
        if (!message["running"].is_boolean()) return refused("running must be true or false");
        clock.running = message["running"].get<bool>();
        what = message.contains("utc") ? what : clock.running ? "clock runs" : "clock stands";
    }
    if (message.contains("speed")) {
        const double speed = message["speed"].is_number() ? message["speed"].get<double>() : 0.0;
        if (!(speed >= 1.0 && speed <= kFastest))
            return refused(fmt::format("speed must be a number, 1..{}", kFastest));
        clock.speed = speed;
        what = fmt::format("speed {}", speed);
    }
    remember(what, message, Part::kClock);
    now_.clock = clock;
    clock_asked_ = clock_changed_ = true;
    ++revision_;
    return {};
}

std::string Station::go_back(std::vector<Step>& from, std::vector<Step>& to) {
    if (from.empty()) return refused("there is nothing to take back");
    Step step = std::move(from.back());
    from.pop_back();
    if (step.part == Part::kClock) {
        std::swap(step.before.clock, now_.clock);
        clock_asked_ = clock_changed_ = true;
    } else {
        std::swap(step.before.weather, now_.weather);
        std::swap(step.before.preset, now_.preset);
        weather_asked_ = weather_changed_ = true;
    }
    step.gesture.clear();
    to.push_back(std::move(step));
    ++revision_;
    return {};
}

const Json& Station::world() const {
    return status_.at("world");
}

void Station::daemon_says(Json status, double time_s) {
    if (!status.is_object() || !status.contains("world") || !status["world"].is_object()) {
        daemon_is_silent("what answers there is not skyigd");
        return;
    }
    status_ = std::move(status);
    silence_.clear();
    heard_s_ = time_s;
    try {
        adopt(time_s);
        // Whatever is asked of it later is asked here first.
        (void)weather_shown();
        (void)clock_shown(time_s);
        (void)channel_names();
        const Json place = world().value("ownship", Json::object());
        (void)(place.value("latitude_deg", 0.0) + place.value("longitude_deg", 0.0));
    } catch (const Json::exception&) {
        status_ = Json::object();
        daemon_is_silent("what answers there is not skyigd");
    }
}

void Station::daemon_is_silent(std::string reason) {
    silence_ = std::move(reason);
}

/// What nobody has asked for is as the daemon shows it.
void Station::adopt(double time_s) {
    if (!clock_asked_) {
        const auto utc = ephemeris::parse_utc(world().value("utc", std::string()));
        const bool running = world().value("clock_running", true);
        if (utc) {
            const double off_s = ephemeris::seconds_between(now_.clock.now(time_s), *utc);
            if (running != now_.clock.running || std::abs(off_s) > 1.0) ++revision_;
            now_.clock = {*utc, time_s, running, 1.0};
        }
    }
    if (!weather_asked_ && !is_shown(now_.weather, world())) {
        now_.weather = setting_from_status(world());
        number_layers(now_.weather);
        now_.preset.clear();
        ++revision_;
    }
}

bool Station::weather_shown() const {
    return silence_.empty() && is_shown(now_.weather, world());
}

bool Station::clock_shown(double time_s) const {
    if (!silence_.empty()) return false;
    const auto utc = ephemeris::parse_utc(world().value("utc", std::string()));
    if (!utc || world().value("clock_running", true) != now_.clock.running) return false;
    // Of when it was heard; a snapshot may be some tenths of a second old.
    const double off_s = ephemeris::seconds_between(now_.clock.now(std::min(heard_s_, time_s)), *utc);
    return std::abs(off_s) <= 1.0 + now_.clock.speed;
}

bool Station::weather_is_due(double time_s) const {
    constexpr double kAgain_s = 1.0;
    if (weather_changed_) return true;
    return weather_asked_ && heard_s_ > weather_sent_s_ && time_s - weather_sent_s_ >= kAgain_s &&
           silence_.empty() && !weather_shown();
}

bool Station::clock_is_due(double time_s) const {
    constexpr double kAgain_s = 1.0;
    if (clock_changed_) return true;
    if (!clock_asked_) return false;
    const double repeat_s = now_.clock.repeat_s();
    if (repeat_s > 0.0 && time_s - clock_sent_s_ >= repeat_s) return true;
    return heard_s_ > clock_sent_s_ && time_s - clock_sent_s_ >= kAgain_s && silence_.empty() &&
           !clock_shown(time_s);
}

std::string Station::state_text() const {
    Json saved = Json::array();
    for (const auto& [name, setting] : saved_.all())
        saved.push_back(name);
    const Json state{
        {"type", "state"},
        {"weather", to_json(now_.weather)},
        {"preset", now_.preset},
        {"rvr_m", range_json(now_.weather.air)},
        {"clock", {{"running", now_.clock.running}, {"speed", now_.clock.speed}, {"asked", clock_asked_}}},
        {"undo", undo_.empty() ? Json(nullptr) : Json(undo_.back().what)},
        {"redo", redo_.empty() ? Json(nullptr) : Json(redo_.back().what)},
        {"saved", saved}};
    return state.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> Station::channel_names() const {
    std::vector<std::string> names;
    const auto channels = status_.find("channels");
    if (channels == status_.end() || !channels->is_array()) return names;
    for (const Json& channel : *channels)
        if (channel.is_object()) names.push_back(channel.value("name", ""));
    return names;
}

std::string Station::status_text(double time_s, const Json& port) const {
    Json json{{"type", "status"},
              {"silence", silence_},
              {"utc", ephemeris::to_iso(now_.clock.now(time_s), 1)},
              {"clock_shown", !clock_asked_ || clock_shown(time_s)},
              {"weather_shown", !weather_asked_ || weather_shown()},
              {"said_again", said_again_},
              {"port", port}};
    for (const char* key : {"version", "renderer", "rate_hz", "frames", "late_frames", "recent", "times",
                            "host", "health", "uptime_s", "world", "sources", "authority", "plan"}) {
        if (const auto found = status_.find(key); found != status_.end()) json[key] = *found;
    }
    json["channels"] = channel_names();
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Station::greeting_text() {
    Json json{{"type", "hello"},
              {"presets", Json::array()},
              {"layer_types", config::kLayerTypeNames},
              {"fastest", kFastest}};
    for (const std::string_view name : config::kPresetNames)
        json["presets"].push_back({{"name", name}, {"title", preset_title(name)}});
    return json.dump();
}

}  // namespace skyig::clients::instructor
