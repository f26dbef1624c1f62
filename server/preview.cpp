#include "server/preview.h"

#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace skyig::server {
namespace {

constexpr double kNsPerS = 1e9;

std::size_t bytes_of(const render::Channel& channel) noexcept {
    return static_cast<std::size_t>(channel.width_px) * static_cast<std::size_t>(channel.height_px) * 4;
}

}  // namespace

Preview::Preview(std::vector<render::Channel> channels, const Settings& settings, Encode encode)
    : channels_(std::move(channels)), settings_(settings), encode_(std::move(encode)) {
    for (std::size_t i = 0; i < channels_.size(); ++i)
        slots_.push_back(std::make_unique<Slot>());
    thread_ = std::thread([this] { run(); });
}

Preview::~Preview() {
    {
        const std::scoped_lock lock(mutex_);
        stopping_ = true;
    }
    filled_.notify_all();
    thread_.join();
}

void Preview::offer(std::int64_t now_ns, const ReadBack& read_back) {
    const auto interval_ns = static_cast<std::int64_t>(kNsPerS / settings_.rate_hz);
    const std::size_t most = (slots_.size() + 3) / 4;
    std::size_t taken = 0;
    for (std::size_t tried = 0; tried < slots_.size() && taken < most; ++tried) {
        const std::size_t i = (next_ + tried) % slots_.size();
        Slot& slot = *slots_[i];
        if (channels_[i].elsewhere) continue;
        if (now_ns - slot.asked_ns.load(std::memory_order_relaxed) > kAskedFor_ns) continue;
        if (slot.taken_ns != 0 && now_ns - slot.taken_ns < interval_ns) continue;
        slot.taken_ns = now_ns;
        try {
            frame_.resize(bytes_of(channels_[i]));
        } catch (const std::bad_alloc&) {
            continue;  // who asks waits; the frame does not
        }
        read_back(i, frame_);
        const std::scoped_lock lock(mutex_);
        std::swap(slot.rgba, frame_);
        slot.full = true;
        if (++taken == most) next_ = i + 1;
    }
    if (taken > 0) filled_.notify_one();
}

Preview::Picture Preview::newest(std::size_t channel, std::int64_t now_ns) {
    Slot& slot = *slots_.at(channel);
    slot.asked_ns.store(now_ns, std::memory_order_relaxed);
    const std::scoped_lock lock(mutex_);
    return slot.picture;
}

std::optional<std::size_t> Preview::find(std::string_view name) const noexcept {
    const auto found = std::find_if(channels_.begin(), channels_.end(),
                                    [name](const render::Channel& channel) { return channel.name == name; });
    if (found == channels_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - channels_.begin());
}

bool Preview::any_full() const noexcept {
    return std::any_of(slots_.begin(), slots_.end(), [](const auto& slot) { return slot->full; });
}

void Preview::run() {
    // Frames come first where threads share processors: on Linux this is of the thread that calls.
    constexpr int kYields = 10;
    (void)::setpriority(PRIO_PROCESS, 0, kYields);
    std::unique_lock lock(mutex_);
    while (true) {
        filled_.wait(lock, [this] { return stopping_ || any_full(); });
        if (stopping_) return;
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            Slot& slot = *slots_[i];
            if (!slot.full) continue;
            std::swap(slot.rgba, working_);
            slot.full = false;
            lock.unlock();
            const render::Channel& channel = channels_[i];
            const int factor = (channel.width_px + settings_.width_px - 1) / settings_.width_px;
            bool made = false;
            std::shared_ptr<const std::string> file;
            try {
                shrink(channel, factor);
                made = encode_(channel.width_px / factor, std::max(1, channel.height_px / factor), working_,
                               settings_.quality, file_);
                if (made) file = std::make_shared<const std::string>(file_);
            } catch (const std::exception&) {
                made = false;  // memory is short: the old picture stays
            }
            lock.lock();
            if (made) slot.picture = {std::move(file), slot.picture.number + 1};
        }
    }
}

/// The mean of each factor * factor pixels, in place: what is written lies before what is still to be read.
void Preview::shrink(const render::Channel& channel, int factor) {
    if (factor <= 1) return;
    const auto step = static_cast<std::size_t>(factor);
    const auto stride = static_cast<std::size_t>(channel.width_px) * 4;
    const std::size_t columns = static_cast<std::size_t>(channel.width_px) / step;
    const std::size_t rows = std::max<std::size_t>(1, static_cast<std::size_t>(channel.height_px) / step);
    const std::size_t tall = std::min(step, static_cast<std::size_t>(channel.height_px));
    const float inverse = 1.0F / static_cast<float>(tall * step);
    const std::size_t wide = columns * step * 4;
    sums_.resize(wide);
    std::byte* to = working_.data();
    for (std::size_t row = 0; row < rows; ++row) {
        std::fill(sums_.begin(), sums_.end(), 0U);
        for (std::size_t y = 0; y < tall; ++y) {
            const std::byte* from = &working_[(row * step + y) * stride];
            for (std::size_t i = 0; i < wide; ++i)
                sums_[i] += std::to_integer<std::uint32_t>(from[i]);
        }
        const std::uint32_t* sum = sums_.data();
        for (std::size_t column = 0; column < columns; ++column, sum += 4 * step) {
            for (std::size_t component = 0; component < 4; ++component) {
                std::uint32_t all = 0;
                for (std::size_t x = 0; x < step; ++x)
                    all += sum[x * 4 + component];
                *to++ =
                    static_cast<std::byte>(static_cast<unsigned>(static_cast<float>(all) * inverse + 0.5F));
            }
        }
    }
}

}  // namespace skyig::server
