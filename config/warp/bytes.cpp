#include "config/warp/bytes.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace skyig::config::warp {

FileRead<Bytes> read_bytes(const std::string& path) {
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) return {std::nullopt, fmt::format("cannot be read: {}", std::strerror(errno))};
    Bytes bytes;
    constexpr std::size_t kStep = std::size_t{1} << 18U;
    while (true) {
        const std::size_t held = bytes.size();
        bytes.resize(held + kStep);
        const std::size_t got = std::fread(bytes.data() + held, 1, kStep, file.get());
        bytes.resize(held + got);
        if (bytes.size() > kMostFileBytes)
            return {std::nullopt, fmt::format("is larger than {} MiB", kMostFileBytes >> 20U)};
        if (got < kStep) break;
    }
    if (std::ferror(file.get()) != 0)
        return {std::nullopt, fmt::format("cannot be read: {}", std::strerror(errno))};
    return {std::move(bytes), {}};
}

}  // namespace skyig::config::warp
