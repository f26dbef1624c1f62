// Computes the tables of new air on a thread of its own, one request at a time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "render/scene.h"
#include "render/sky/air_tables.h"

namespace skyig::render {

class AirBuilder {
  public:
    /// Starts the thread. \throws std::system_error when the system gives none
    AirBuilder();
    ~AirBuilder();
    AirBuilder(const AirBuilder&) = delete;
    AirBuilder& operator=(const AirBuilder&) = delete;

    /// Begins to build. Precondition: nothing is being built, or take() has been called since.
    void request(const sky::AirModel& model, sky::Orders orders) noexcept;

    /// Waits until the request is done. Nothing when it failed (no memory): the caller keeps what it has and
    /// asks again.
    [[nodiscard]] std::optional<sky::AirTables> take() noexcept;

  private:
    void run() noexcept;

    std::mutex mutex_;
    std::condition_variable changed_;
    struct Request {
        sky::AirModel model;
        sky::Orders orders = sky::Orders::kAll;
    };

    std::optional<Request> wanted_;
    std::optional<sky::AirTables> built_;
    bool done_ = false;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace skyig::render
