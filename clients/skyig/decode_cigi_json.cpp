#include <nlohmann/json.hpp>

#include "clients/skyig/decode_cigi.h"

namespace skyig::clients {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const CigiValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    return nullptr;
}

Json name_or_null(std::string_view name) {
    if (name.empty()) return nullptr;
    return std::string(name);
}

std::string_view outcome_name(CigiOutcome outcome) {
    switch (outcome) {
        case CigiOutcome::kAccept:
            return "accept";
        case CigiOutcome::kPartial:
            return "partial";
        case CigiOutcome::kDrop:
            break;
    }
    return "drop";
}

Json json_of(const CigiPacket& packet) {
    Json fields = Json::object();
    for (const CigiField& field : packet.fields)
        fields[std::string(field.name)] = json_of(field.value);
    return {{"packet", packet.name}, {"offset", packet.offset}, {"fields", std::move(fields)}};
}

}  // namespace

std::string to_json(const CigiDatagram& datagram) {
    Json json;
    json["cigi"] = name_or_null(datagram.version);
    json["byte_order"] = name_or_null(datagram.byte_order);
    json["outcome"] = outcome_name(datagram.outcome);
    json["reason"] = name_or_null(datagram.reason);
    json["packets"] = Json::array();
    for (const CigiPacket& packet : datagram.packets)
        json["packets"].push_back(json_of(packet));
    json["skipped_unknown"] = datagram.skipped.size();
    json["ignored"] = Json::array();
    for (const CigiIgnored& packet : datagram.ignored)
        json["ignored"].push_back({{"packet", packet.name}, {"reason", packet.reason}});
    // A text is octets; what is no UTF-8 among them becomes U+FFFD.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace skyig::clients
