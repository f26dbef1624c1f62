// How far the wind has carried each layer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace skyig::server::weather {

/// How far the wind has carried something since scene time 0: exact while the wind holds, without a jump
/// when it changes.
class Drift {
  public:
    /// East and north, metres.
    [[nodiscard]] glm::dvec2 at(double time_s) const noexcept {
        return offset_m_ + wind_m_s_ * (time_s - since_s_);
    }
    /// The first wind has blown since scene time 0.
    void set_wind(const glm::dvec2& wind_m_s, double time_s) noexcept {
        if (blows_ && wind_m_s == wind_m_s_) return;
        if (blows_) {
            offset_m_ = at(time_s);
            since_s_ = time_s;
        }
        wind_m_s_ = wind_m_s;
        blows_ = true;
    }

  private:
    glm::dvec2 offset_m_{0.0};
    glm::dvec2 wind_m_s_{0.0};
    double since_s_ = 0.0;
    bool blows_ = false;
};

/// What carries a layer.
struct Carrier {
    /// Towards east and north, if the layer has one of its own.
    std::optional<glm::dvec2> own_wind_m_s;
    /// Else this times the wind of the air.
    double air_gain = 1.0;

    friend bool operator==(const Carrier&, const Carrier&) = default;
};

/// One for all layers, whether they are shown or not. A layer that always had one carrier is at its own wind
/// times scene time, or at its gain times the way of the air, however often it comes and goes: this depends
/// on the air's history of winds alone. Where the carrier of a place changes the layer goes on from where it
/// is, and that offset is kept while the place has no layer, up to kMost places. Allocates at construction
/// only.
class Drifts {
  public:
    static constexpr std::size_t kMost = 512;

    Drifts() { places_.reserve(kMost); }

    /// As at the start: the next wind has blown since scene time 0.
    void forget() noexcept;
    /// Once a frame, before carry() and at().
    void set_air(const glm::dvec2& wind_m_s, double time_s) noexcept;
    /// Tells what carries the layer of a place (LayerKey::place) from this frame on.
    void carry(std::uint32_t place, const Carrier& carrier) noexcept;
    /// In this frame, east and north, metres; 0 for a place without a carrier.
    [[nodiscard]] glm::dvec2 at(std::uint32_t place) const noexcept;

  private:
    struct Place {
        std::uint32_t place = 0;
        Carrier carrier;
        glm::dvec2 offset_m{0.0};
        /// When it was last told.
        double told_s = 0.0;
    };
    [[nodiscard]] glm::dvec2 way_of(const Carrier& carrier) const noexcept;
    [[nodiscard]] glm::dvec2 now_at(const Place& place) const noexcept {
        return place.offset_m + way_of(place.carrier);
    }

    Drift air_;
    double time_s_ = 0.0;
    /// By place.
    std::vector<Place> places_;
};

}  // namespace skyig::server::weather
