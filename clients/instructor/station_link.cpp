// The station's CIGI messages.
#include <algorithm>

#include "clients/instructor/station.h"
#include "clients/skyig/host_messages.h"

namespace skyig::clients::instructor {

namespace cigi = protocol::cigi;

namespace {

/// A source is said to be lost after 1 s by default.
constexpr double kAlive_s = 0.25;

}  // namespace

std::span<const std::byte> Station::due_message(double time_s) {
    const bool weather = weather_is_due(time_s);
    const bool clock = clock_is_due(time_s);
    if (!weather && !clock && time_s - sent_s_ < kAlive_s) return {};
    cigi::MessageWriter writer(buffer_, cigi::Version::k40, cigi::kNativeOrder);
    cigi::IgControl control;
    // Mode, database and frame numbers are those of who is in control: never this source.
    control.ig_mode = cigi::IgMode::kOperate;
    control.host_frame_number = ++frame_number_;
    bool room = writer.add(control);
    sent_s_ = time_s;
    if (clock) {
        if (!clock_changed_ && now_.clock.repeat_s() <= 0.0) ++said_again_;
        cigi::CelestialSphereControl sky = celestial_setting(now_.clock.now(time_s));
        sky.ephemeris_enable = now_.clock.running;
        room = writer.add(sky) && room;
        clock_changed_ = false;
        clock_sent_s_ = time_s;
    }
    if (weather) {
        if (!weather_changed_) ++said_again_;
        const nlohmann::ordered_json nothing = nlohmann::ordered_json::object();
        const nlohmann::ordered_json& world = status_.contains("world") ? status_["world"] : nothing;
        // At most 32 layers to set and 32 to switch off, 72 bytes each: they fit.
        room = add_packets(writer, now_.weather, elevation_of(world), world) && room;
        weather_changed_ = false;
        weather_sent_s_ = time_s;
    }
    return room ? writer.bytes() : std::span<const std::byte>();
}

}  // namespace skyig::clients::instructor
