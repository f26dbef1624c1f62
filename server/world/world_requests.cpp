// What a host asks of the world and switches in it: requests, components, sea and ground.
#include "server/world/world.h"

namespace skyig::server::world {

namespace cigi = protocol::cigi;

namespace {

/// Components of class 11, celestial sphere.
constexpr std::uint16_t kSun = 0;
constexpr std::uint16_t kMoon = 1;
constexpr std::uint16_t kStars = 2;
constexpr std::uint16_t kClock = 3;
/// Of classes 1 and 2, view and view group: the test pattern, whose number is the state.
constexpr std::uint16_t kTestPattern = 0;
/// Of class 6, regional layered weather: the region, and the layer that data word 1 tells.
constexpr std::uint16_t kRegion = 0;
constexpr std::uint16_t kRegionLayer = 1;

/// Whose word counts: a component is part of what an aspect holds.
std::optional<config::Aspect> aspect_of(cigi::ComponentClass component_class) noexcept {
    switch (component_class) {
        case cigi::ComponentClass::kView:
        case cigi::ComponentClass::kViewGroup:
            return config::Aspect::kViews;
        case cigi::ComponentClass::kRegionalLayeredWeather:
        case cigi::ComponentClass::kGlobalLayeredWeather:
        case cigi::ComponentClass::kAtmosphere:
            return config::Aspect::kWeather;
        case cigi::ComponentClass::kCelestialSphere:
            return config::Aspect::kTime;
        default:
            return std::nullopt;
    }
}

const char* name_of(const cigi::HatHotRequest& /*request*/) noexcept {
    return "HAT/HOT";
}
const char* name_of(const cigi::LosSegmentRequest& /*request*/) noexcept {
    return "line of sight segment";
}
const char* name_of(const cigi::LosVectorRequest& /*request*/) noexcept {
    return "line of sight vector";
}
const char* name_of(const cigi::PositionRequest& /*request*/) noexcept {
    return "position";
}
const char* name_of(const cigi::EnvConditionsRequest& /*request*/) noexcept {
    return "environmental conditions";
}

}  // namespace

void World::raise(Event event, std::uint32_t data_1, std::uint32_t data_2) noexcept {
    if (!outbox_.events.raise(event, data_1, data_2)) ++counters_.event_lost;
}

bool World::may_ask() noexcept {
    if (verdict_ == Verdict::kObeyed && !from_obeyed_host()) {
        ++counters_.not_in_charge;
        return false;
    }
    return obeys(config::Aspect::kControl);
}

template <class Packet>
void World::take_request(const Packet& packet) {
    if (outbox_.requests.ask(packet)) return;
    ++counters_.request_full;
    log_.limited("requests left out", kRepeatAfter_s, Severity::kWarning,
                 "{} request left out: more wait than can be answered", name_of(packet));
    outbox_.messages.add(Matter::kRequestIgnored, "{} request left out: too many wait", name_of(packet));
}

void World::operator()(const cigi::HatHotRequest& packet) {
    if (may_ask()) take_request(packet);
}

void World::operator()(const cigi::LosSegmentRequest& packet) {
    if (may_ask()) take_request(packet);
}

void World::operator()(const cigi::LosVectorRequest& packet) {
    if (may_ask()) take_request(packet);
}

void World::operator()(const cigi::EnvConditionsRequest& packet) {
    if (may_ask()) take_request(packet);
}

void World::operator()(const cigi::PositionRequest& packet) {
    if (!may_ask()) return;
    if (can_answer(*this, packet)) {
        take_request(packet);
        return;
    }
    ++counters_.request_unknown;
    outbox_.messages.add(Matter::kRequestIgnored, "position of class {}, id {}: not known here",
                         packet.object_class, packet.object_id);
}

template <class Packet>
void World::take_surface(const Packet& packet) noexcept {
    if (!obeys(config::Aspect::kWeather)) return;
    if (packet.scope == cigi::WeatherScope::kEntity) {
        ++counters_.surface_entity;
    } else if (!surfaces_.set(packet)) {
        ++counters_.surface_full;
    }
}

void World::operator()(const cigi::MaritimeSurfaceControl& packet) {
    take_surface(packet);
}

void World::operator()(const cigi::WaveControl& packet) {
    take_surface(packet);
}

void World::operator()(const cigi::TerrestrialSurfaceControl& packet) {
    take_surface(packet);
}

bool World::switch_sky(const cigi::ComponentControl& packet) noexcept {
    const bool on = packet.component_state == 1;
    switch (packet.component_id) {
        case kSun:
            celestial_.sun = on;
            return true;
        case kMoon:
            celestial_.moon = on;
            return true;
        case kStars:
            celestial_.stars = on;
            return true;
        case kClock:
            clock_.run(on);
            return true;
        default:
            return false;
    }
}

bool World::switch_weather(const cigi::ComponentControl& packet) noexcept {
    const bool on = packet.component_state == 1;
    if (packet.component_class == cigi::ComponentClass::kAtmosphere) {
        if (packet.component_id != 0) return false;
        air_.model_enabled = on;
        return true;
    }
    if (packet.component_class == cigi::ComponentClass::kGlobalLayeredWeather) {
        return packet.component_id == 0 && packet.instance_id <= 255 &&
               weather_.enable_layer(cigi::WeatherScope::kGlobal, 0,
                                     static_cast<std::uint8_t>(packet.instance_id), on);
    }
    if (packet.component_id == kRegion) return weather_.enable_region(packet.instance_id, on);
    return packet.component_id == kRegionLayer && packet.data_1 <= 255 &&
           weather_.enable_layer(cigi::WeatherScope::kRegional, packet.instance_id,
                                 static_cast<std::uint8_t>(packet.data_1), on);
}

bool World::switch_pattern(const cigi::ComponentControl& packet) noexcept {
    if (packet.component_id != kTestPattern || packet.component_state >= config::kPatternNames.size())
        return false;
    const auto pattern = static_cast<config::Pattern>(packet.component_state);
    if (packet.component_class == cigi::ComponentClass::kView)
        return views_.show_pattern(packet.instance_id, pattern);
    return packet.instance_id <= 255 &&
           views_.show_pattern_in_group(static_cast<std::uint8_t>(packet.instance_id), pattern);
}

void World::operator()(const cigi::ComponentControl& packet) {
    const std::optional<config::Aspect> aspect = aspect_of(packet.component_class);
    if (aspect ? !obeys(*aspect) : !may_ask()) return;
    bool known = packet.component_state <= 1;
    if (aspect == config::Aspect::kViews) {
        known = switch_pattern(packet);
    } else if (known && aspect == config::Aspect::kWeather) {
        known = switch_weather(packet);
    } else if (known && aspect == config::Aspect::kTime) {
        known = switch_sky(packet);
    } else if (known) {
        known = packet.component_class == cigi::ComponentClass::kEvent && packet.component_id == 0 &&
                outbox_.events.enable(packet.instance_id, packet.component_state == 1);
    }
    if (known) return;
    ++counters_.component_unknown;
    const auto component_class = static_cast<unsigned>(packet.component_class);
    log_.limited("component unknown", kRepeatAfter_s, Severity::kWarning,
                 "component {} of class {}, instance {}, state {} ignored: not in the component table",
                 packet.component_id, component_class, packet.instance_id, packet.component_state);
    outbox_.messages.add(Matter::kPacketIgnored, "component {} of class {}, instance {}, state {}: unknown",
                         packet.component_id, component_class, packet.instance_id, packet.component_state);
}

void World::operator()(const cigi::ShortComponentControl& packet) {
    cigi::ComponentControl component;
    component.component_id = packet.component_id;
    component.instance_id = packet.instance_id;
    component.component_class = packet.component_class;
    component.component_state = packet.component_state;
    component.data_1 = packet.data_1;
    component.data_2 = packet.data_2;
    (*this)(component);
}

}  // namespace skyig::server::world
