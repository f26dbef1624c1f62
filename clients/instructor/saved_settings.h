// An instructor's own presets in a file.
#pragma once

#include <map>
#include <string>

#include "clients/instructor/setting.h"

namespace skyig::clients::instructor {

class SavedSettings {
  public:
    static constexpr std::size_t kMost = 64;
    static constexpr std::size_t kLongestName_bytes = 48;

    /// Reads the file where there is one. \param path  empty: they are kept in memory alone
    /// The error names the file and what is wrong with it.
    [[nodiscard]] static protocol::Result<SavedSettings, std::string> open(const std::string& path);

    [[nodiscard]] const std::map<std::string, Setting>& all() const noexcept { return settings_; }
    /// \return what went wrong in one line, and then nothing has changed; empty: it is kept
    [[nodiscard]] std::string save(const std::string& name, const Setting& setting);
    [[nodiscard]] std::string forget(const std::string& name);

  private:
    [[nodiscard]] std::string write(const std::map<std::string, Setting>& settings) const;

    std::string path_;
    std::map<std::string, Setting> settings_;
};

}  // namespace skyig::clients::instructor
