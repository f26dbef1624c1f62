// Writes the tables of multiply scattered light in slabs: what adding-doubling has beyond the closed forms of
// slab_table.h. slab_table OUT_FOLDER; some seconds.
#include "render/cloud/slab_table.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "render/cloud/reference/adding_doubling.h"

namespace {

using namespace skyig::render::cloud;
using reference::AddingDoubling;
using reference::henyey_greenstein_mode;
using reference::Joint;
using reference::Layer;
using reference::Matrix;

constexpr std::size_t kStreams = 24;

// Which azimuth modes tell how much is peaked: those that smooth light has nothing of.
constexpr int kModes = 6;
constexpr int kFirstPeaked = 3;
constexpr double kUntold = 0.01;

struct TableMedium {
    double g;
    double albedo;
    double absorption;

    /// Of a node of DepthAxis, in transport depth. Infinite is where nothing changes any more.
    [[nodiscard]] double transport(std::size_t node, std::size_t nodes) const {
        const double u = static_cast<double>(node) / static_cast<double>(nodes - 1);
        const double most = absorption > 0.0 ? 12.0 / (1.7320508 * absorption) : 1500.0;
        if (node == 0) return 1e-4;
        return node + 1 == nodes ? most : std::min(most, DepthAxis::kHalf * u / (1.0 - u));
    }
    [[nodiscard]] double depth(double transport_depth) const { return transport_depth / (1.0 - albedo * g); }
};

// Three digits; nothing for what no light would show.
std::string digits(double value) {
    return std::abs(value) < 1e-6 ? "0"
           : fmt::format("{:.3g}", value).find_first_of(".e") == std::string::npos
               ? fmt::format("{:.3g}.0F", value)
               : fmt::format("{:.3g}F", value);
}

// Two cosines by which modes that have no azimuth at the vertical get their limit there.
constexpr std::array<double, 2> kNearVertical{0.98, 0.96};

void add_axis(std::size_t nodes, std::vector<double>& mu) {
    for (std::size_t i = 0; i < nodes; ++i)
        mu.push_back(CosineAxis::cosine(static_cast<double>(i) / static_cast<double>(nodes - 1)));
}

// A value at a node; factors of azimuth modes 1 and 2 at the vertical by the cosines next to it, which follow
// at `near`. \param of  by number of a cosine
template <class Of>
double at_node(std::size_t number, std::size_t last, std::size_t near, std::size_t term, const Of& of) {
    if (term == 0 || term == 3 || number != last) return of(number);
    return 2.0 * of(near) - of(near + 1);
}

std::vector<AddingDoubling> modes_of(const TableMedium& medium, const std::vector<double>& mu) {
    std::vector<AddingDoubling> modes;
    for (int m = 0; m < kModes; ++m)
        modes.emplace_back(reference::Medium{medium.g, medium.albedo}, m, kStreams, mu);
    return modes;
}

std::vector<Layer> layers_of(const std::vector<AddingDoubling>& modes, double depth) {
    std::vector<Layer> layers;
    for (const AddingDoubling& mode : modes)
        layers.push_back(mode.layer(depth));
    return layers;
}

template <class Of>
void print_node(fmt::ostream& out, const Of& of) {
    out.print("{{{{");
    for (std::size_t term = 0; term < 4; ++term)
        out.print("{},", digits(of(term)));
    out.print("}}}},");
}

// Modes of the two phase functions of first_orders(), by node of both cosines.
class Peaks {
  public:
    Peaks(double g, const AddingDoubling& like) {
        const std::size_t n = like.mu().size();
        for (int m = 0; m < kModes; ++m) {
            for (int order = 1; order <= 2; ++order) {
                for (const bool turned : {false, true}) {
                    Matrix all(n);
                    for (std::size_t to = like.first_asked(); to < n; ++to) {
                        for (std::size_t from = like.first_asked(); from < n; ++from)
                            all(to, from) = henyey_greenstein_mode(std::pow(g, order), m, like.mu()[to],
                                                                   like.mu()[from], turned);
                    }
                    all_.push_back(std::move(all));
                }
            }
        }
    }
    [[nodiscard]] double at(int mode, int order, bool turned, std::size_t to, std::size_t from) const {
        return all_[static_cast<std::size_t>(mode * 4 + (order - 1) * 2 + (turned ? 1 : 0))](to, from);
    }

