#include "clients/instructor/admission.h"

#include <algorithm>

namespace skyig::clients::instructor {

namespace {

using server::status::field;
using server::status::HttpRequest;

/// "http://NAME:PORT" without its scheme; empty for any other shape.
std::string_view origin_host(std::string_view origin) noexcept {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (origin.starts_with(scheme)) return origin.substr(scheme.size());
    }
    return {};
}

/// Takes as long wherever they differ.
bool same_secret(std::string_view given, std::string_view wanted) noexcept {
    unsigned different = given.size() == wanted.size() ? 0U : 1U;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        different |= static_cast<unsigned char>((i < given.size() ? given[i] : '\0') ^ wanted[i]);
    return different == 0;
}

std::string_view query_value(std::string_view query, std::string_view key) noexcept {
    while (!query.empty()) {
        const std::size_t end = std::min(query.find('&'), query.size());
        const std::string_view pair = query.substr(0, end);
        if (pair.starts_with(key) && pair.size() > key.size() && pair[key.size()] == '=')
            return pair.substr(key.size() + 1);
        query.remove_prefix(std::min(end + 1, query.size()));
    }
    return {};
}

}  // namespace

Refusal check_host(const HttpRequest& request, const AdmissionRules& rules) {
    if (!rules.loopback && !rules.token.empty()) return Refusal::kNone;
    // Browsers write names small, however they were given here.
    const auto named = [&](const std::string& name) { return server::status::same_word(name, request.host); };
    const bool ours = !request.host.empty() && (server::status::is_local_name(request.host) ||
                                                std::any_of(rules.names.begin(), rules.names.end(), named));
    return ours ? Refusal::kNone : Refusal::kHost;
}

Refusal check_upgrade(const HttpRequest& request, const AdmissionRules& rules) {
    if (const Refusal refusal = check_host(request, rules); refusal != Refusal::kNone) return refusal;
    const std::string_view origin = origin_host(field(request, "origin"));
    if (origin.empty() || origin != field(request, "host")) return Refusal::kOrigin;
    if (!rules.token.empty() && !same_secret(query_value(request.query, "token"), rules.token))
        return Refusal::kToken;
    return Refusal::kNone;
}

}  // namespace skyig::clients::instructor
