#include "clients/bench/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace skyig::clients::bench {

namespace {

constexpr double kWidth_px = 820.0;
constexpr double kHeight_px = 480.0;
constexpr double kLeft_px = 76.0;
constexpr double kRight_px = 648.0;
constexpr double kTop_px = 52.0;
constexpr double kBottom_px = 420.0;
constexpr double kLegend_px = 672.0;
constexpr double kLegendLine_px = 20.0;

// Told apart also by most colour-blind eyes, and dark and light enough for both backgrounds.
constexpr std::array<std::string_view, 8> kColours{"#d9730d", "#2f81f7", "#1a9a6c", "#c74fa0",
                                                   "#a98600", "#8a63d2", "#d1495b", "#7d8590"};

constexpr std::string_view kStyle =
    "<style>"
    "text{font:13px system-ui,'DejaVu Sans',sans-serif;fill:#1f2328}"
    ".paper{fill:#ffffff}.grid{stroke:#d8dee4;stroke-width:1}.frame{stroke:#6e7781;fill:none}"
    ".title{font-weight:600;font-size:15px}.shape{fill:#1f2328}"
    "@media(prefers-color-scheme:dark){text{fill:#e6edf3}.paper{fill:#0d1117}.grid{stroke:#30363d}"
    ".frame{stroke:#8b949e}.shape{fill:#e6edf3}}"
    "</style>\n";

struct Point {
    std::size_t series = 0;
    std::size_t model = 0;
    double cost = 0.0;
    double error = 0.0;
};

/// Holds all values with some room round them, and a factor of ten at least.
class LogAxis {
  public:
    LogAxis(double least, double most, double from_px, double to_px)
        : first_(std::log10(least) - kRoom),
          last_(std::log10(most) + kRoom),
          from_px_(from_px),
          to_px_(to_px) {
        const double missing = std::max(1.0 - (last_ - first_), 0.0);
        first_ -= 0.5 * missing;
        last_ += 0.5 * missing;
    }

    [[nodiscard]] double at_px(double value) const {
        return std::lerp(from_px_, to_px_, (std::log10(value) - first_) / (last_ - first_));
    }
    /// Powers of ten; with 2 and 5 times them where there would be few.
    [[nodiscard]] std::vector<double> ticks() const {
        const bool few = last_ - first_ < 2.0;
        std::vector<double> values;
        for (int power = static_cast<int>(std::floor(first_)); power <= last_; ++power) {
            for (const double multiple : {1.0, 2.0, 5.0}) {
                const double value = multiple * std::pow(10.0, power);
                const double place = std::log10(value);
                if ((few || multiple == 1.0) && place >= first_ && place <= last_) values.push_back(value);
            }
        }
        return values;
    }

  private:
    static constexpr double kRoom = 0.2;

    double first_;
    double last_;
    double from_px_;
    double to_px_;
};

struct Frame {
    LogAxis cost;
    LogAxis error;
};

std::string tick_label(double value) {
    return value >= 0.9e-4 && value < 1.1e6 ? fmt::format("{:.7g}", value) : fmt::format("{:.0e}", value);
}

std::vector<Point> points_of(const Report& report, const Plot& plot) {
    std::vector<Point> points;
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        std::vector<Point> line;
        for (std::size_t m = 0; m < report.models.size(); ++m) {
            const ErrorEntry* error = find_error(report.models[m], plot.series[s].quantity, plot.cases);
            const CostEntry* cost = find_cost(report.models[m], plot.series[s].cost);
            if (!error || !cost || !(error->figures.max > 0.0) || !(cost->ns.median > 0.0)) continue;
            line.push_back({s, m, cost->ns.median, error->figures.max});
        }
        std::sort(line.begin(), line.end(), [](const Point& a, const Point& b) { return a.cost < b.cost; });
        points.insert(points.end(), line.begin(), line.end());
    }
    return points;
}

Frame frame_of(const std::vector<Point>& points) {
    const auto by_cost = [](const Point& a, const Point& b) { return a.cost < b.cost; };
    const auto by_error = [](const Point& a, const Point& b) { return a.error < b.error; };
    const auto cost = std::minmax_element(points.begin(), points.end(), by_cost);
    const auto error = std::minmax_element(points.begin(), points.end(), by_error);
    return {LogAxis(cost.first->cost, cost.second->cost, kLeft_px, kRight_px),
            LogAxis(error.first->error, error.second->error, kBottom_px, kTop_px)};
}

