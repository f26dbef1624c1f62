// The entries of a ZIP archive in memory; nothing is ever unpacked to disk.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "config/warp/bytes.h"

namespace skyig::config::warp {

class Archive {
  public:
    static constexpr int kMostEntries = 1024;
    static constexpr std::size_t kMostEntryBytes = std::size_t{128} << 20U;
    /// Of an entry of more than 1 MiB, unpacked by packed.
    static constexpr std::size_t kMostRatio = 200;

    /// Refuses archives with too many entries, one that unpacks to too much, and one whose name leads out of
    /// the archive (absolute, "..", backslashes, control characters).
    [[nodiscard]] static FileRead<Archive> open(Bytes bytes);

    /// \return "entry NAME: what is wrong" if it is not there, is damaged or longer than it says
    [[nodiscard]] FileRead<Bytes> read(const std::string& entry) const;

  private:
    struct Handle;
    struct Close {
        void operator()(Handle* handle) const noexcept;
    };
    explicit Archive(std::unique_ptr<Handle, Close> handle);

    std::unique_ptr<Handle, Close> handle_;
};

}  // namespace skyig::config::warp
