// The site's settings as plain values, and the loader that reads them from TOML. A Config that comes out of
// load_config() is complete and inside every stated range; nobody checks it again.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/channel.h"
#include "config/host.h"
#include "config/night.h"
#include "config/overlay.h"
#include "config/pacing.h"
#include "config/rig.h"
#include "config/screen.h"
#include "config/sky.h"
#include "config/source.h"
#include "config/weather.h"
#include "config/window.h"

namespace skyig::config {

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
    /// 0..60; where it blows from, clockwise from true north, -360..360.
    double wind_m_s = 0.0;
    double wind_from_deg = 0.0;
};

enum class Surface { kLand, kSea };

/// What lies below the air. Snow holds until a host says how much lies.
struct Ground {
    Surface surface = Surface::kLand;
    /// Of bare land in daylight, 0..1; not given: grass and soil.
    std::optional<double> albedo;
    double snow_pct = 0.0;
};

/// From cheap to good.
enum class EphemerisModel { kAlmanac, kErfa, kSeries };

struct Ephemeris {
    EphemerisModel model = EphemerisModel::kSeries;
    /// File of UT1 and pole, as a path from where the program runs (the file's is from where the settings
    /// are); empty: none. What it holds is read and checked by who uses it.
    std::string earth_orientation;
};

/// The screen of all channels that have none of their own.
struct Display : Screen {
    bool dither = true;
};

/// How far the picture may be off for the sake of speed.
struct Quality {
    /// Largest error of smooth light, 8-bit display codes, 0.1..8.
    double error_codes = 0.5;
    /// The same as percent of luminance at middle grey, 0.17..13; comes in place of error_codes when given.
    std::optional<double> error_pct;
};

/// "hybrid" (Tumblin-Rushmeier by day, threshold matching by night) and what stands beside it.
enum class ToneOperator { kHybrid, kTumblin, kTumblinSafe, kReinhard, kWard, kLinear };

/// "sky", "view", "view-mean"; "cockpit", "physiological".
enum class AdaptationSource { kSky, kView, kViewMean };
enum class AdaptationPace { kCockpit, kPhysiological };

struct Eye {
    /// Key "operator".
    ToneOperator tone = ToneOperator::kHybrid;
    /// Of hybrid by day, decades, 0..2.
    double highlight_room = 0.45;
    /// Parts of full white, 0.1..1; 1 = none.
    double shoulder = 0.7;
    bool night_colours = true;
    AdaptationSource adapt_to = AdaptationSource::kSky;
    /// 1e-6..1e6: the eye is adapted to this always; not given: to what it sees.
    std::optional<double> adaptation_cd_m2;
    AdaptationPace pace = AdaptationPace::kCockpit;
    /// Time constants of the cockpit's pace to brighter and to darker light, 0..600; 0 = at once.
    double adapt_up_s = 0.5;
    double adapt_down_s = 5.0;
    /// The veil that the eye lays round Sun and Moon.
    bool glare = true;
};

/// "headless": nowhere, or into files by option. "window": on the desktop.
enum class OutputKind { kHeadless, kWindow };

struct Output {
    OutputKind kind = OutputKind::kHeadless;
    /// Windows change their pictures between two refreshes of the first one's monitor, not within one.
    bool vsync = true;
};

/// What comes in is kept.
struct Record {
    /// Where recordings go, as a path from where the program runs (the file's is from where the settings
    /// are); empty: nothing is recorded. kRecordTimeMark in it stands for the time at which one begins.
    std::string file;
};

inline constexpr std::string_view kRecordTimeMark = "{time}";

/// What of the log is written: this and all that is graver.
enum class LogLevel { kError, kWarning, kNotice, kInfo };

struct Logging {
    LogLevel level = LogLevel::kInfo;
};

/// The read-only port that tells how the daemon goes.
struct Status {
    bool enabled = true;
    /// TCP.
    UdpAddress listen{"127.0.0.1", 8006};
    /// The file names the port: the daemon does not run without it. Where it is only the default, a second
    /// daemon on the machine goes without, and so does a replay.
    bool listen_given = false;
};

/// Small pictures of the channels on the status port, made while somebody asks.
struct Preview {
    bool enabled = true;
    /// A second and channel, 0.1..30.
    double rate_hz = 5.0;
    /// 16..4096; wider channels are made smaller by a whole factor.
    int width_px = 640;
    /// 1..100
    int quality = 80;
};

struct Config {
    Daemon daemon;
    Overload overload;
    Host host;
    /// At most kMaxSources.
    std::vector<Source> sources;
    Start start;
    Air air;
    Ground ground;
    Sky sky;
    Night night;
    Weather weather;
    Ephemeris ephemeris;
    Display display;
    Quality quality;
    Eye eye;
    /// Of all channels that have none of their own.
    Overlay overlay;
    Output output;
    /// At most kMaxWindows; with OutputKind::kWindow one at least.
    std::vector<Window> windows;
    Record record;
    Logging log;
    Status status;
    Preview preview;
    /// Not given: one machine draws all channels.
    std::optional<Rig> rig;
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

class KeyLog;

/// Reads and checks a file; all its errors come at once. Does not throw on anything that a file may hold.
/// \param keys  is told every key that is asked for (config/key_log.h); null: nobody wants to know
[[nodiscard]] LoadResult load_config(const std::string& path, KeyLog* keys = nullptr);

/// The same from text; `file_name` only names it in errors.
[[nodiscard]] LoadResult parse_config(std::string_view text, const std::string& file_name,
                                      KeyLog* keys = nullptr);

/// Everything at its default and one channel "centre", 1280x1024, 60 degrees wide.
[[nodiscard]] Config default_config();

/// All channels start with this one of kPatternNames; another name changes nothing.
void show_pattern(Config& config, std::string_view pattern) noexcept;

/// "site.toml:12:9: display.gamma: ..."
[[nodiscard]] std::string to_text(const ConfigError& error);

/// One line for `--check`: "ok: 3 channels, CIGI 3.3+4.0 on udp 127.0.0.1:8004, headless, status on
/// http://...".
[[nodiscard]] std::string describe(const Config& config);

}  // namespace skyig::config
