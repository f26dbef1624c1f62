// A thread that fills tiles of a snapshot while frames are drawn, one request at a time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <span>
#include <thread>

#include "render/cloud/snapshot.h"

namespace skyig::render::cloud {

/// What is referred to must live and stay until wait() has returned.
struct MarchRequest {
    const CloudSource* source = nullptr;
    Snapshot* snapshot = nullptr;
    std::span<const int> tiles;
    /// They are the snapshot's last.
    bool last = false;
};

class MarchWorker {
  public:
    /// Starts the thread. \throws std::system_error when the system gives none
    MarchWorker();
    ~MarchWorker();
    MarchWorker(const MarchWorker&) = delete;
    MarchWorker& operator=(const MarchWorker&) = delete;

    /// Precondition: nothing is asked for that wait() was not called for since.
    void request(const MarchRequest& request) noexcept;
    /// Until the request is done; at once when there is none.
    void wait() noexcept;

  private:
    void run() noexcept;

    std::mutex mutex_;
    std::condition_variable changed_;
    MarchRequest wanted_;
    bool busy_ = false;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace skyig::render::cloud
