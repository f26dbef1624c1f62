#include "render/air_builder.h"

#include <exception>
#include <utility>

namespace skyig::render {

AirBuilder::AirBuilder() : thread_([this] { run(); }) {}

AirBuilder::~AirBuilder() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void AirBuilder::request(const sky::AirModel& model, sky::Orders orders) noexcept {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = Request{model, orders};
        built_.reset();
        done_ = false;
    }
    changed_.notify_all();
}

std::optional<sky::AirTables> AirBuilder::take() noexcept {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_; });
    return std::exchange(built_, std::nullopt);
}

void AirBuilder::run() noexcept {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stop_ || wanted_.has_value(); });
        if (stop_) return;
        const Request wanted = *std::exchange(wanted_, std::nullopt);
        lock.unlock();
        std::optional<sky::AirTables> tables;
        try {
            tables.emplace(wanted.model, wanted.orders);
        } catch (const std::exception&) {
            tables.reset();
        }
        lock.lock();
        built_ = std::move(tables);
        done_ = true;
        changed_.notify_all();
    }
}

}  // namespace skyig::render
