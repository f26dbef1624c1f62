#include "server/weather/drifts.h"

#include <algorithm>

namespace skyig::server::weather {
namespace {

constexpr auto kBefore = [](const auto& a, std::uint32_t place) { return a.place < place; };

}  // namespace

void Drifts::forget() noexcept {
    air_ = {};
    places_.clear();
}

void Drifts::set_air(const glm::dvec2& wind_m_s, double time_s) noexcept {
    air_.set_wind(wind_m_s, time_s);
    time_s_ = time_s;
}

void Drifts::carry(std::uint32_t place, const Carrier& carrier) noexcept {
    auto found = std::lower_bound(places_.begin(), places_.end(), place, kBefore);
    if (found != places_.end() && found->place == place) {
        if (found->carrier != carrier) found->offset_m = now_at(*found) - way_of(carrier);
        found->carrier = carrier;
        found->told_s = time_s_;
        return;
    }
    if (places_.size() == kMost) {
        places_.erase(std::min_element(places_.begin(), places_.end(),
                                       [](const Place& a, const Place& b) { return a.told_s < b.told_s; }));
        found = std::lower_bound(places_.begin(), places_.end(), place, kBefore);
    }
    places_.insert(found, {place, carrier, glm::dvec2{0.0}, time_s_});
}

glm::dvec2 Drifts::at(std::uint32_t place) const noexcept {
    const auto found = std::lower_bound(places_.begin(), places_.end(), place, kBefore);
    return found != places_.end() && found->place == place ? now_at(*found) : glm::dvec2{0.0};
}

glm::dvec2 Drifts::way_of(const Carrier& carrier) const noexcept {
    return carrier.own_wind_m_s ? *carrier.own_wind_m_s * time_s_ : carrier.air_gain * air_.at(time_s_);
}

}  // namespace skyig::server::weather
