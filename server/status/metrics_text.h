// Writes Prometheus' text format 0.0.4: families with HELP and TYPE, samples with labels.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace skyig::server::status {

class MetricsText {
  public:
    using Label = std::pair<std::string_view, std::string_view>;
    using Labels = std::initializer_list<Label>;

    /// All samples up to the next family belong to it. `type`: "counter", "gauge", "histogram".
    void family(std::string_view name, std::string_view type, std::string_view help);
    void sample(Labels labels, double value) { sample_as({}, labels, value); }
    void sample(double value) { sample_as({}, {}, value); }
    /// Of a name with an ending: "_bucket", "_sum", "_count".
    void sample_as(std::string_view ending, Labels labels, double value);

    [[nodiscard]] std::string take() && { return std::move(text_); }

  private:
    void add_escaped(std::string_view value);

    std::string text_;
    std::string name_;
};

}  // namespace skyig::server::status
