#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "config/document.h"

namespace skyig::config {

std::optional<std::string> read_settings_text(const std::string& path, ConfigError& error) {
    constexpr std::size_t kMaxFileBytes = std::size_t{256} << 10U;
    const auto failed = [&](std::string message) {
        error = {path, 0, 0, {}, std::move(message)};
        return std::nullopt;
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) return failed(fmt::format("cannot be opened: {}", std::strerror(errno)));
    std::string text(kMaxFileBytes + 1, '\0');
    const std::size_t size = std::fread(text.data(), 1, text.size(), file.get());
    if (std::ferror(file.get()) != 0) return failed(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (size > kMaxFileBytes) return failed("is larger than 256 KiB: this is no configuration");
    text.resize(size);
    return text;
}

}  // namespace skyig::config
