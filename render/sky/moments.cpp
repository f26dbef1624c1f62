// Light scattered more than once, kept as the moments l <= 2 of the radiance around each point: enough for
// the smooth part of any phase function, six numbers a wavelength. Three orders are gathered, the rest is a
// geometric tail.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "render/sky/path.h"
#include "render/sky/phase.h"
#include "render/sky/quadrature.h"

namespace skyig::render::sky {
namespace {

constexpr int kHalfSines = 8;  // view directions on either side of the local horizon
constexpr int kFirstAzimuths = 8;
constexpr int kLaterAzimuths = 4;
constexpr int kGatherSteps = 14;
constexpr float kLeastMean = 1e-30F;

using NodeMoments = std::array<Lanes, kMoments>;

struct Order {
    std::vector<NodeMoments> air = std::vector<NodeMoments>(std::size_t{kMomentRows} * kSineNodes);
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

void add_radiance(const ViewSine& view, double x, double weight, const Lanes& light, NodeMoments& moments) {
    const double z = view.sine;
    const std::array<double, kMoments> factor = {
        1.0, 3.0 * z, 3.0 * x, 5.0 * (1.5 * z * z - 0.5), 15.0 * x * z, 3.75 * (2.0 * x * x - (1.0 - z * z))};
    for (std::size_t k = 0; k < kMoments; ++k) {
        const auto w = static_cast<float>(weight * factor[k]);
        for (int i = 0; i < kLanes; ++i)
            moments[k].v[i] += w * light.v[i];
    }
}

// One order of light around every node. `previous` null: light scattered once.
class Gatherer {
  public:
    Gatherer(const AirData& data, const MomentTable* previous) : data_(data), previous_(previous) {}

    void gather(Order& order) {
        for (int row = 0; row < kMomentRows; ++row) {
            const double height_m = data_.moment_row_height_m(row);
            for (const ViewSine& view : view_sines(data_.shell.dip_sine(height_m))) {
                Path path{};
                path.steps = steps_.data();
                lay_path(data_, height_m, view.sine, view.side, kGatherSteps, path);
                kernels().weigh(data_.medium, path);
                for (int sine = 0; sine < kSineNodes; ++sine) {
                    gather_azimuths(path, view, sine, row, order);
                }
            }
        }
    }

  private:
    void gather_azimuths(const Path& path, const ViewSine& view, int sine, int row, Order& order) const {
        const int azimuths = previous_ == nullptr ? kFirstAzimuths : kLaterAzimuths;
        const double weight = view.weight / azimuths;
        const double source = moment_sine(sine);
        const double level = std::sqrt(std::max(0.0, 1.0 - source * source));
        const double reach = std::sqrt(std::max(0.0, 1.0 - view.sine * view.sine));
        const auto node = static_cast<std::size_t>(row * kSineNodes + sine);
        for (int a = 0; a < azimuths; ++a) {
            const double x = reach * std::cos(std::numbers::pi * (a + 0.5) / azimuths);
            const Lanes light = radiance(path, source, view.sine * source + x * level);
            add_radiance(view, x, weight, light, order.air[node]);
            if (row != 0 || view.side == Side::kGround) continue;
            const auto w = static_cast<float>(4.0 * std::numbers::pi * weight * view.sine);
            for (int i = 0; i < kLanes; ++i)
                order.ground[static_cast<std::size_t>(sine)].v[i] += w * light.v[i];
        }
    }

    Lanes radiance(const Path& path, double source_sine, double view_cosine) const {
        const Source source{source_sine, view_cosine, static_cast<float>(rayleigh_phase(view_cosine))};
        Lanes light{};
        if (previous_ != nullptr) {
            kernels().add_higher_orders(data_.medium, *previous_, path, source, light);
            return light;
        }
        Lanes aerosol{};
        kernels().add_first_order(data_.medium, data_.column_table(), path, source, light, aerosol);
        const auto phase = static_cast<float>(cornette_shanks_phase(data_.model.aerosol_g, view_cosine));
        for (int i = 0; i < kLanes; ++i)
            light.v[i] += phase * aerosol.v[i];
        return light;
    }

    const AirData& data_;
    const MomentTable* previous_;
    std::array<PathStep, kGatherSteps> steps_{};
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

}  // namespace

void build_moments(AirData& data) {
    data.moments.assign(std::size_t{kMomentRows} * kSineNodes * kMoments * kLanes, 0.0F);
    data.log_ground.assign(std::size_t{kSineNodes} * kLanes, 0.0F);
    std::array<Order, 3> orders;
    Gatherer(data, nullptr).gather(orders[0]);
    for (std::size_t n = 1; n < orders.size(); ++n) {
        tabulate(orders[n - 1], data.moments, data.log_ground);
        const MomentTable previous = data.moment_table();
        Gatherer(data, &previous).gather(orders[n]);
    }
    extend_by_tail(orders[1], orders[2]);
    add_order(orders[1], orders[0]);
    add_order(orders[2], orders[0]);
    tabulate(orders[0], data.moments, data.log_ground);
}

}  // namespace skyig::render::sky