void put_text(std::string& svg, double x_px, double y_px, std::string_view attributes,
              std::string_view text) {
    fmt::format_to(std::back_inserter(svg), "<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x_px, y_px,
                   attributes, xml_escaped(text));
}

std::string opening(const std::string& label) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "role=\"img\" aria-label=\"{2}\">\n{3}<rect class=\"paper\" width=\"{0}\" height=\"{1}\" "
        "rx=\"6\"/>\n",
        kWidth_px, kHeight_px, xml_escaped(label), kStyle);
}

void put_axis_names(std::string& svg, const std::string& x, const std::string& y) {
    put_text(svg, 0.5 * (kLeft_px + kRight_px), kBottom_px + 44.0, " text-anchor=\"middle\"", x);
    put_text(svg, 0.0, 0.0,
             fmt::format(" text-anchor=\"middle\" transform=\"translate(20 {}) rotate(-90)\"",
                         0.5 * (kTop_px + kBottom_px)),
             y);
}

void put_frame(std::string& svg) {
    fmt::format_to(std::back_inserter(svg),
                   "<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", kLeft_px,
                   kTop_px, kRight_px - kLeft_px, kBottom_px - kTop_px);
}

/// A colour beside its label, in the `place`th line of the legend.
void put_key(std::string& svg, std::size_t place, std::string_view colour, const std::string& label) {
    const double y_px = kTop_px + 10.0 + kLegendLine_px * static_cast<double>(place);
    fmt::format_to(std::back_inserter(svg),
                   "<line x1=\"{0}\" y1=\"{2:.1f}\" x2=\"{1}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
                   "stroke-width=\"4\"/>\n",
                   kLegend_px, kLegend_px + 16.0, y_px, colour);
    put_text(svg, kLegend_px + 24.0, y_px + 4.5, "", label);
}

void put_line(std::string& svg, double x1_px, double y1_px, double x2_px, double y2_px) {
    fmt::format_to(std::back_inserter(svg),
                   "<line class=\"grid\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", x1_px,
                   y1_px, x2_px, y2_px);
}

void put_grid(std::string& svg, const Frame& frame) {
    for (const double value : frame.cost.ticks()) {
        const double x_px = frame.cost.at_px(value);
        put_line(svg, x_px, kTop_px, x_px, kBottom_px);
        put_text(svg, x_px, kBottom_px + 20.0, " text-anchor=\"middle\"", tick_label(value));
    }
    for (const double value : frame.error.ticks()) {
        const double y_px = frame.error.at_px(value);
        put_line(svg, kLeft_px, y_px, kRight_px, y_px);
        put_text(svg, kLeft_px - 8.0, y_px + 4.5, " text-anchor=\"end\"", tick_label(value));
    }
    put_frame(svg);
}

/// The model's shape round (x, y); `attributes` colour it.
std::string shape(std::size_t model, double x, double y, std::string_view attributes) {
    constexpr double r = 5.5;
    constexpr double d = 4.8;
    switch (model % 5) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"{}/>", x, y, r, attributes);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"{}/>", x - d, y - d,
                               2 * d, 2 * d, attributes);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}h{}z\"{}/>", x, y - r - 1.0, r + 0.8, 2 * r,
                               -2 * (r + 0.8), attributes);
        case 3:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}l{} {}l{} {}z\"{}/>", x, y - r - 1.5, r + 1.5,
                               r + 1.5, -r - 1.5, r + 1.5, -r - 1.5, -r - 1.5, attributes);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}h{}z\"{}/>", x, y + r + 1.0, r + 0.8, -2 * r,
                               -2 * (r + 0.8), attributes);
    }
}

