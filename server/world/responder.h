// Answers to requests, from the world as it stands.
#pragma once

#include <array>
#include <cstddef>
#include <variant>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/packets_sight.h"
#include "server/world/requests.h"

namespace skyig::server::world {

class World;

using Response = std::variant<protocol::cigi::HatHotResponse, protocol::cigi::HatHotExtendedResponse,
                              protocol::cigi::LosResponse, protocol::cigi::LosExtendedResponse,
                              protocol::cigi::PositionResponse, protocol::cigi::WeatherConditionsResponse,
                              protocol::cigi::AerosolResponse, protocol::cigi::MaritimeSurfaceResponse,
                              protocol::cigi::TerrestrialSurfaceResponse>;

/// The responses to one request, in their order; room for all that one request can bring.
class Responses {
  public:
    /// One sea, one weather, 256 aerosol layers, GroundConditions::kMost conditions.
    static constexpr std::size_t kMost = 2 + 256 + 64;

    void add(const Response& response) noexcept {
        if (count_ < kMost) all_[count_++] = response;
    }
    [[nodiscard]] bool empty() const noexcept { return next_ == count_; }
    /// The first; only while not empty.
    [[nodiscard]] const Response& front() const noexcept { return all_[next_]; }
    void pop() noexcept {
        if (++next_ >= count_) clear();
    }
    void clear() noexcept { next_ = count_ = 0; }

  private:
    std::array<Response, kMost> all_{};
    std::size_t next_ = 0;
    std::size_t count_ = 0;
};

/// Whether the request names something whose place is known: the ownship, another entity that the host has
/// placed, a channel's view, a view group that a channel's view is in.
[[nodiscard]] bool can_answer(const World& world, const protocol::cigi::PositionRequest& request) noexcept;

/// Whether its answer takes a look at all regions: tens of microseconds, not one.
[[nodiscard]] bool searches_regions(const World& world, const Request& request) noexcept;

/// Adds what the world says to the request. Terrain there is none: the height of the ground is that of the
/// sea, which lies sea_at() above the ellipsoid. A HAT/HOT Request for a point outside the heights that are
/// drawn, or on an entity that is not there, is answered as not valid, and so is every request for a line of
/// sight: there is nothing here that could stand in it.
void respond(const World& world, const Request& request, Responses& responses) noexcept;

}  // namespace skyig::server::world
