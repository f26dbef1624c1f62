// The state of the world between the decoder and the scene: what the host has said, kept until it says
// otherwise, and moved on in time. No clock, no socket, no picture in here.
#pragma once

#include <optional>
#include <vector>

#include "config/config.h"
#include "protocol/cigi/message.h"
#include "protocol/cigi/session.h"
#include "protocol/transport/endpoint.h"
#include "server/ephemeris/time.h"
#include "server/log.h"
#include "server/start_weather/start_weather.h"
#include "server/world/authority.h"
#include "server/world/entities.h"
#include "server/world/outbox.h"
#include "server/world/reports.h"
#include "server/world/state.h"
#include "server/world/surface_store.h"
#include "server/world/utc_clock.h"
#include "server/world/views.h"
#include "server/world/weather_store.h"

namespace skyig::server::world {

/// Give it each datagram as begin_message(source, from) and then the decoded packets, IG Control first: a
/// World is a handler for protocol::cigi::decode_host_message(). Then advance() once a frame.
///
/// Authority: each source obeys the first address whose IG Control is valid, until it is lost; what it says
/// is taken where the settings give it the say (Authority). The mode is that of the source in control; the IG
/// Control of any other source only opens its messages. Without a source that may control, all is obeyed.
/// Persistence: nothing times out. A lost source's world stands as it was and its clock runs on.
/// Standby: only the mode of IG Control is obeyed. Entering it brings back the configured world.
/// Steady state allocates nothing. Not for several threads.
class World {
  public:
    /// \param start_utc  the instant that `config.start.utc` means: that one, or the system's if it says
    /// "now". Both references must outlive the world.
    World(const config::Config& config, const ephemeris::UtcClockTime& start_utc, Log& log);

    /// The packets that follow come in one message of that source (0: the host) from there.
    void begin_message(std::size_t source, const protocol::transport::Endpoint& from) noexcept;

    void operator()(const protocol::cigi::IgControl& packet, const protocol::cigi::PacketInfo& info);
    void operator()(const protocol::cigi::EntityControl& packet, const protocol::cigi::PacketInfo& info);
    void operator()(const protocol::cigi::EntityPosition& packet);
    void operator()(const protocol::cigi::ConformalClamped& packet);
    void operator()(const protocol::cigi::RateControl& packet);
    void operator()(const protocol::cigi::AccelerationControl& packet);
    void operator()(const protocol::cigi::EarthModelDefinition& packet);
    void operator()(const protocol::cigi::CelestialSphereControl& packet);
    void operator()(const protocol::cigi::AtmosphereControl& packet);
    void operator()(const protocol::cigi::WeatherControl& packet);
    void operator()(const protocol::cigi::EnvRegionControl& packet);
    void operator()(const protocol::cigi::ViewControl& packet);
    void operator()(const protocol::cigi::ViewDefinition& packet);
    void operator()(const protocol::cigi::MaritimeSurfaceControl& packet);
    void operator()(const protocol::cigi::TerrestrialSurfaceControl& packet);
    void operator()(const protocol::cigi::WaveControl& packet);
    void operator()(const protocol::cigi::ComponentControl& packet);
    void operator()(const protocol::cigi::ShortComponentControl& packet);
    /// Requests of the host in control are kept until outbox() is emptied.
    void operator()(const protocol::cigi::HatHotRequest& packet);
    void operator()(const protocol::cigi::LosSegmentRequest& packet);
    void operator()(const protocol::cigi::LosVectorRequest& packet);
    void operator()(const protocol::cigi::PositionRequest& packet);
    void operator()(const protocol::cigi::EnvConditionsRequest& packet);

    /// A source that speaks no CIGI lives, and what it says. Taken where the source has the say, unless a
    /// living host keeps the world in Standby.
    void heard(std::size_t source);
    void report(std::size_t source, const OwnshipReport& report);
    void report(std::size_t source, const AirReport& report);
    void report(std::size_t source, const protocol::cigi::WeatherControl& layer);
    void report_time(std::size_t source, const ephemeris::UtcClockTime& utc, double rate);

    /// The settings have changed: sources' rights hold from now on, start air and weather from the next
    /// Standby, or now where nobody has the say about weather. Allocates.
    void take_settings();

