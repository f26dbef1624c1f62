#include "render/cloud/march_worker.h"

namespace skyig::render::cloud {

MarchWorker::MarchWorker() : thread_([this] { run(); }) {}

MarchWorker::~MarchWorker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void MarchWorker::request(const MarchRequest& request) noexcept {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = request;
        busy_ = true;
    }
    changed_.notify_all();
}

void MarchWorker::wait() noexcept {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !busy_; });
}

void MarchWorker::run() noexcept {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stop_ || busy_; });
        if (stop_) return;
        const MarchRequest wanted = wanted_;
        lock.unlock();
        for (const int tile : wanted.tiles)
            wanted.snapshot->march(*wanted.source, tile);
        if (wanted.last) wanted.snapshot->lay_distances();
        lock.lock();
        busy_ = false;
        changed_.notify_all();
    }
}

}  // namespace skyig::render::cloud
