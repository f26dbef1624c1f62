#include "server/overload.h"

#include <algorithm>

#include "server/from_config.h"

namespace skyig::server {

Overload::Overload(const config::Overload& settings, double period_s)
    : period_s_(period_s),
      thin_above_(settings.thin_above_pct * 1e-2),
      return_below_(settings.return_below_pct * 1e-2),
      thin_after_(settings.thin_after_frames),
      return_after_(settings.return_after_frames) {
    for (const config::Thinning thinning : settings.order)
        order_.push_back(thin_of(thinning));
}

Overload::Step Overload::add(double work_s, double passed_s, render::Thinned thinnable) noexcept {
    constexpr int kTooLong = 2;
    constexpr int kNotCalm = 5;
    const double load = work_s / period_s_;
    since_step_s_ += passed_s;
    since_return_s_ += passed_s;
    over_ = load > thin_above_ ? std::min(over_ + kTooLong, kTooLong * thin_after_) : std::max(over_ - 1, 0);
    const int wait = return_after_ * patience_;
    calm_ = load < return_below_ ? std::min(calm_ + 1, wait) : std::max(calm_ - kNotCalm, 0);
    if (over_ == 0) state_.exhausted = false;
    if (since_step_s_ < kBetweenSteps_s) return Step::kNone;
    if (over_ >= kTooLong * thin_after_) return thin(load, thinnable);
    if (calm_ >= wait && thinned_.any()) return give_back(load);
    return Step::kNone;
}

Overload::Step Overload::thin(double load, render::Thinned thinnable) noexcept {
    const auto found = std::find_if(order_.begin(), order_.end(), [&](render::Thin thing) {
        const auto bit = static_cast<std::size_t>(thing);
        return thinnable[bit] && !thinned_[bit];
    });
    state_.exhausted = found == order_.end();
    if (state_.exhausted) return Step::kNone;
    if (since_return_s_ < kTrial_s && !return_failed_) {
        return_failed_ = true;
        patience_ = std::min(2 * patience_, kMostPatience);
    }
    thinned_.set(static_cast<std::size_t>(*found));
    ++state_.times_thinned;
    note(Step::kThinned, *found, load);
    return Step::kThinned;
}

Overload::Step Overload::give_back(double load) noexcept {
    const auto last = std::find_if(order_.rbegin(), order_.rend(), [this](render::Thin thing) {
        return thinned_[static_cast<std::size_t>(thing)];
    });
    if (!return_failed_ && since_return_s_ >= kTrial_s) patience_ = std::max(patience_ / 2, 1);
    return_failed_ = false;
    thinned_.reset(static_cast<std::size_t>(*last));
    since_return_s_ = 0.0;
    ++state_.times_returned;
    note(Step::kReturned, *last, load);
    return Step::kReturned;
}

void Overload::note(Step step, render::Thin thing, double load) noexcept {
    since_step_s_ = 0.0;
    over_ = 0;
    calm_ = 0;
    state_.thinned = thinned_;
    state_.last_step = step;
    state_.last_thing = thing;
    state_.last_load = load;
}

}  // namespace skyig::server
