#include "server/image_writer.h"

#include <fmt/format.h>

#include <utility>

namespace skyig::server {

ImageWriter::ImageWriter(std::string directory, std::vector<render::Channel> channels, std::size_t buffers,
                         WriteFile write_file)
    : directory_(std::move(directory)),
      channels_(std::move(channels)),
      write_file_(std::move(write_file)),
      frames_(buffers) {
    free_.reserve(buffers);
    queue_.reserve(buffers);
    for (Frame& frame : frames_) {
        for (const render::Channel& channel : channels_) {
            const auto pixels =
                static_cast<std::size_t>(channel.width_px) * static_cast<std::size_t>(channel.height_px);
            frame.channels.emplace_back(pixels * 4);
        }
        free_.push_back(&frame);
    }
    thread_ = std::thread([this] { run(); });
}

ImageWriter::~ImageWriter() {
    finish();
}

ImageWriter::Frame* ImageWriter::try_acquire() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) {
        ++counts_.skipped;
        return nullptr;
    }
    Frame* frame = free_.back();
    free_.pop_back();
    return frame;
}

void ImageWriter::submit(Frame* frame) {
    {
        const std::lock_guard lock(mutex_);
        queue_.push_back(frame);
    }
    wake_.notify_one();
}

void ImageWriter::finish() {
    {
        const std::lock_guard lock(mutex_);
        finishing_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
}

ImageWriter::Counts ImageWriter::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

std::string ImageWriter::first_error() const {
    const std::lock_guard lock(mutex_);
    return first_error_;
}

void ImageWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return finishing_ || !queue_.empty(); });
        if (queue_.empty()) return;
        Frame* frame = queue_.front();
        queue_.erase(queue_.begin());
        lock.unlock();
        write(*frame);
        lock.lock();
        free_.push_back(frame);
    }
}

void ImageWriter::write(const Frame& frame) {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        const std::string path = fmt::format("{}/{}_{:06}.png", directory_, channels_[i].name, frame.number);
        std::string error;
        const bool complete = write_file_(path, channels_[i], frame.channels[i], error);
        const std::lock_guard lock(mutex_);
        if (complete) {
            ++counts_.written;
            continue;
        }
        ++counts_.failed;
        if (first_error_.empty()) first_error_ = std::move(error);
    }
}

}  // namespace skyig::server
