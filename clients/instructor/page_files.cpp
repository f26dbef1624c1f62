#include "clients/instructor/page_files.h"

#include <memory>
#include <string>

namespace skyig::clients::instructor {

namespace {

/// Nothing from elsewhere, no frame around it.
constexpr std::string_view kPolicy =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'\r\n"
    "Referrer-Policy: no-referrer\r\n";

std::string_view content_type(std::string_view file) noexcept {
    if (file.ends_with(".html")) return "text/html; charset=utf-8";
    if (file.ends_with(".js")) return "text/javascript; charset=utf-8";
    return "text/css; charset=utf-8";
}

}  // namespace

server::status::HttpAnswer page_answer(std::string_view path) {
    const std::string_view file = path == "/" ? "index.html" : path.substr(1);
    const auto text = page_file(file);
    if (!text) return server::status::line_answer(404, "there is no such page; / is the station");
    server::status::HttpAnswer answer;
    answer.content_type = content_type(file);
    answer.body = std::make_shared<const std::string>(*text);
    answer.more_fields = kPolicy;
    return answer;
}

}  // namespace skyig::clients::instructor
