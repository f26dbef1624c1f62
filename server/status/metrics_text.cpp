#include "server/status/metrics_text.h"

#include <fmt/format.h>

#include <iterator>

namespace skyig::server::status {

void MetricsText::family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = name;
    fmt::format_to(std::back_inserter(text_), "# HELP {0} {1}\n# TYPE {0} {2}\n", name, help, type);
}

void MetricsText::sample_as(std::string_view ending, Labels labels, double value) {
    text_ += name_;
    text_ += ending;
    char before = '{';
    for (const auto& [label, text] : labels) {
        text_ += before;
        text_ += label;
        text_ += "=\"";
        add_escaped(text);
        text_ += '"';
        before = ',';
    }
    if (labels.size() > 0) text_ += '}';
    // The shortest text that reads back as the same number; "nan" and "inf" are words of the format too.
    fmt::format_to(std::back_inserter(text_), " {}\n", value);
}

void MetricsText::add_escaped(std::string_view value) {
    for (const char c : value) {
        if (c == '\n') {
            text_ += "\\n";
            continue;
        }
        if (c == '\\' || c == '"') text_ += '\\';
        text_ += c;
    }
}

}  // namespace skyig::server::status