  private:
    std::vector<Matrix> all_;
};

// cos(m azimuth) over the polynomials of azimuth_modes().
double over_sines(int mode, double mu0, double mu) {
    const double sines = std::sqrt((1.0 - mu0 * mu0) * (1.0 - mu * mu));
    return (mode == 0 ? 1.0 : 2.0) / std::pow(sines, mode);
}

// Factors of azimuth_modes() and of the second order's phase function in light by modes.
std::array<double, 4> terms_of(const std::array<double, kModes>& light, const Peaks& peaks, bool turned,
                               const AddingDoubling& like, std::size_t to, std::size_t from) {
    const auto shape = [&](int mode) { return peaks.at(mode, 2, turned, to, from); };
    double by_peak = 0.0;
    // None where azimuth does not tell it.
    double peak = kUntold * kUntold * shape(0) * shape(0);
    for (int mode = kFirstPeaked; mode < kModes; ++mode) {
        by_peak += light[static_cast<std::size_t>(mode)] * shape(mode);
        peak += shape(mode) * shape(mode);
    }
    std::array<double, 4> terms{0.0, 0.0, 0.0, by_peak / peak};
    for (int mode = 0; mode < kFirstPeaked; ++mode) {
        const auto i = static_cast<std::size_t>(mode);
        terms[i] = (light[i] - terms[3] * shape(mode)) * over_sines(mode, like.mu()[from], like.mu()[to]);
    }
    return terms;
}

struct Leaving {
    bool above;
    double depth;
    double transport;
    const std::vector<Layer>* layers;  // by mode
};

// What leaves beyond the first orders, scaled as the table has it; cosines by number. Terms of
// leaving_terms().
std::array<double, 4> left_over(const AddingDoubling& like, const Peaks& peaks, const Leaving& leaving,
                                const TableMedium& medium, std::size_t in, std::size_t out) {
    const std::size_t from = like.first_asked() + in;
    const std::size_t to = like.first_asked() + out;
    const double mu0 = like.mu()[from];
    const double mu = like.mu()[to];
    const auto orders = first_orders(leaving.above, leaving.depth, mu0, mu, medium.albedo);
    const double passed = leaving.above ? 1.0 : passed_share(leaving.transport, medium.absorption);
    const double scale = 1.0 / (caught(leaving.depth, mu0, mu) * passed);
    std::array<double, kModes> left{};
    for (int mode = 0; mode < kModes; ++mode) {
        const auto i = static_cast<std::size_t>(mode);
        const Layer& layer = (*leaving.layers)[i];
        left[i] = scale * ((leaving.above ? layer.reflected : layer.transmitted)(to, from) -
                           orders[0] * peaks.at(mode, 1, leaving.above, to, from) -
                           orders[1] * peaks.at(mode, 2, leaving.above, to, from));
    }
    return terms_of(left, peaks, leaving.above, like, to, from);
}

void write_fluxes(fmt::ostream& out, const TableMedium& medium, const AddingDoubling& mean) {
    out.print("{{{{");
    for (std::size_t node = 0; node < LeavingTable::kDepths; ++node) {
        const double transport = medium.transport(node, LeavingTable::kDepths);
        const Layer layer = mean.layer(medium.depth(transport));
        out.print("{{{{\n");
        for (std::size_t a = 0; a < LeavingTable::kCosines; ++a) {
            const std::size_t from = mean.first_asked() + a;
            const double lost = -std::expm1(-medium.depth(transport) / mean.mu()[from]);
            out.print("{{{{{},{}}}}},", digits(mean.flux(layer.reflected, from) / lost),
                      digits(mean.flux(layer.transmitted, from) / lost /
                             passed_share(transport, medium.absorption)));
        }
        out.print("}}}},");
    }
    out.print("}}}},\n");
}

void write_leaving(fmt::ostream& out, const TableMedium& medium) {
    constexpr std::size_t kCosines = LeavingTable::kCosines;
    std::vector<double> mu;
    add_axis(kCosines, mu);
    mu.insert(mu.end(), kNearVertical.begin(), kNearVertical.end());
    const std::vector<AddingDoubling> modes = modes_of(medium, mu);
    const Peaks peaks(medium.g, modes[0]);
    out.print("{{");
    for (const bool above : {true, false}) {
        out.print("{{{{");
        for (std::size_t node = 0; node < LeavingTable::kDepths; ++node) {
            const double transport = medium.transport(node, LeavingTable::kDepths);
            const std::vector<Layer> layers = layers_of(modes, medium.depth(transport));
            const Leaving leaving{above, medium.depth(transport), transport, &layers};
            out.print("{{{{\n");
            for (std::size_t pair = 0, a = 0, b = 0; pair < LeavingTable::kPairs; ++pair) {
                print_node(out, [&](std::size_t term) {
                    return at_node(a, kCosines - 1, kCosines, term, [&](std::size_t in) {
                        return at_node(b, kCosines - 1, kCosines, term, [&](std::size_t to) {
                            return left_over(modes[0], peaks, leaving, medium, in, to)[term];
                        });
                    });
                });
                if (++b > a) {
                    ++a;
                    b = 0;
                    out.print("\n");
                }
            }
            out.print("}}}},");
        }
        out.print("}}}},\n");
    }
    write_fluxes(out, medium, modes[0]);
    out.print("}},\n");
}

// Depth above a node of PlaceAxis, in transport depth.
double place_above(std::size_t node, double transport) {
    const double wanted = static_cast<double>(node) / static_cast<double>(InsideTable::kPlaces - 1);
    double low = 0.0;
    double high = transport;
    for (int round = 0; round < 200; ++round) {
        const double middle = 0.5 * (low + high);
        (PlaceAxis::place(middle, transport - middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The source function at one place of one slab, by mode.
struct Inside {
    std::vector<Matrix> up;
    std::vector<Matrix> down;
    double above;
    double scale;
};

Inside inside_of(const std::vector<AddingDoubling>& modes, const TableMedium& medium, double over,
                 double under) {
    Inside inside{{}, {}, medium.depth(over), 1.0 / even_share(over, under)};
    for (const AddingDoubling& mode : modes) {
        const Layer upper = mode.layer(std::max(inside.above, 1e-7));
        const Layer lower = mode.layer(std::max(medium.depth(under), 1e-7));
        const Joint joint = mode.joint(upper, lower);
        inside.up.push_back(mode.source(joint, upper, true));
        inside.down.push_back(mode.source(joint, upper, false));
    }
    return inside;
}

// What the source function has beyond the first two orders.
std::array<double, 4> left_inside(const AddingDoubling& like, const Peaks& peaks, const Inside& inside,
                                  bool up, std::size_t in, std::size_t out) {
    const std::size_t from = like.first_asked() + in;
    const std::size_t to = like.first_asked() + out;
    const double slant = inside.above / like.mu()[from];
    const double once = std::exp(-slant) / (4.0 * like.mu()[from]);
    std::array<double, kModes> left{};
    for (int mode = 0; mode < kModes; ++mode) {
        const auto i = static_cast<std::size_t>(mode);
        left[i] = inside.scale *
                  ((up ? inside.up : inside.down)[i](to, from) -
                   once * (peaks.at(mode, 1, up, to, from) + slant * peaks.at(mode, 2, up, to, from)));
    }
    return terms_of(left, peaks, up, like, to, from);
}

void write_inside(fmt::ostream& out, const TableMedium& medium) {
    constexpr std::size_t kSources = InsideTable::kSources;
    constexpr std::size_t kHalf = InsideTable::kViews / 2;
    constexpr std::size_t kNear = kSources + kHalf + 1;
    std::vector<double> mu;
    add_axis(kSources, mu);
    add_axis(kHalf + 1, mu);
    mu.insert(mu.end(), kNearVertical.begin(), kNearVertical.end());
    const std::vector<AddingDoubling> modes = modes_of(medium, mu);
    const Peaks peaks(medium.g, modes[0]);
    std::vector<Inside> places;
    for (std::size_t node = 0; node < InsideTable::kDepths; ++node) {
        const double transport = medium.transport(node, InsideTable::kDepths);
        for (std::size_t place = 0; place < InsideTable::kPlaces; ++place) {
            const double over = place_above(place, transport);
            places.push_back(inside_of(modes, medium, over, transport - over));
        }
    }
    out.print("{{{{");
    for (std::size_t view = 0; view < InsideTable::kViews; ++view) {
        const bool up = view >= kHalf;
        const std::size_t number = kSources + (up ? view - kHalf : kHalf - view);
        out.print("{{{{");
        for (std::size_t source = 0; source < kSources; ++source) {
            out.print("{{{{");
            for (std::size_t place = 0; place < places.size(); ++place) {
                if (place % InsideTable::kPlaces == 0) out.print("{{{{\n");
                print_node(out, [&](std::size_t term) {
                    return at_node(source, kSources - 1, kNear, term, [&](std::size_t in) {
                        return at_node(number, kNear - 1, kNear, term, [&](std::size_t to) {
                            return left_inside(modes[0], peaks, places[place], up, in, to)[term];
                        });
                    });
                });
                if ((place + 1) % InsideTable::kPlaces == 0) out.print("}}}},");
            }
            out.print("}}}},\n");
        }
        out.print("}}}},\n");
    }
    out.print("}}}},\n");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: slab_table OUT_FOLDER\n", stderr);
        return 2;
    }
    try {
        const std::string folder = argv[1];
        auto leaving = fmt::output_file(folder + "/slab_leaving.inc");
        auto inside_table = fmt::output_file(folder + "/slab_inside.inc");
        for (const double g : TableMedia::kG) {
            for (const double absorption : TableMedia::kAbsorption)
                write_leaving(leaving, {g, TableMedia::albedo(g, absorption), absorption});
            write_inside(inside_table, {g, 1.0, 0.0});
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "slab_table: %s\n", error.what());
        return 1;
    }
}
