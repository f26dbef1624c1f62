// Settings that change while the daemon runs: the file is read anew on a thread of its own, compared with
// what holds, and taken between two frames. What only a start can change stays, and is said.
#pragma once

#include <functional>
#include <future>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/key_log.h"
#include "server/log.h"

namespace skyig::server {

/// What is other in new settings than in those that hold.
struct SettingsChange {
    /// "air.visibility_m", those that can be taken while frames go on.
    std::vector<std::string> live;
    /// "site.toml:12:9: channel[1].yaw_deg: is taken at the next start only", one a key, or one a table that
    /// is new or gone.
    std::vector<std::string> at_start;
};

/// Air, layers, areas, preset and report of the weather; rights of host and sources; quality; the log's
/// level.
[[nodiscard]] bool is_live(const std::string& key_path);

/// \param start  keys of the start, \param held  of the settings that were taken last
[[nodiscard]] SettingsChange compare_settings(const config::KeyLog& start, const config::KeyLog& held,
                                              const config::KeyLog& now, const std::string& file);

class LiveSettings {
  public:
    enum class Result { kNone, kTaken, kRefused };
    /// Called between two frames with what held before; config() holds the new by then.
    using Take = std::function<void(const config::Config& before)>;

    LiveSettings(std::string path, const config::Config& start, const config::KeyLog& keys);

    /// What holds. Of what can change live, the last that was taken; all else as at the start.
    [[nodiscard]] const config::Config& config() const noexcept { return config_; }
    /// Begins to read the file, unless that goes on already: then once more after it.
    void read_anew();
    /// Takes what has been read, if anything has; never waits. A file with a mistake is refused whole.
    Result take(const Take& take, Log& log);

  private:
    struct Read {
        config::LoadResult loaded;
        config::KeyLog keys;
        /// In a line; empty: nothing is wrong.
        std::string fault;
    };

    [[nodiscard]] static Read read(const std::string& path);

    std::string path_;
    config::Config config_;
    config::KeyLog start_keys_;
    config::KeyLog held_keys_;
    std::future<Read> reading_;
    bool again_ = false;
};

}  // namespace skyig::server
