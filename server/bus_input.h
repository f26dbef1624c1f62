// A CANaerospace bus on its way into the world: single values put together to places, attitudes, weather.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "config/config.h"
#include "protocol/can_frame.h"
#include "protocol/canaerospace/receiver.h"
#include "server/world/world.h"

namespace skyig::server {

/// The settings' identifiers and conventions. Names are those of `skyig decode`, words joined by underscores:
/// "gps_latitude". \throws std::runtime_error with one line for a name that does not exist or an identifier
/// that cannot be used
[[nodiscard]] protocol::canaerospace::IdentifierMap identifier_map(const config::Source& source);

/// What identifier_map() has against any of the sources, one line; empty if nothing.
[[nodiscard]] std::string identifier_fault(const config::Config& config);

/// A place is reported when its latitude and longitude have both come anew, an attitude when all three angles
/// have: at the receive time of the last, so that no picture mixes old and new. Of several sources of one
/// value the best that is not stale is taken: place INS, GPS, auxiliary; height of the same source, else
/// true, baro-corrected, standard altitude; heading true, else the heading angle, else magnetic with
/// variation. Allocates at construction only.
class BusInput {
  public:
    BusInput(std::size_t source, const protocol::canaerospace::IdentifierMap& map, world::World& world);

    void take(const protocol::CanFrame& frame);

    [[nodiscard]] const protocol::canaerospace::Receiver& receiver() const noexcept { return receiver_; }

  private:
    using Parameter = protocol::canaerospace::Parameter;

    struct Kept {
        double value = 0.0;
        std::int64_t received_ns = 0;
        bool is_new = false;
        bool known = false;
    };

    void keep(const protocol::canaerospace::Update& update);
    [[nodiscard]] std::optional<double> fresh(Parameter parameter, std::int64_t now_ns) const;
    [[nodiscard]] bool take_new(std::initializer_list<Parameter> parameters);
    void report_place(std::int64_t now_ns);
    void report_velocity(std::int64_t now_ns);
    void report_attitude(std::int64_t now_ns);
    [[nodiscard]] std::optional<double> true_heading_deg(std::int64_t now_ns, Parameter& taken) const;
    [[nodiscard]] std::optional<double> height_m(Parameter of_source, std::int64_t now_ns) const;
    void report_time(std::int64_t now_ns);
    void report_air();
    void report_layers();

    std::size_t source_;
    world::World& world_;
    protocol::canaerospace::Receiver receiver_;
    std::array<Kept, protocol::canaerospace::kParameters> kept_{};
    /// Layers that were reported as drawn: they are switched off when they go.
    std::array<bool, protocol::canaerospace::kCloudLayers> shown_{};
};

}  // namespace skyig::server
