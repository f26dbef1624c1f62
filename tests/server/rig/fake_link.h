// Machines of a rig on one thread and a clock that is moved by hand: what one sends lies in the others'
// queues, and who waits lets the others work.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "server/clock.h"
#include "server/rig/link.h"

namespace skyig::server::tests {

class FakeNetwork;

class FakeLink final : public rig::Link {
  public:
    explicit FakeLink(FakeNetwork& network) : network_(network) {}

    void send(const rig::FrameMessage& message) override;
    void send(const rig::ShowMessage& message) override;
    void send(const rig::NodeMessage& message) override;
    bool take(rig::FrameMessage& message) override { return pop(frames, message); }
    bool take(rig::ShowMessage& message) override { return pop(shows, message); }
    bool take(rig::NodeMessage& message) override { return pop(nodes, message); }
    void wait(std::int64_t most_ns) override;
    [[nodiscard]] rig::LinkCounts counts() const override { return {}; }

    std::deque<rig::FrameMessage> frames;
    std::deque<rig::ShowMessage> shows;
    std::deque<rig::NodeMessage> nodes;
    /// What the others do while this one waits.
    std::function<void()> meanwhile;
    bool cut = false;

  private:
    template <class Message>
    static bool pop(std::deque<Message>& queue, Message& message) {
        if (queue.empty()) return false;
        message = queue.front();
        queue.pop_front();
        return true;
    }
    FakeNetwork& network_;
};

class FakeNetwork {
  public:
    FakeLink& join() { return *links_.emplace_back(std::make_unique<FakeLink>(*this)); }

    template <class Message>
    void send(const FakeLink& from, const Message& message, std::deque<Message> FakeLink::*queue) {
        if (from.cut) return;
        for (const auto& link : links_)
            if (link.get() != &from && !link->cut) ((*link).*queue).push_back(message);
    }

    ManualClock clock{1'000'000'000};

  private:
    std::vector<std::unique_ptr<FakeLink>> links_;
};

inline void FakeLink::send(const rig::FrameMessage& message) {
    network_.send(*this, message, &FakeLink::frames);
}
inline void FakeLink::send(const rig::ShowMessage& message) {
    network_.send(*this, message, &FakeLink::shows);
}
inline void FakeLink::send(const rig::NodeMessage& message) {
    network_.send(*this, message, &FakeLink::nodes);
}
inline void FakeLink::wait(std::int64_t most_ns) {
    if (meanwhile) meanwhile();
    // What lies there wakes it, as it does on a real one.
    if (frames.empty() && shows.empty() && nodes.empty())
        network_.clock.advance_ns(std::min<std::int64_t>(most_ns, 1'000'000));
}

}  // namespace skyig::server::tests
