// Light scattered more than once, kept as the moments l <= 4 of the radiance around each point: enough for
// the smooth part of any phase function, fifteen numbers a wavelength (l <= 2 leaves errors of 10 % in haze).
// Three orders at least are gathered, the rest is a geometric tail.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "render/sky/path.h"
#include "render/sky/phase.h"
#include "render/sky/quadrature.h"

namespace skyig::render::sky {
namespace {

constexpr std::size_t kHalfSines = 8;  // view directions on either side of the local horizon
constexpr int kFirstAzimuths = 6;
constexpr int kLaterAzimuths = 4;
constexpr int kGatherSteps = 16;
// In twilight light falls by a factor of ten over some 200 km of a level ray.
constexpr int kTwilightSteps = 32;
constexpr float kLeastMean = 1e-30F;

using NodeMoments = std::array<Lanes, kMoments>;

struct Order {
    std::vector<NodeMoments> air = std::vector<NodeMoments>(kMomentNodes);
    std::vector<Lanes> ground = std::vector<Lanes>(kSineNodes);
};

struct ViewSine {
    double sine = 0.0;
    double weight = 0.0;  // part of the sphere, all azimuths
    Side side = Side::kSky;
};

std::array<ViewSine, 2 * kHalfSines> view_sines(double dip_sine) {
    const auto rule = gauss_legendre<kHalfSines>();
    std::array<ViewSine, 2 * kHalfSines> views;
    for (std::size_t i = 0; i < kHalfSines; ++i) {
        const double below = 0.5 * (1.0 - dip_sine);
        const double above = 0.5 * (1.0 + dip_sine);
        views[i] = {-1.0 + below * (1.0 + rule.node[i]), 0.5 * rule.weight[i] * below, Side::kGround};
        views[kHalfSines + i] = {1.0 - above * (1.0 - rule.node[i]), 0.5 * rule.weight[i] * above,
                                 Side::kSky};
    }
    return views;
}

#include "render/sky/angular_functions.inc"

// One over the mean square of each function over the sphere.
constexpr std::array<double, kMoments> kMomentFactor = {
    1.0, 3.0, 3.0, 5.0, 15.0, 3.75, 7.0, 2.625, 26.25, 4.375, 9.0, 5.625, 2.8125, 39.375, 4.921875};

// One view direction: its level part towards the source's azimuth, and what its light adds to each moment.
struct ViewAzimuth {
    double x = 0.0;
    std::array<float, kMoments> weight{};
};

ViewAzimuth view_azimuth(const ViewSine& view, int azimuth, int azimuths) {
    ViewAzimuth made;
    made.x = std::sqrt(std::max(0.0, 1.0 - view.sine * view.sine)) *
             std::cos(std::numbers::pi * (azimuth + 0.5) / azimuths);
    double y[kMoments];
    angular_functions(view.sine, made.x, y);
    for (std::size_t k = 0; k < kMoments; ++k)
        made.weight[k] = static_cast<float>(view.weight / azimuths * kMomentFactor[k] * y[k]);
    return made;
}

// One order of light around every node. `previous` null: light scattered once.
class Gatherer {
  public:
    Gatherer(const AirData& data, const MomentTable* previous)
        : data_(data),
          previous_(previous),
          azimuths_(previous == nullptr ? kFirstAzimuths : kLaterAzimuths) {}

    void gather(Order& order) {
        for (int row = 0; row < kMomentRows; ++row) {
            for (const ViewSine& view : view_sines(data_.shell.dip_sine(data_.moment_row_height_m(row)))) {
                for (int a = 0; a < azimuths_; ++a)
                    views_[static_cast<std::size_t>(a)] = view_azimuth(view, a, azimuths_);
                if (previous_ != nullptr) {
                    gather(row, view, {0, kSineNodes, kGatherSteps}, order);
                    continue;
                }
                gather(row, view, {0, kNightNodes + 1, kTwilightSteps}, order);
                gather(row, view, {kNightNodes + 1, kSineNodes, kGatherSteps}, order);
            }
        }
    }

  private:
    struct Sines {
        int first;
        int end;
        int steps;
    };
    void gather(int row, const ViewSine& view, const Sines& sines, Order& order) {
        Path path{};
        path.steps = steps_.data();
        lay_path(data_, data_.moment_row_height_m(row), view.sine, view.side, sines.steps, path);
        kernels().weigh(data_.medium, path);
        const int batch = kMaxSources / azimuths_;
        for (int first = sines.first; first < sines.end; first += batch) {
            const int count = std::min(batch, sines.end - first);
            place_sources(view, first, count);
            trace(path, count * azimuths_);
            collect(view, row, first, count, order);
        }
    }

    [[nodiscard]] std::span<const ViewAzimuth> views() const {
        return std::span(views_).first(static_cast<std::size_t>(azimuths_));
    }

    void place_sources(const ViewSine& view, int first, int count) {
        Source* source = sources_.data();
        for (int sine = first; sine < first + count; ++sine) {
            const double up = moment_sine(sine);
            const double level = std::sqrt(std::max(0.0, 1.0 - up * up));
            for (const ViewAzimuth& azimuth : views()) {
                const double cosine = view.sine * up + azimuth.x * level;
                *source++ = {up, cosine, static_cast<float>(rayleigh_phase(cosine))};
            }
        }
    }

