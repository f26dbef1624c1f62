#include "server/frame_table.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace skyig::server {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{64} << 10U;

double microseconds(const TimeHistogram& times) noexcept {
    return static_cast<double>(times.last_ns()) * 1e-3;
}

}  // namespace

FrameTable::FrameTable(const std::string& path, const std::vector<config::Channel>& channels)
    : buffer_(kBufferBytes), file_(std::fopen(path.c_str(), "w")) {
    if (!file_) {
        throw std::runtime_error(fmt::format("{}: cannot be made for times: {}", path, std::strerror(errno)));
    }
    std::setvbuf(file_.get(), buffer_.data(), _IOFBF, buffer_.size());
    fmt::print(file_.get(), "frame,utc_ns,slots,late,arrivals,input_us,shared_us");
    for (const config::Channel& channel : channels)
        fmt::print(file_.get(), ",{}_us", channel.name);
    fmt::print(file_.get(), ",frame_us,shown_ns\n");
}

void FrameTable::add(const FrameRow& row, const FrameTimes& times) noexcept {
    std::fprintf(file_.get(), "%ju,%jd,%ju,%d,%ju,%.1f,%.1f", static_cast<std::uintmax_t>(row.number),
                 static_cast<std::intmax_t>(row.utc_ns), static_cast<std::uintmax_t>(row.slots),
                 row.late ? 1 : 0, static_cast<std::uintmax_t>(row.arrivals), microseconds(times.input()),
                 microseconds(times.shared()));
    for (std::size_t i = 0; i < times.channels(); ++i)
        std::fprintf(file_.get(), ",%.1f", microseconds(times.channel(i)));
    std::fprintf(file_.get(), ",%.1f,%jd\n", microseconds(times.frame()),
                 static_cast<std::intmax_t>(row.shown_ns));
}

bool FrameTable::finish() noexcept {
    return std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
}

}  // namespace skyig::server