void put_points(std::string& svg, const Report& report, const Plot& plot, const std::vector<Point>& points,
                const Frame& frame) {
    const auto out = std::back_inserter(svg);
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        const std::string_view colour = kColours[s % kColours.size()];
        std::string line;
        std::string shapes;
        for (const Point& point : points) {
            if (point.series != s) continue;
            const double x = frame.cost.at_px(point.cost);
            const double y = frame.error.at_px(point.error);
            line += fmt::format("{:.1f},{:.1f} ", x, y);
            shapes +=
                fmt::format("<g><title>{}</title>{}</g>\n",
                            xml_escaped(fmt::format("{}, {}: {} ns, {}", report.models[point.model].name,
                                                    plot.series[s].label, short_number(point.cost),
                                                    short_number(point.error))),
                            shape(point.model, x, y, fmt::format(" fill=\"{}\"", colour)));
        }
        if (line.empty()) continue;
        line.pop_back();
        fmt::format_to(out,
                       "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
                       "stroke-opacity=\"0.6\"/>\n{}",
                       line, colour, shapes);
    }
}

void put_legend(std::string& svg, const Report& report, const Plot& plot) {
    for (std::size_t s = 0; s < plot.series.size(); ++s)
        put_key(svg, s, kColours[s % kColours.size()], plot.series[s].label);
    double y_px = kTop_px + 10.0 + kLegendLine_px * static_cast<double>(plot.series.size() + 1);
    for (std::size_t m = 0; m < report.models.size(); ++m, y_px += kLegendLine_px) {
        svg += shape(m, kLegend_px + 8.0, y_px, " class=\"shape\"") + '\n';
        put_text(svg, kLegend_px + 24.0, y_px + 4.5, "", report.models[m].name);
    }
}

/// The unit of the first error that the plot shows.
std::string unit_of(const Report& report, const Plot& plot) {
    for (const ModelEntry& model : report.models) {
        for (const PlotSeries& series : plot.series) {
            if (const ErrorEntry* error = find_error(model, series.quantity, plot.cases)) return error->unit;
        }
    }
    return {};
}

}  // namespace

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string to_svg(const Report& report, const Plot& plot) {
    std::string svg = opening(plot.title);
    put_text(svg, kLeft_px, 30.0, " class=\"title\"", fmt::format("{}, {}", plot.title, plot.cases));
    const std::vector<Point> points = points_of(report, plot);
    if (points.empty()) {
        put_text(svg, kLeft_px, kTop_px + 30.0, "", "nothing to draw: every error is zero or unknown");
        return svg + "</svg>\n";
    }
    const Frame frame = frame_of(points);
    put_grid(svg, frame);
    put_axis_names(svg, "cost of a call, ns", fmt::format("largest error, {}", unit_of(report, plot)));
    put_points(svg, report, plot, points, frame);
    put_legend(svg, report, plot);
    return svg + "</svg>\n";
}

std::string to_svg(const CurvePlot& plot) {
    std::string svg = opening(plot.title);
    put_text(svg, kLeft_px, 30.0, " class=\"title\"", plot.title);
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const Curve& curve : plot.curves) {
        for (const Curve::Point& point : curve.points) {
            if (point.x > 0.0) least = std::min(least, point.x);
            most = std::max(most, point.x);
        }
    }
    if (!(least <= most)) return svg + "</svg>\n";
    const LogAxis x(least, most, kLeft_px, kRight_px);
    const auto y_px = [](double value) { return std::lerp(kBottom_px, kTop_px, value); };
    for (const double value : x.ticks()) {
        put_line(svg, x.at_px(value), kTop_px, x.at_px(value), kBottom_px);
        put_text(svg, x.at_px(value), kBottom_px + 20.0, " text-anchor=\"middle\"", tick_label(value));
    }
    for (const double value : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        put_line(svg, kLeft_px, y_px(value), kRight_px, y_px(value));
        put_text(svg, kLeft_px - 8.0, y_px(value) + 4.5, " text-anchor=\"end\"", fmt::format("{:g}", value));
    }
    put_frame(svg);
    put_axis_names(svg, plot.x, plot.y);
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const std::string_view colour = kColours[i % kColours.size()];
        std::string line;
        for (const Curve::Point& point : plot.curves[i].points) {
            if (point.x > 0.0)
                line += fmt::format("{:.1f},{:.1f} ", x.at_px(point.x), y_px(std::clamp(point.y, 0.0, 1.0)));
        }
        fmt::format_to(std::back_inserter(svg),
                       "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", line,
                       colour);
        put_key(svg, i, colour, plot.curves[i].label);
    }
    return svg + "</svg>\n";
}

}  // namespace skyig::clients::bench
