// One number for all settings that the machines of a rig must share.
#pragma once

#include <cstdint>
#include <string>

#include "config/key_log.h"

namespace skyig::server::rig {

/// Of all values that hold, given or not, and of the bytes of every file that a value names; without what is
/// a machine's own: where it listens and answers, what it records and logs, its status and preview, its
/// windows, and of the rig all but who may lead. \param keys  of the reading \param settings_file  beside
/// which files are meant
[[nodiscard]] std::uint64_t fingerprint(const config::KeyLog& keys, const std::string& settings_file);

}  // namespace skyig::server::rig
