#include "clients/skyig/latency/latency_host.h"

#include "server/world/events.h"

namespace skyig::clients {

namespace cigi = protocol::cigi;
using server::world::Event;

std::span<const LatencyScene> latency_scenes() noexcept {
    static constexpr std::array<LatencyScene, 3> kScenes{
        {{"day", 12, false}, {"night", 0, false}, {"cloud", 12, true}}};
    return kScenes;
}

LatencyHost::LatencyHost(int settle_frames, int flips)
    : settle_frames_(settle_frames), flips_(flips), figures_(latency_scenes().size()) {}

void LatencyHost::answered(const cigi::StartOfFrame& start_of_frame) noexcept {
    last_ig_frame_number_ = start_of_frame.ig_frame_number;
    if (start_of_frame.ig_mode == cigi::IgMode::kStandby && start_of_frame.last_host_frame_number != 0)
        heard_in_standby_ = true;
    operating_ = heard_in_standby_ && start_of_frame.ig_mode == cigi::IgMode::kOperate;
}

void LatencyHost::told(const cigi::EventNotification& event) noexcept {
    if (event.event_id != static_cast<std::uint16_t>(Event::kFrameFinished) || done()) return;
    if (!flipped_ || event.data_1 != *flipped_) return;
    constexpr std::int64_t kMicrosecond_ns = 1000;
    figures_[scene_].last_channel.add(kMicrosecond_ns * event.data_2);
    figures_[scene_].first_channel.add(kMicrosecond_ns * event.data_3);
    flipped_.reset();
}

bool LatencyHost::step() noexcept {
    LatencyFigures& figures = figures_[scene_];
    if (++frames_in_scene_ <= settle_frames_ || --until_flip_ > 0) return false;
    if (flipped_) ++figures.untold;
    flipped_.reset();
    if (figures.flips == static_cast<std::uint64_t>(flips_)) {
        ++scene_;
        frames_in_scene_ = 0;
        return false;
    }
    constexpr int kFewest = 7;
    constexpr int kMost = 12;
    until_flip_ = std::uniform_int_distribution<int>(kFewest, kMost)(random_);
    ++figures.flips;
    turned_ = !turned_;
    flipped_ = frame_number_;
    return true;
}

std::span<const std::byte> LatencyHost::next() noexcept {
    ++frame_number_;
    cigi::MessageWriter writer(buffer_, cigi::Version::k33, cigi::kNativeOrder);
    cigi::IgControl control;
    control.minor_version = 3;
    control.ig_mode = heard_in_standby_ ? cigi::IgMode::kOperate : cigi::IgMode::kStandby;
    control.host_frame_number = frame_number_;
    control.last_ig_frame_number = last_ig_frame_number_;
    // Everything below fits the buffer.
    (void)writer.add(control);
    if (!operating_ || done()) return writer.bytes();
    const bool begins = frames_in_scene_ == 0;
    (void)step();
    if (done()) return writer.bytes();
    if (begins) add_scene(writer);
    add_ownship(writer);
    return writer.bytes();
}

void LatencyHost::add_scene(cigi::MessageWriter& writer) const noexcept {
    const LatencyScene& scene = latency_scenes()[scene_];
    cigi::CelestialSphereControl sky;
    sky.hour = static_cast<std::uint8_t>(scene.hour_utc);
    sky.ephemeris_enable = sky.sun_enable = sky.moon_enable = sky.star_enable = sky.date_time_valid = true;
    sky.date = cigi::make_date({2026, 6, 21});
    sky.star_intensity = 100.0F;
    (void)writer.add(sky);
    cigi::WeatherControl layer;
    layer.layer_id = 1;
    layer.weather_enable = scene.clouds;
    layer.cloud_type = cigi::CloudType::kCumulus;
    layer.coverage = 75.0F;
    layer.base_elevation = 1000.0F;
    layer.thickness = 1000.0F;
    layer.transition_band = 50.0F;
    layer.visibility = 100.0F;
    layer.air_temperature = 10.0F;
    layer.pressure = 900.0F;
    (void)writer.add(layer);
    cigi::ComponentControl ask;
    ask.component_class = cigi::ComponentClass::kEvent;
    ask.instance_id = static_cast<std::uint16_t>(Event::kFrameFinished);
    ask.component_state = 1;
    (void)writer.add(ask);
}

void LatencyHost::add_ownship(cigi::MessageWriter& writer) const noexcept {
    cigi::EntityControl ownship;
    ownship.entity_state = cigi::EntityState::kActive;
    ownship.lat_x = 40.0;
    ownship.alt_z = 600.0;
    // As a control's step gives it within some tenths of a second.
    ownship.yaw = turned_ ? 1.0F : 0.0F;
    ownship.pitch = turned_ ? 2.0F : 0.0F;
    ownship.roll = turned_ ? 5.0F : 0.0F;
    (void)writer.add(ownship);
}

}  // namespace skyig::clients