    void trace(const Path& path, int count) {
        light_.fill(Lanes{});
        if (previous_ != nullptr) {
            kernels().add_higher_orders(data_.medium, *previous_, path, sources_.data(), count,
                                        light_.data());
            return;
        }
        for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
            Lanes aerosol{};
            kernels().add_first_order(data_.medium, data_.source_table(), path, sources_[j], light_[j],
                                      aerosol);
            const auto phase =
                static_cast<float>(cornette_shanks_phase(data_.model.aerosol_g, sources_[j].view_cosine));
            for (int i = 0; i < kLanes; ++i)
                light_[j].v[i] += phase * aerosol.v[i];
        }
    }

    void collect(const ViewSine& view, int row, int first, int count, Order& order) const {
        const auto down = static_cast<float>(4.0 * std::numbers::pi * view.weight / azimuths_ * view.sine);
        const Lanes* light = light_.data();
        for (int sine = first; sine < first + count; ++sine) {
            for (const ViewAzimuth& azimuth : views()) {
                const Lanes& seen = *light++;
                kernels().add_moments(azimuth.weight.data(), seen, order.air[moment_node(row, sine)].data());
                if (row != 0 || view.side == Side::kGround) continue;
                Lanes& ground = order.ground[static_cast<std::size_t>(sine)];
                for (int i = 0; i < kLanes; ++i)
                    ground.v[i] += down * seen.v[i];
            }
        }
    }

    const AirData& data_;
    const MomentTable* previous_;
    int azimuths_;
    std::array<ViewAzimuth, kFirstAzimuths> views_{};
    std::array<PathStep, kTwilightSteps> steps_{};
    std::array<Source, kMaxSources> sources_{};
    std::array<Lanes, kMaxSources> light_{};
};

// The form in which the kernels read moments.
void tabulate(const Order& order, std::vector<float>& nodes, std::vector<float>& ground) {
    float* out = nodes.data();
    for (const NodeMoments& node : order.air) {
        for (int i = 0; i < kLanes; ++i)
            *out++ = std::log(node[0].v[i] + kDarkness);
        for (std::size_t k = 1; k < kMoments; ++k) {
            for (int i = 0; i < kLanes; ++i)
                *out++ = node[k].v[i] / std::max(node[0].v[i], kLeastMean);
        }
    }
    out = ground.data();
    for (const Lanes& irradiance : order.ground) {
        for (int i = 0; i < kLanes; ++i)
            *out++ = std::log(irradiance.v[i] + kDarkness);
    }
}

// What stands for the last gathered order and all after it, as a multiple of it.
float tail(float last, float before_last) {
    constexpr float kLargestRatio = 0.9F;
    return 1.0F / (1.0F - std::min(kLargestRatio, last / std::max(before_last, kLeastMean)));
}

void add_order(const Order& order, Order& sum) {
    for (std::size_t n = 0; n < sum.air.size(); ++n) {
        for (std::size_t k = 0; k < kMoments; ++k) {
            for (int i = 0; i < kLanes; ++i)
                sum.air[n][k].v[i] += order.air[n][k].v[i];
        }
    }
    for (std::size_t n = 0; n < sum.ground.size(); ++n) {
        for (int i = 0; i < kLanes; ++i)
            sum.ground[n].v[i] += order.ground[n].v[i];
    }
}

void extend_by_tail(const Order& before_last, Order& last) {
    for (std::size_t n = 0; n < last.air.size(); ++n) {
        for (int i = 0; i < kLanes; ++i) {
            const float factor = tail(last.air[n][0].v[i], before_last.air[n][0].v[i]);
            for (std::size_t k = 0; k < kMoments; ++k)
                last.air[n][k].v[i] *= factor;
        }
    }
    for (std::size_t n = 0; n < last.ground.size(); ++n) {
        for (int i = 0; i < kLanes; ++i) {
            last.ground[n].v[i] *= tail(last.ground[n].v[i], before_last.ground[n].v[i]);
        }
    }
}

// Whether light of this order still is a good part of the whole anywhere by day: only then the tail is worth
// replacing by one more gathering. Thick haze needs it, since orders first sink towards the ground and only
// then die out.
bool matters(const Order& order, const Order& sum) {
    constexpr float kSmallPart = 0.06F;
    for (int row = 0; row < kMomentRows; ++row) {
        for (int sine = kNightNodes + 1; sine < kSineNodes; ++sine) {
            const std::size_t node = moment_node(row, sine);
            for (int i = 0; i < kLanes; ++i) {
                if (order.air[node][0].v[i] > kSmallPart * sum.air[node][0].v[i]) return true;
            }
        }
    }
    return false;
}

}  // namespace

void build_moments(AirData& data) {
    constexpr int kFewestOrders = 3;
    constexpr int kMostOrders = 12;
    data.moments.assign(kMomentNodes * kMoments * kLanes, 0.0F);
    data.log_ground.assign(std::size_t{kSineNodes} * kLanes, 0.0F);
    Order sum;
    Order before;
    Order last;
    Gatherer(data, nullptr).gather(last);
    for (int count = 2; count <= kMostOrders; ++count) {
        add_order(last, sum);
        tabulate(last, data.moments, data.log_ground);
        const MomentTable previous = data.moment_table();
        std::swap(before, last);
        last = Order{};
        Gatherer(data, &previous).gather(last);
        if (count >= kFewestOrders && !matters(last, sum)) break;
    }
    extend_by_tail(before, last);
    add_order(last, sum);
    tabulate(sum, data.moments, data.log_ground);
}

}  // namespace skyig::render::sky
