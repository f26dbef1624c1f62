// What the verbs of skyig are asked to do, as plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/sky.h"

namespace skyig::clients {

/// skyig host: fly a recorded flight at a daemon.
struct HostOptions {
    std::string flight_path;
    /// UTC at the flight's start, ISO 8601; already checked.
    std::string utc;
    double rate_hz = 60.0;
    /// "3.3" or "4.0"
    std::string cigi = "3.3";
    bool big_endian = false;
    std::string to = "127.0.0.1:8004";
    std::string listen = "127.0.0.1:8005";
    /// Where in the flight to begin, seconds of its own clock; its first row if not given.
    std::optional<double> start_s;
    /// How long to fly; to the flight's end if not given.
    std::optional<double> duration_s;
    /// Turns one view by View Control.
    std::optional<double> view_yaw_deg;
    std::uint16_t view_id = 1;
    std::optional<double> visibility_m;
    /// How long to wait for a first answer.
    double wait_s = 10.0;
    bool json = false;
};

/// One moment without a network.
struct StillOptions {
    /// Settings to start from; the built-in ones with one channel if empty. What is given below comes before
    /// them.
    std::string config_path;
    std::optional<double> latitude_deg;
    std::optional<double> longitude_deg;
    std::optional<double> height_m;
    /// ISO 8601, already checked; empty = as the settings say.
    std::string utc;
    std::optional<double> heading_deg;
    std::optional<double> pitch_deg;
    std::optional<double> roll_deg;
    /// Along the heading, for what falls.
    double speed_m_s = 0.0;
    std::optional<double> visibility_m;
    /// Name or path of a preset, or the text of a report, in place of the settings' weather; empty: that.
    std::string weather_preset;
    std::string metar;
    /// That the heights of either count from.
    std::optional<double> elevation_m;
    /// Of the day sky, in place of the settings' one.
    std::optional<config::SkyModel> sky_model;
    /// Test pattern in place of the sky, one of config::kPatternNames; empty: as the settings say.
    std::string pattern;
    /// Of the one channel without settings.
    int width_px = 1280;
    int height_px = 1024;
    double fov_deg = 60.0;
};

/// skyig shot: its picture.
struct ShotOptions {
    StillOptions still;
    std::string out_path;
    std::string luminance_path;  ///< empty: none
    bool json = false;
};

/// skyig plan: what its picture takes.
struct PlanOptions {
    StillOptions still;
    bool json = false;
};

/// skyig channels: what the settings' channels cover.
struct ChannelsOptions {
    std::string config_path;
    bool json = false;
};

/// skyig bench: error and cost of every model of a family; exactly one of family, list and render_folder.
struct BenchOptions {
    std::string family;
    bool list = false;
    /// Turn the JSON files of this folder into pages and plots.
    std::string render_folder;
    /// One folder a topic under it.
    std::string truth_folder = "tests/data";
    int rounds = 101;
    /// Lines of family,model,cost,instructions; empty = none were counted.
    std::string instructions_path;
    /// Only make so many calls of each work, for an instruction counter.
    std::optional<std::uint64_t> counted_calls;
    bool json = false;
};

/// skyig ephem: places of Sun, Moon, planets and stars, for one moment, for a table, or when things happen.
struct EphemOptions {
    /// ISO 8601, already checked; empty = now.
    std::string utc;
    std::optional<double> latitude_deg;
    std::optional<double> longitude_deg;
    double height_m = 0.0;
    std::string model = "series";
    /// Names, already checked; empty = all (for events Sun and Moon).
    std::vector<std::string> bodies;
    /// Names or numbers, already checked.
    std::vector<std::string> stars;
    double pressure_hpa = 1013.25;
    double temperature_c = 15.0;
    /// A table to fill in, in place of a report; "-" = standard input.
    std::string batch_path;
    /// Where the table goes; empty or "-" = standard output.
    std::string out_path;
    /// Its column of times, when it is none of the usual ones.
    std::string time_column;
    /// "2026-06-01..2026-06-30", already checked: what happens, in place of a report.
    std::string events;
    /// Rise and set behind the horizon as the eye sees it from its height, through the air.
    bool eye_horizon = false;
    bool json = false;
};

/// skyig decode: what stands in messages and frames, as text or JSON; one of the sources is asked for.
struct DecodeOptions {
    /// A candump log; "-" = standard input.
    std::string can_path;
    /// CIGI in hexadecimal, a datagram each; none, or "-" alone: lines of standard input.
    std::vector<std::string> cigi;
    /// Messages of the image generator, not of a host.
    bool from_ig = false;
    /// Listen to CIGI here in place of reading text; 0 = a port of the system's choice.
    std::optional<std::uint16_t> live_port;
    /// Stop listening after so many datagrams.
    std::optional<std::uint64_t> count;
    bool json = false;
};

/// skyig metar: weather reports, as text or JSON.
struct MetarOptions {
    /// Reports, or the words of one; none, or "-" alone: lines of standard input.
    std::vector<std::string> reports;
    bool json = false;
    /// Prints what skyig makes of it instead of what it says.
    bool state = false;
    double elevation_m = 0.0;
};

/// skyig replay: a capture's datagrams onto the network.
struct ReplayOptions {
    /// pcapng or pcap; "-" = standard input.
    std::string path;
    /// Already checked.
    std::string to = "127.0.0.1:8004";
    /// Only datagrams that were captured on their way to these; empty = all.
    std::vector<std::uint16_t> ports;
    /// Of the recorded pace; 0 = as fast as it goes.
    double speed = 1.0;
    /// A line of standard input for each frame of a recording with frames, else for each datagram.
    bool step = false;
    bool json = false;
};

/// skyig record: UDP and CAN into a file; one port or bus at least.
struct RecordOptions {
    /// "127.0.0.1:8004", already checked.
    std::vector<std::string> listen;
    /// Addresses that are listened to, already checked.
    std::vector<std::string> from{"127.0.0.1"};
    /// Interfaces.
    std::vector<std::string> can;
    std::string out_path;
    /// Until a signal if not given.
    std::optional<double> duration_s;
    bool json = false;
};

/// skyig status, skyig top: what a running daemon tells of itself.
struct StatusOptions {
    /// Already checked.
    std::string url = "http://127.0.0.1:8006";
    /// Again every so many seconds.
    std::optional<double> watch_s;
    /// Each page takes the place of the one before, where a person watches.
    bool clear_screen = false;
    bool json = false;
    /// Only what it tells of the other machines.
    bool rig = false;
};

/// skyig sky: a table of directions gets the sky's light.
struct SkyOptions {
    /// Of render::kSkyModelNames, already checked; empty = the one that the atmosphere's file names, else
    /// multi.
    std::string model;
    /// Asks the reference solver instead of a model.
    bool truth = false;
    /// "A", "B" or a file.
    std::string atmosphere = "B";
    /// Adds the dark sky's own light, and the Moon's where it is given.
    bool night = false;
    /// Already checked; empty: the dark sky's means. With it latitude and longitude, degrees.
    std::string utc;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    /// Given together.
    std::optional<double> moon_phase_angle_deg;
    std::optional<double> moon_elevation_deg;
    std::optional<double> moon_rel_azimuth_deg;
    /// "-" = standard input.
    std::string cases_path;
    /// Empty or "-" = standard output.
    std::string out_path;
};

/// skyig cloud: light of a slab of cloud, for one case or a table of them.
struct CloudOptions {
    /// Of render::cloud::kSlabModelNames, already checked.
    std::string model = "table";
    /// "-" = standard input; empty = the one case below.
    std::string cases_path;
    /// Empty or "-" = standard output.
    std::string out_path;
    std::optional<double> optical_depth;
    double g = 0.85;
    double albedo = 1.0;
    double sun_zenith_deg = 0.0;
    double view_zenith_deg = 0.0;
    double rel_azimuth_deg = 0.0;
    bool json = false;
};

/// skyig tone: luminances through the shader's tone curve.
struct ToneOptions {
    /// Of render::kToneOperatorNames, already checked.
    std::string tone_operator = "hybrid";
    /// Empty = each luminance is adapted to itself.
    std::optional<double> adaptation_cd_m2;
    double display_max_cd_m2 = 350.0;
    /// Half of full white if not given.
    std::optional<double> display_adaptation_cd_m2;
    double ambient_cd_m2 = 0.0;
    /// The sRGB curve if not given.
    std::optional<double> gamma;
    /// All that a picture does to light, not the operator alone.
    bool picture = false;
    /// >= 0, may be infinite.
    std::vector<double> luminance_cd_m2;
};

/// skyig rvr: one of the first three is given.
struct RvrOptions {
    std::optional<double> visibility_m;
    std::optional<double> extinction_per_m;
    std::optional<double> rvr_m;
    double intensity_cd = 10e3;
    double background_cd_m2 = 10e3;
    double contrast = 0.05;
    bool json = false;
};

/// skyig latency: a host that flips an aircraft's attitude.
struct LatencyOptions {
    std::string to = "127.0.0.1:8004";
    std::string listen = "127.0.0.1:8005";
    double rate_hz = 58.3;
    /// In each scene.
    int flips = 200;
    double settle_s = 3.0;
    double wait_s = 10.0;
    std::optional<double> at_most_frames;
    bool json = false;
};

/// skyig instructor: the web station.
struct InstructorOptions {
    std::string daemon_status = "http://127.0.0.1:8006";
    std::string cigi_to = "127.0.0.1:8010";
    std::string listen = "127.0.0.1:8080";
    /// Asked of every page where it is not empty; needed to listen on another address than loopback.
    std::string token;
    /// Names of a reverse proxy.
    std::vector<std::string> names;
    /// Where own presets are kept; "default": in the user's state folder; empty: in memory alone.
    std::string saved_path = "default";
};

/// Either a verb's options, or text to print and a status to leave with.
struct Invocation {
    std::variant<std::monostate, HostOptions, ShotOptions, PlanOptions, ChannelsOptions, BenchOptions,
                 EphemOptions, CloudOptions, LatencyOptions, DecodeOptions, MetarOptions, ReplayOptions,
                 RecordOptions, SkyOptions, StatusOptions, ToneOptions, RvrOptions, InstructorOptions>
        options;
    int exit_status = 0;
    std::string output;  ///< for stdout (help, version)
    std::string error;   ///< for stderr, one line
};

[[nodiscard]] Invocation read_command_line(int argc, const char* const* argv);

}  // namespace skyig::clients
