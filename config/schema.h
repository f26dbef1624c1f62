// Which tables and keys a configuration has, with their ranges: the one home of that knowledge.
#pragma once

#include "config/config.h"
#include "config/table_reader.h"

namespace skyig::config {

/// Reads a whole document; whatever is wrong goes to `errors` and leaves its default in the result.
[[nodiscard]] Config read_config(const Table& root, ErrorList& errors);

/// Reads [host] and the [[source]] tables and checks them against one another.
void read_host(TableReader& table, Host& host);
void read_sources(TableReader& root, ErrorList& errors, const Host& host, std::vector<Source>& sources);

/// Reads [status].
void read_status(TableReader& table, Status& status);

/// Reads [rig] with its machines, and which of them draws a [[channel]]; a window is one machine's.
void read_rig(TableReader& root, ErrorList& errors, std::optional<Rig>& rig);
void read_channel_node(TableReader& table, const std::optional<Rig>& rig, Channel& channel);
void check_windows_of_nodes(ErrorList& errors, const Config& config, const Place& place);

/// Reads [daemon], [overload].
void read_daemon(TableReader& table, Daemon& daemon);
void read_overload(TableReader table, Overload& overload);
/// Checks [daemon] against what it paces by, all being read.
void check_pacing(TableReader& daemon, const Config& config);

/// Refuses a layout of another version.
void read_version(TableReader& root);

/// Reads [air], [ground], [sky] with its tables.
void read_air(TableReader table, Air& air);
void read_ground(TableReader table, Ground& ground);
void read_sky(TableReader table, Sky& sky);

/// Reads [night] with its cities.
void read_night(TableReader table, ErrorList& errors, Night& night);

/// Reads a [[weather.sheet]] with its textures, whose images are meant from where the settings stand.
void read_weather_sheet(TableReader& table, ErrorList& errors, WeatherSheet& sheet);

/// Reads [weather], whose preset stands in `weather` already, and its keyframes.
void read_weather(TableReader table, ErrorList& errors, Weather& weather);
void read_keyframes(TableReader table, Keyframes& keyframes);

/// Reads what [display] and [channel.display] have in common; what is left out stays. Full white that is
/// given brings an adaptation of half of it.
void read_screen(TableReader& table, Screen& screen);

/// Reads [display], [eye].
void read_display(TableReader table, Display& display);
void read_eye(TableReader table, Eye& eye);

/// Reads the frustum of a [[channel]] and where it looks, its size and eye being read.
void read_frustum(TableReader& table, Channel& channel);

/// A path in the settings is meant from where they stand.
[[nodiscard]] std::string beside(const std::string& settings_file, const std::string& path);

/// The keys of a frustum exist, but nothing is read.
void know_frustum(TableReader& table);
/// Refuses what gives a frustum and where it looks, since `beside` does. \return whether there is nothing
bool refuse_frustum(TableReader& table, std::string_view beside);

/// Reads size and projection of a [[channel]], its eye being read: size and frustum, or [channel.mpcdi], and
/// [channel.warp] and [channel.blend] with their files, whose paths are meant from where the settings stand.
void read_projection(TableReader& table, const std::string& settings_file, Channel& channel);

/// Reads the [[window]] tables, and where in one a [[channel]] is shown.
void read_windows(TableReader& root, ErrorList& errors, std::vector<Window>& windows);
void read_viewport(TableReader& table, ErrorList& errors, const std::vector<Window>& windows,
                   Channel& channel);
/// Gives every channel a window where the settings want windows and tell of none. Every channel needs a place
/// where they tell of some.
void place_channels(ErrorList& errors, Config& config);

/// Reads what [overlay] and [channel.overlay] hold; what is left out stays.
void read_overlay(TableReader& table, Overlay& overlay);

/// Reads the [[channel]] tables into `config`, whose [display], [overlay] and windows are read, and checks
/// them against one another.
void read_channels(TableReader& root, ErrorList& errors, Config& config);

/// 1..32 of letters, digits, '-' and '_': fit for a part of a file's name.
[[nodiscard]] bool is_short_name(std::string_view text) noexcept;

/// "127.0.0.1:8004"; the port may be 0.
[[nodiscard]] bool parse_udp_address(std::string_view text, UdpAddress& out);

/// "127.0.0.1": four decimal numbers 0..255 without leading zeros.
[[nodiscard]] bool is_ipv4(std::string_view text) noexcept;

/// "2026-06-21T19:30:00Z", seconds optional; false if it has another shape or is no date of years 1900..2100.
[[nodiscard]] bool parse_utc(std::string_view text, UtcDateTime& out) noexcept;
[[nodiscard]] bool is_valid(const UtcDateTime& time) noexcept;

}  // namespace skyig::config
