// What the instructor asks for against what the daemon shows: messages of pages in, CIGI messages and texts
// for pages out. No socket, no clock: time is the caller's, seconds of a steady clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/instructor/clock_setting.h"
#include "clients/instructor/saved_settings.h"
#include "clients/instructor/setting.h"

namespace skyig::clients::instructor {

/// All pages show one state, and the daemon is its truth: until something is asked for, the state is what the
/// daemon shows; afterwards it is what was asked, said again each second while the daemon shows something
/// else (a lost datagram, a daemon that began anew, a host that went into Standby).
class Station {
  public:
    explicit Station(SavedSettings saved);

    /// A page's message: one JSON object with a member "do". \return what that page alone is told, empty:
    /// nothing
    [[nodiscard]] std::string take(std::string_view message, double time_s);

    /// The daemon's /status, or nothing while it does not answer, with the reason.
    void daemon_says(nlohmann::ordered_json status, double time_s);
    void daemon_is_silent(std::string reason);

    /// The CIGI message that is due, else empty; valid until the next call. IG Control alone keeps the link
    /// alive.
    [[nodiscard]] std::span<const std::byte> due_message(double time_s);

    /// Grows with each change of state_text().
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
    /// Everything that pages edit: weather, clock, undo, own presets.
    [[nodiscard]] std::string state_text() const;
    /// What the daemon says of itself, with what became of the wishes.
    [[nodiscard]] std::string status_text(double time_s, const nlohmann::ordered_json& port) const;
    /// What does not change: presets and their titles, types of layers.
    [[nodiscard]] static std::string greeting_text();

    [[nodiscard]] const Setting& weather() const noexcept { return now_.weather; }
    [[nodiscard]] const nlohmann::ordered_json& status() const noexcept { return status_; }
    /// As the daemon's status names them.
    [[nodiscard]] std::vector<std::string> channel_names() const;

  private:
    using Json = nlohmann::ordered_json;

    struct Wishes {
        Setting weather;
        /// By name, while the weather is as it came from there.
        std::string preset;
        ClockSetting clock;
    };
    enum class Part : std::uint8_t { kWeather, kClock };
    struct Step {
        std::string what;
        /// Changes of one drag are one step.
        std::string gesture;
        /// Only that part is taken back.
        Part part = Part::kWeather;
        Wishes before;
    };
    static constexpr std::size_t kMostSteps = 100;

    [[nodiscard]] std::string obey(const Json& message, double time_s);
    [[nodiscard]] std::string set_weather(const Json& message);
    [[nodiscard]] std::string set_preset(const Json& message);
    [[nodiscard]] std::string set_saved(const Json& message);
    [[nodiscard]] std::string read_metar(const Json& message, bool apply);
    [[nodiscard]] std::string set_range(const Json& message);
    [[nodiscard]] std::string set_clock(const Json& message, double time_s);
    [[nodiscard]] std::string go_back(std::vector<Step>& from, std::vector<Step>& to);
    void remember(std::string what, const Json& message, Part part = Part::kWeather);
    void put_weather(Setting setting, std::string preset);
    void adopt(double time_s);
    [[nodiscard]] bool weather_shown() const;
    [[nodiscard]] bool clock_shown(double time_s) const;
    [[nodiscard]] const Json& world() const;
    [[nodiscard]] bool weather_is_due(double time_s) const;
    [[nodiscard]] bool clock_is_due(double time_s) const;

    SavedSettings saved_;
    Json status_;
    std::string silence_ = "nothing has been heard of it yet";
    /// When status_ came.
    double heard_s_ = 0.0;
    Wishes now_;
    bool weather_asked_ = false;
    bool clock_asked_ = false;
    std::vector<Step> undo_;
    std::vector<Step> redo_;
    std::uint64_t revision_ = 1;

    std::array<std::byte, 8192> buffer_{};
    std::uint32_t frame_number_ = 0;
    double sent_s_ = -1e9;
    double weather_sent_s_ = -1e9;
    double clock_sent_s_ = -1e9;
    bool weather_changed_ = false;
    bool clock_changed_ = false;
    std::uint64_t said_again_ = 0;
};

}  // namespace skyig::clients::instructor