    /// Moves time on by `step_s` >= 0: clock, link supervision.
    void advance(double step_s);

    /// It is this time here, whatever the steps so far: that of another image generator, whose frame bore
    /// that number.
    void stand_at(const ephemeris::UtcClockTime& utc, double time_s, std::uint32_t ig_frame_number) noexcept;

    /// From here on the ownship is where it will be so much later than the frame begins, as far as its motion
    /// is known; 0 at first. For the time that a frame takes until it is seen.
    void look_ahead(double ahead_s) noexcept { ahead_s_ = ahead_s; }

    /// Whether the current message came from the host in control (known after its IG Control).
    [[nodiscard]] bool from_obeyed_host() const noexcept {
        return verdict_ != Verdict::kNoControl && verdict_ != Verdict::kOtherHost &&
               authority_.holder(config::Aspect::kControl) == source_;
    }

    [[nodiscard]] protocol::cigi::IgMode mode() const noexcept { return session_.mode(); }
    /// The controlling host's side of the link, fed with its messages only: makes each frame's Start of
    /// Frame.
    [[nodiscard]] protocol::cigi::Session& session() noexcept { return session_; }
    [[nodiscard]] const protocol::cigi::Session& session() const noexcept { return session_; }
    [[nodiscard]] Link link(std::size_t source = 0) const noexcept;
    /// The source in control, or was last; the host's before the first.
    [[nodiscard]] std::size_t control_source() const noexcept {
        return authority_.holder(config::Aspect::kControl).value_or(0);
    }
    [[nodiscard]] Link control_link() const noexcept { return link(control_source()); }
    [[nodiscard]] const Authority& authority() const noexcept { return authority_; }
    [[nodiscard]] const Ownship& ownship() const noexcept { return ownship_; }
    /// Where an entity stands that is there and active, the ownship (0) too; nothing for any other.
    [[nodiscard]] std::optional<Pose> entity_pose(std::uint16_t entity_id) const noexcept;
    /// Null for the ownship, and for what is not there.
    [[nodiscard]] const Entity* entity(std::uint16_t entity_id) const noexcept {
        return entities_.find(entity_id);
    }
    [[nodiscard]] const EarthModel& earth() const noexcept { return earth_; }
    [[nodiscard]] const UtcClock& clock() const noexcept { return clock_; }
    [[nodiscard]] const CelestialSwitches& celestial() const noexcept { return celestial_; }
    [[nodiscard]] const AirState& air() const noexcept { return air_; }
    [[nodiscard]] const Views& views() const noexcept { return views_; }
    [[nodiscard]] const WeatherStore& weather() const noexcept { return weather_; }
    /// How often Standby has brought back the configured world.
    [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }
    [[nodiscard]] const SurfaceStore& surfaces() const noexcept { return surfaces_; }
    [[nodiscard]] const Counters& counters() const noexcept { return counters_; }
    /// What is to be said to the host in control.
    [[nodiscard]] Outbox& outbox() noexcept { return outbox_; }
    [[nodiscard]] const Outbox& outbox() const noexcept { return outbox_; }

    /// Scene time, seconds since start: the sum of all steps, and of the steps of the UTC clock by more than
    /// kClockJump_s when somebody set it. It runs while the UTC clock is frozen.
    [[nodiscard]] double time_s() const noexcept { return time_s_; }

    static constexpr double kClockJump_s = 2.0;

  private:
    enum class Verdict : std::uint8_t { kNoControl, kObeyed, kOtherHost, kStandby, kLate };

    /// Who speaks for a source.
    struct Peer {
        protocol::transport::Endpoint endpoint;
        StampClock stamps;
        /// Its IG Control lets motion go on between messages.
        bool smoothing = false;
        bool second_host_said = false;
    };

