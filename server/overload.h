// What frames leave out while they take too long: one thing after the other in a configured order, and back.
#pragma once

#include <cstdint>
#include <vector>

#include "config/pacing.h"
#include "render/quality.h"

namespace skyig::server {

/// A controller without a clock. After `thin_after_frames` frames in a row that took more than
/// `thin_above_pct` of the period the first thing of the order that would help is left out; a frame that took
/// less makes up for half a long one, so that every second one too long is too often, and every third is not.
/// After `return_after_frames` frames below `return_below_pct`, each other one making up for five, the last
/// thing left out comes back. At most one step a second. What had to go again within kTrial_s of its return
/// waits twice as long the next time, up to kMostPatience times: at a steady load steps become rarer and
/// rarer. Allocates nothing.
class Overload {
  public:
    static constexpr double kBetweenSteps_s = 1.0;
    static constexpr double kTrial_s = 30.0;
    static constexpr int kMostPatience = 64;

    enum class Step : std::uint8_t { kNone, kThinned, kReturned };

    Overload(const config::Overload& settings, double period_s);

    /// One frame is over. \param work_s  that it took, without waits \param passed_s  since the frame before
    /// \param thinnable  what would make the next one cheaper
    Step add(double work_s, double passed_s, render::Thinned thinnable) noexcept;

    /// What the next frame leaves out.
    [[nodiscard]] render::Thinned thinned() const noexcept { return thinned_; }

    struct State {
        render::Thinned thinned;
        std::uint64_t times_thinned = 0;
        std::uint64_t times_returned = 0;
        /// Frames take too long and nothing of the order would help any more.
        bool exhausted = false;
        /// The last step: what, whether it left it out, and what part of the period a frame had taken.
        Step last_step = Step::kNone;
        render::Thin last_thing = render::Thin::kCloudRefresh;
        double last_load = 0.0;
    };
    [[nodiscard]] const State& state() const noexcept { return state_; }

  private:
    Step thin(double load, render::Thinned thinnable) noexcept;
    Step give_back(double load) noexcept;
    void note(Step step, render::Thin thing, double load) noexcept;

    std::vector<render::Thin> order_;
    double period_s_;
    double thin_above_;
    double return_below_;
    int thin_after_;
    int return_after_;

    render::Thinned thinned_;
    int over_ = 0;
    int calm_ = 0;
    int patience_ = 1;
    double since_step_s_ = kBetweenSteps_s;
    double since_return_s_ = kTrial_s;
    /// What came back last had to go again.
    bool return_failed_ = false;
    State state_;
};

}  // namespace skyig::server
