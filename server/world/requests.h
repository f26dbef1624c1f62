// What the host has asked and not been answered yet, and what it wants to hear again and again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocol/cigi/packets.h"
#include "protocol/cigi/packets_sight.h"

namespace skyig::server::world {

using Request = std::variant<protocol::cigi::HatHotRequest, protocol::cigi::LosSegmentRequest,
                             protocol::cigi::LosVectorRequest, protocol::cigi::PositionRequest,
                             protocol::cigi::EnvConditionsRequest>;

/// First asked, first answered. A standing request takes its turn in the same row each time it is due, and
/// stands in it once at most: what one host asks too much cannot keep another request from its turn.
/// Allocates at construction only.
class Requests {
  public:
    static constexpr std::size_t kMostWaiting = 1024;
    static constexpr std::size_t kMostStanding = 256;

    Requests();

    // False when there is no room: the request is forgotten.

    // With an update period it stands until another one of the same id comes; both kinds of sight share ids.
    bool ask(const protocol::cigi::HatHotRequest& request) noexcept;
    bool ask(const protocol::cigi::LosSegmentRequest& request) noexcept;
    bool ask(const protocol::cigi::LosVectorRequest& request) noexcept;
    /// In continuous mode it stands until another one for the same object comes.
    bool ask(const protocol::cigi::PositionRequest& request) noexcept;
    bool ask(const protocol::cigi::EnvConditionsRequest& request) noexcept;

    /// A frame begins: what is due takes its turn.
    void next_frame() noexcept;

    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] std::size_t waiting() const noexcept { return count_; }
    [[nodiscard]] std::size_t standing() const noexcept { return standing_.size(); }
    /// The first; only while not empty.
    [[nodiscard]] const Request& front() const noexcept { return waiting_[first_].request; }
    void pop() noexcept;
    void clear() noexcept;

  private:
    struct Waiting {
        Request request;
        bool standing = false;
    };
    struct Standing {
        Request request;
        std::uint32_t period_frames = 1;
        std::uint32_t due_in_frames = 0;
        bool waits = false;
    };

    bool push(const Request& request, bool standing) noexcept;
    bool ask_again(const Request& request, std::uint32_t period_frames) noexcept;
    bool stand(const Request& request, std::uint32_t period_frames) noexcept;
    Standing* find_standing(const Request& like) noexcept;
    void forget_standing(const Request& like) noexcept;

    std::vector<Waiting> waiting_;
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::vector<Standing> standing_;
};

}  // namespace skyig::server::world
