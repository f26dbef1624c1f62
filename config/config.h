// The site's settings as plain values, and the loader that reads them from TOML. A Config that comes out of
// load_config() is complete and inside every stated range; nobody checks it again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyig::config {

inline constexpr std::size_t kMaxChannels = 16;
/// All channels of one daemon share one eye point; views further apart than this need a daemon of their own.
inline constexpr double kMaxEyeSpread_m = 50.0;
/// Furthest offset of an eye point from what carries it, each axis.
inline constexpr double kMaxOffset_m = 1000.0;
/// Largest half angle of a frustum side, either sign.
inline constexpr double kMaxHalfAngle_deg = 87.5;
inline constexpr int kMaxChannelSize_px = 16384;

/// CIGI protocol version as written: {3, 3} or {4, 0}.
struct CigiVersion {
    int major = 3;
    int minor = 3;

    friend bool operator==(const CigiVersion&, const CigiVersion&) = default;
};

/// Dotted-quad IPv4 address and UDP port.
struct UdpAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;

    friend bool operator==(const UdpAddress&, const UdpAddress&) = default;
};

/// UTC, proleptic Gregorian, years 1900..2100, second 0..<60.
struct UtcDateTime {
    int year = 2026;
    int month = 6;
    int day = 21;
    int hour = 12;
    int minute = 0;
    double second = 0.0;

    friend bool operator==(const UtcDateTime&, const UtcDateTime&) = default;
};

struct Daemon {
    /// Frames a second, 1..240.
    double rate_hz = 60.0;
};

/// "accept": any database number the host asks for counts as loaded; "none": 0 is reported always.
enum class DatabasePolicy { kAccept, kNone };

struct Host {
    UdpAddress listen{"127.0.0.1", 8004};
    /// Where answers go; empty ("sender" in the file): to the last valid sender.
    std::optional<UdpAddress> reply_to = UdpAddress{"127.0.0.1", 8005};
    /// Dotted-quad addresses whose datagrams are read, at least one.
    std::vector<std::string> allow{"127.0.0.1"};
    /// Announced in Start of Frame until a host speaks; then the host's own version is used.
    CigiVersion cigi;
    DatabasePolicy database = DatabasePolicy::kAccept;
    /// A host silent for so long is said to be lost, 0.1..3600.
    double lost_after_s = 1.0;
};

/// The world at start-up, and again each time the host puts the image generator into Standby.
struct Start {
    /// Empty ("now" in the file): the system's UTC.
    std::optional<UtcDateTime> utc;
    /// Whether the clock runs by itself.
    bool running = true;
    double latitude_deg = 47.4582;
    double longitude_deg = 8.5555;
    /// Above the WGS84 ellipsoid, -500..100000.
    double height_m = 1000.0;
    /// Clockwise from true north; nose up; right wing down.
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
};

/// The air at start-up and after Standby, at sea level.
struct Air {
    /// Meteorological optical range, 10..400000.
    double visibility_m = 80000.0;
    /// Contrast that is left over at that range: 0.05 (METAR, ICAO) or 0.02 (Koschmieder); 0.01..0.1.
    double visibility_contrast = 0.05;
    /// -90..60
    double temperature_c = 15.0;
    /// 800..1100
    double pressure_hpa = 1013.25;
    double humidity_pct = 50.0;
};

/// What shines at start-up and after Standby.
struct Sky {
    bool sun = true;
    bool moon = true;
    bool stars = true;
    double star_intensity_pct = 100.0;
};

struct Display {
    /// Luminance of full white on the screen, 1..10000.
    double max_luminance_cd_m2 = 350.0;
    /// What the eyes in front of the screen are adapted to; if not given, half of full white.
    double adaptation_cd_m2 = 175.0;
    /// Exponent of the display's response; empty ("srgb" in the file): the sRGB curve. 1..3.
    std::optional<double> gamma;
    bool dither = true;
};

/// "hybrid" (Tumblin-Rushmeier by day, threshold matching by night), "linear" (measurements).
enum class ToneOperator { kHybrid, kLinear };

struct Eye {
    /// Key "operator".
    ToneOperator tone = ToneOperator::kHybrid;
    /// Time constants of adaptation to brighter and to darker light, 0..600; 0 = at once.
    double adapt_up_s = 0.5;
    double adapt_down_s = 5.0;
};

/// "headless": nowhere, or into files by option.
enum class OutputKind { kHeadless };

struct Output {
    OutputKind kind = OutputKind::kHeadless;
};

struct Channel {
    /// 1..32 of letters, digits, '-' and '_', unique: it becomes part of file names.
    std::string name;
    int width_px = 1280;
    int height_px = 1024;
    /// Signed half angles from the view axis to each side: left < right, bottom < top; left and bottom
    /// normally negative; each within +-kMaxHalfAngle_deg.
    double left_deg = -30.0;
    double right_deg = 30.0;
    double bottom_deg = -24.79;
    double top_deg = 24.79;
    /// Turn of the view axis from the body axes: yaw right, then pitch up, then roll right.
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    /// Eye point from the ownship's reference point, body axes: forward, right, down; each within +-kMaxOffset_m.
    std::array<double, 3> offset_m{0.0, 0.0, 0.0};
    /// How the host's View Control and View Definition address it; unique. If not given: its place in the
    /// file, from 1.
    int view_id = 1;
    /// 0 = in no group, 1..255.
    int group_id = 0;
};

struct Config {
    Daemon daemon;
    Host host;
    Start start;
    Air air;
    Sky sky;
    Display display;
    Eye eye;
    Output output;
    /// 1..kMaxChannels
    std::vector<Channel> channels;
};

/// One thing that is wrong: where (1-based; 0 = the file as a whole), in which key and what would be right.
struct ConfigError {
    std::string file;
    int line = 0;
    int column = 0;
    /// Dotted path as a person would write it: "display.gamma", "channel[2].yaw_deg"; empty for the file as a
    /// whole.
    std::string key;
    std::string message;
};

/// Either a complete Config or every error of the file.
struct LoadResult {
    std::optional<Config> config;
    std::vector<ConfigError> errors;

    explicit operator bool() const noexcept { return config.has_value(); }
};

/// Reads and checks a file; all its errors come at once. Does not throw on anything that a file may hold.
[[nodiscard]] LoadResult load_config(const std::string& path);

/// The same from text; `file_name` only names it in errors.
[[nodiscard]] LoadResult parse_config(std::string_view text, const std::string& file_name);

/// Everything at its default and one channel "centre", 1280x1024, 60 degrees wide.
[[nodiscard]] Config default_config();

/// "site.toml:12:9: display.gamma: ..."
[[nodiscard]] std::string to_text(const ConfigError& error);

/// One line for `--check`: "ok: 3 channels, CIGI 3.3+4.0 on udp 127.0.0.1:8004, headless".
[[nodiscard]] std::string describe(const Config& config);

}  // namespace skyig::config
