#include "server/image_writer.h"

#include <fmt/format.h>

#include <utility>

namespace skyig::server {

ImageWriter::ImageWriter(Settings settings, Files files)
    : settings_(std::move(settings)), frames_(settings_.buffers) {
    free_.reserve(frames_.size());
    queue_.reserve(frames_.size());
    for (Frame& frame : frames_) {
        free_.push_back(&frame);
        if (takes_scenes()) continue;
        for (const render::Channel& channel : settings_.channels) {
            const auto pixels =
                static_cast<std::size_t>(channel.width_px) * static_cast<std::size_t>(channel.height_px);
            frame.channels.emplace_back(channel.elsewhere ? 0 : pixels * 4);
        }
    }
    // What it holds may be bound to the thread that uses it, as an OpenGL context is.
    thread_ = std::thread([this, made = std::move(files)]() mutable {
        const Files used = std::move(made);
        run(used);
    });
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
    return take_free();
}

ImageWriter::Frame* ImageWriter::acquire() {
    std::unique_lock lock(mutex_);
    freed_.wait(lock, [this] { return !free_.empty(); });
    return take_free();
}

ImageWriter::Frame* ImageWriter::take_free() noexcept {
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

void ImageWriter::run(const Files& files) {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return finishing_ || !queue_.empty(); });
        if (queue_.empty()) return;
        Frame* frame = queue_.front();
        queue_.erase(queue_.begin());
        lock.unlock();
        if (frame->written)
            write(*frame, files.write);
        else
            files.see(*frame);
        lock.lock();
        free_.push_back(frame);
        freed_.notify_one();
    }
}

void ImageWriter::write(const Frame& frame, const WriteFile& write_file) {
    for (std::size_t i = 0; i < settings_.channels.size(); ++i) {
        if (settings_.channels[i].elsewhere) continue;
        const std::string path = fmt::format("{}/{}_{:06}.{}", settings_.directory,
                                             settings_.channels[i].name, frame.number, settings_.extension);
        std::string error;
        const bool complete = write_file(path, frame, i, error);
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