    /// Whether what the current message says about `aspect` counts; if not, says so in the counters.
    [[nodiscard]] bool obeys(config::Aspect aspect) noexcept;
    /// The same for what only the host in control may ask, even where nobody else claims control.
    [[nodiscard]] bool may_ask() noexcept;
    template <class Packet>
    void take_request(const Packet& packet);
    template <class Packet>
    void take_surface(const Packet& packet) noexcept;
    /// \return false when there is no such component
    [[nodiscard]] bool switch_sky(const protocol::cigi::ComponentControl& packet) noexcept;
    [[nodiscard]] bool switch_weather(const protocol::cigi::ComponentControl& packet) noexcept;
    [[nodiscard]] bool switch_pattern(const protocol::cigi::ComponentControl& packet) noexcept;
    void raise(Event event, std::uint32_t data_1, std::uint32_t data_2) noexcept;
    /// False if another host of the same source has it.
    [[nodiscard]] bool claim_peer(const protocol::cigi::PacketInfo& info);
    void say_second_host();
    void take_control(const protocol::cigi::IgControl& packet, const protocol::cigi::PacketInfo& info);
    /// No mode keeps anything out: the world is in Operate or nobody may say.
    [[nodiscard]] bool in_operation() const noexcept;
    void note_events(const protocol::cigi::SessionEvents& events);
    void reset();
    void set_start_weather() noexcept;
    void supervise(double step_s);
    /// \return whether it stands there now
    bool place_ownship(bool attached, const Pose& pose);
    bool place_entity(Entity& entity, bool attached, std::uint16_t parent_id, const Pose& pose);
    /// From here on the entity belongs to the source that speaks.
    void take_entity(Entity& entity) noexcept;
    /// Of the sea, within the heights that are drawn.
    [[nodiscard]] double sea_height_m(const ephemeris::Geodetic& position) const noexcept;
    /// What follows the surface stands on the sea.
    [[nodiscard]] Pose on_the_sea(const protocol::cigi::ConformalClamped& packet) const noexcept;
    /// The entity of a packet that places or makes it; null, and counted, when there is no room for another.
    [[nodiscard]] Entity* claim_entity(std::uint16_t entity_id);
    /// The ownship's track belongs to the current source from here on.
    void take_track(std::size_t source) noexcept;
    /// Told rates carry on while both smoothing bits of the source's last messages say so.
    void note_smoothing(std::size_t source, bool smoothing) noexcept;
    void carry_ownship() noexcept;
    void carry(Entity& entity) noexcept;
    /// Calls `tell(track, stamp)` for what moves by the packet's rates; counts what is refused.
    template <class Packet, class Tell>
    void tell_rates(const Packet& packet, Tell&& tell);
    /// False, and counted, for a place that cannot be drawn.
    [[nodiscard]] bool is_drawn(const ephemeris::Geodetic& position, std::uint16_t entity_id = 0);
    [[nodiscard]] bool listens(std::size_t source, config::Aspect aspect) noexcept;
    /// Layers and regions, brought within what can be drawn.
    void keep_weather(const protocol::cigi::WeatherControl& told);
    void keep_weather(const protocol::cigi::EnvRegionControl& told);
    template <class Weather>
    void keep_limited(Weather told);
    void note_view(ViewResult result, std::uint16_t view_id);
    void note_clock_step(const ephemeris::UtcClockTime& before);

    const config::Config& config_;
    Log& log_;

    Authority authority_;
    std::vector<Peer> peers_;
    std::size_t source_ = 0;
    protocol::transport::Endpoint from_;
    Verdict verdict_ = Verdict::kNoControl;

    protocol::cigi::Session session_;
    /// Whose frame numbers the session follows.
    std::optional<std::size_t> session_source_;
    /// What the clock comes back to in Standby: the configured instant, or the system's clock as it goes on.
    ephemeris::UtcClockTime default_utc_;
    UtcClock clock_;
    Ownship ownship_;
    Mover own_;
    EntityStore entities_;
    /// Whose reports the track is made of.
    std::optional<std::size_t> track_source_;
    /// The sender's time of the current message, if its positions may be carried on.
    std::optional<double> stamp_s_;
    EarthModel earth_;
    CelestialSwitches celestial_;
    StartWeather start_weather_;
    AirState air_;
    Views views_;
    WeatherStore weather_;
    SurfaceStore surfaces_;
    Outbox outbox_;
    Counters counters_;
    std::uint64_t resets_ = 0;
    double time_s_ = 0.0;
    /// The sum of all steps alone.
    double elapsed_s_ = 0.0;
    /// The instant that is drawn: what comes after it comes at elapsed_s_.
    double drawn_s_ = 0.0;
    double ahead_s_ = 0.0;
};

}  // namespace skyig::server::world
