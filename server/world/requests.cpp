#include "server/world/requests.h"

#include <algorithm>
#include <optional>

namespace skyig::server::world {

using protocol::cigi::EnvConditionsRequest;
using protocol::cigi::HatHotRequest;
using protocol::cigi::LosSegmentRequest;
using protocol::cigi::LosVectorRequest;
using protocol::cigi::PositionRequest;

namespace {

std::optional<std::uint16_t> id_of_sight(const Request& request) noexcept {
    if (const auto* segment = std::get_if<LosSegmentRequest>(&request)) return segment->request_id;
    if (const auto* vector = std::get_if<LosVectorRequest>(&request)) return vector->request_id;
    return std::nullopt;
}

/// One takes the other's place.
bool same_matter(const Request& a, const Request& b) noexcept {
    if (const auto* hat = std::get_if<HatHotRequest>(&a)) {
        const auto* other = std::get_if<HatHotRequest>(&b);
        return other != nullptr && hat->request_id == other->request_id;
    }
    if (const auto sight = id_of_sight(a)) return sight == id_of_sight(b);
    if (const auto* position = std::get_if<PositionRequest>(&a)) {
        const auto* other = std::get_if<PositionRequest>(&b);
        return other != nullptr && position->object_class == other->object_class &&
               position->object_id == other->object_id && position->part_id == other->part_id;
    }
    return false;
}

}  // namespace

Requests::Requests() : waiting_(kMostWaiting) {
    standing_.reserve(kMostStanding);
}

bool Requests::ask(const HatHotRequest& request) noexcept {
    return ask_again(request, request.update_period);
}

bool Requests::ask(const LosSegmentRequest& request) noexcept {
    return ask_again(request, request.update_period);
}

bool Requests::ask(const LosVectorRequest& request) noexcept {
    return ask_again(request, request.update_period);
}

bool Requests::ask(const PositionRequest& request) noexcept {
    return ask_again(request, request.update_mode ? 1 : 0);
}

bool Requests::ask_again(const Request& request, std::uint32_t period_frames) noexcept {
    if (period_frames > 0) return stand(request, period_frames);
    forget_standing(request);
    return push(request, false);
}

bool Requests::ask(const EnvConditionsRequest& request) noexcept {
    return push(request, false);
}

bool Requests::push(const Request& request, bool standing) noexcept {
    if (count_ == kMostWaiting) return false;
    waiting_[(first_ + count_++) % kMostWaiting] = {request, standing};
    return true;
}

bool Requests::stand(const Request& request, std::uint32_t period_frames) noexcept {
    if (Standing* standing = find_standing(request)) {
        // One that waits for its turn already is answered as it was asked then, and anew in the next frame.
        *standing = {request, period_frames, 0, standing->waits};
        return true;
    }
    if (standing_.size() == kMostStanding) return false;
    standing_.push_back({request, period_frames, 0, false});
    return true;
}

Requests::Standing* Requests::find_standing(const Request& like) noexcept {
    const auto found = std::find_if(standing_.begin(), standing_.end(), [&like](const Standing& standing) {
        return same_matter(standing.request, like);
    });
    return found == standing_.end() ? nullptr : &*found;
}

void Requests::forget_standing(const Request& like) noexcept {
    std::erase_if(standing_,
                  [&like](const Standing& standing) { return same_matter(standing.request, like); });
}

void Requests::next_frame() noexcept {
    for (Standing& standing : standing_) {
        if (standing.due_in_frames > 0) --standing.due_in_frames;
        if (standing.due_in_frames > 0 || standing.waits) continue;
        if (!push(standing.request, true)) continue;
        standing.waits = true;
        standing.due_in_frames = standing.period_frames;
    }
}

void Requests::pop() noexcept {
    if (count_ == 0) return;
    const Waiting& gone = waiting_[first_];
    if (gone.standing) {
        if (Standing* standing = find_standing(gone.request)) standing->waits = false;
    }
    first_ = (first_ + 1) % kMostWaiting;
    --count_;
}

void Requests::clear() noexcept {
    first_ = count_ = 0;
    standing_.clear();
}

}  // namespace skyig::server::world
