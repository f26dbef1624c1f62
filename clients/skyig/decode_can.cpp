#include "clients/skyig/decode_can.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "protocol/recording/candump.h"

namespace skyig::clients {

namespace can = protocol::canaerospace;
namespace recording = protocol::recording;

namespace {

using Json = nlohmann::ordered_json;

struct Words {
    std::string name;
    std::string unit;
};

std::string parameter_name(const can::Message& message) {
    std::string name(message.entry->name);
    if (const std::size_t at = name.find('#'); at != std::string::npos)
        name.replace(at, 1, message.has_header ? std::to_string(message.service_code) : "?");
    if (message.is(can::DataType::kDoubleH)) name += " (high word)";
    return name;
}

Words service_words(const can::Message& message) {
    constexpr std::uint8_t kIdentification = 0;
    constexpr std::uint8_t kSynchronization = 1;
    std::string service(can::service_name(message.service_code));
    if (service.empty()) service = fmt::format("service {}", message.service_code);
    if (message.is_reply()) {
        const bool identifies = message.service_code == kIdentification && message.is(can::DataType::kUChar4);
        return {fmt::format("{} reply of node {}", service, message.node),
                identifies ? "hw,sw,distribution,header" : ""};
    }
    const bool stamps = message.service_code == kSynchronization;
    const std::string to =
        message.node == 0 ? std::string("(broadcast)") : fmt::format("to node {}", message.node);
    return {fmt::format("{} {} {}", service, stamps ? "time stamp" : "request", to),
            stamps ? "user defined" : ""};
}

/// Name and unit of what the frame is about; none if that cannot be told.
std::optional<Words> words_of(const can::Reading& reading) {
    const can::Message& message = reading.message;
    const bool speaks = outcome_of(reading.reason) != can::Outcome::kBusError &&
                        reading.reason != can::Reason::kIdentifier && reading.reason != can::Reason::kFd;
    if (!speaks) return std::nullopt;
    if (message.entry != nullptr) {
        const bool typed = message.has_header && message.type_code < can::kDataTypes;
        const auto type = typed ? static_cast<can::DataType>(message.type_code) : can::DataType::kNoData;
        return Words{parameter_name(message), std::string(message.entry->unit_of(type))};
    }
    if (message.range == can::Range::kEmergency) return Words{"emergency event", "location,operation,code"};
    if (message.is_service() && message.has_header) return service_words(message);
    return std::nullopt;
}

Json value_json(const can::Value& value) {
    switch (value.kind) {
        case can::Value::Kind::kNone:
            return nullptr;
        case can::Value::Kind::kReal:
            return value.number;
        case can::Value::Kind::kInteger:
            return value.items[0];
        case can::Value::Kind::kText: {
            std::string text;
            for (std::size_t i = 0; i < value.count; ++i)
                text += static_cast<char>(value.items[i]);
            return text;
        }
        case can::Value::Kind::kList:
            break;
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < value.count; ++i)
        list.push_back(value.items[i]);
    return list;
}

/// One rounding alone, so that it compares equal to the digits of the log.
double seconds(std::int64_t time_ns) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    return static_cast<double>(time_ns / kSecond_ns) + static_cast<double>(time_ns % kSecond_ns) / 1e9;
}

void add_header(Json& json, const can::Message& message) {
    json["extended"] = message.extended;
    json["redundancy"] = message.channel;
    const auto or_null = [&message](auto value) { return message.has_header ? Json(value) : Json(nullptr); };
    json["node"] = or_null(message.node);
    if (message.has_header && message.type_code < can::kDataTypes) {
        json["type"] = can::type_name(static_cast<can::DataType>(message.type_code));
    } else {
        json["type"] = or_null(message.type_code);
    }
    json["service_code"] = or_null(message.service_code);
    json["message_code"] = or_null(message.message_code);
    json["dlc"] = message.dlc;
    if (message.is(can::DataType::kDoubleH)) json["pair"] = "high";
    if (message.is(can::DataType::kDoubleL)) json["pair"] = "low";
}

std::string to_json(std::uint64_t line, const recording::CandumpLine& source, const can::Reception& got) {
    const can::Reading& reading = got.reading;
    const bool is_error = got.outcome() == can::Outcome::kBusError;
    const std::optional<Words> words = words_of(reading);
    Json json;
    json["line"] = line;
    json["id"] = is_error ? source.frame.id : std::uint32_t{reading.message.id};
    json["outcome"] = can::outcome_name(got.outcome());
    json["reason"] =
        reading.reason == can::Reason::kNone ? Json(nullptr) : Json(can::reason_name(reading.reason));
    json["name"] = words ? Json(words->name) : Json(nullptr);
    json["unit"] = words ? Json(words->unit) : Json(nullptr);
    json["value"] = value_json(reading.value);
    json["t"] = seconds(source.frame.received_ns);
    json["interface"] = source.interface;
    if (!is_error) add_header(json, reading.message);
    json["published"] = got.published;
    if (got.published && got.update.held_layers != 0) {
        Json held = Json::array();
        for (unsigned layer = 0; layer < can::kCloudLayers; ++layer) {
            if ((got.update.held_layers >> layer & 1U) != 0) held.push_back(layer);
        }
        json["held_layers"] = held;
    }
    return json.dump(-1, ' ', true);
}

std::string to_text(std::uint64_t line, const recording::CandumpLine& source, const can::Reception& got) {
    const can::Reading& reading = got.reading;
    const can::Message& message = reading.message;
    const std::optional<Words> words = words_of(reading);
    std::string text = fmt::format("{:>6} {:.6f} {:<6} {:>4}", line, seconds(source.frame.received_ns),
                                   source.interface, message.id);
    text += message.channel > 0 ? fmt::format(" channel {}", message.channel) : std::string();
    text += words ? fmt::format("  {}", words->name) : std::string();
    if (reading.reason != can::Reason::kNone)
        return text + fmt::format("  [{}: {}] {}", can::outcome_name(got.outcome()),
                                  can::reason_name(reading.reason), can::reason_text(reading.reason));
    const Json value = value_json(reading.value);
    if (!value.is_null()) text += fmt::format(" = {}", value.dump());
    if (words && !words->unit.empty() && !value.is_null()) text += fmt::format(" {}", words->unit);
    return text;
}

}  // namespace

can::Receiver* CanLogDecoder::receiver_of(std::string_view interface) {
    const auto found = receivers_.find(interface);
    if (found != receivers_.end()) return &found->second;
    if (receivers_.size() == kMostInterfaces) return nullptr;
    return &receivers_.try_emplace(std::string(interface)).first->second;
}

std::optional<CanLogDecoder::Line> CanLogDecoder::decode(std::string_view line) {
    ++line_;
    if (recording::is_blank_or_comment(line)) return std::nullopt;
    const auto parsed = recording::parse_candump(line);
    if (!parsed) return Line{recording::describe(parsed.error(), name_, line_), true};
    can::Receiver* receiver = receiver_of(parsed->interface);
    if (receiver == nullptr)
        return Line{
            fmt::format("{}:{}: more than {} interfaces in one log; split it", name_, line_, kMostInterfaces),
            true};
    const can::Reception reception = receiver->receive(parsed->frame);
    return Line{json_ ? to_json(line_, *parsed, reception) : to_text(line_, *parsed, reception)};
}

std::string CanLogDecoder::summary() const {
    std::uint64_t frames = 0;
    std::map<can::Outcome, std::uint64_t> outcomes;
    std::uint64_t lost = 0;
    for (const auto& [interface, receiver] : receivers_) {
        const can::Counters& counters = receiver.counters();
        frames += counters[can::Event::kFrames];
        lost += counters[can::Event::kLost];
        for (const can::Outcome outcome :
             {can::Outcome::kAccept, can::Outcome::kReject, can::Outcome::kIgnore, can::Outcome::kDuplicate,
              can::Outcome::kStale, can::Outcome::kBusError})
            outcomes[outcome] += counters[outcome];
    }
    std::string text = fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
    const char* separator = ": ";
    for (const auto& [outcome, count] : outcomes) {
        if (count == 0) continue;
        text += fmt::format("{}{} {}", separator, count, can::outcome_name(outcome));
        separator = ", ";
    }
    return lost > 0 ? text + fmt::format("; {} messages missing by their codes", lost) : text;
}

int run_decode_can(const DecodeOptions& options) {
    const bool from_stdin = options.can_path == "-";
    std::ifstream file;
    if (!from_stdin) {
        file.open(options.can_path, std::ios::binary);
        // A folder can be opened and shows only when it is read; an empty log is no fault.
        file.peek();
        if (file.bad() || !file.is_open()) {
            fmt::print(stderr, "skyig: {}: cannot be read; give a log of candump -L\n", options.can_path);
            return 1;
        }
        file.clear();
    }
    std::istream& in = from_stdin ? std::cin : file;
    CanLogDecoder decoder(from_stdin ? "standard input" : options.can_path, options.json);
    bool failed = false;
    for (std::string text; std::getline(in, text);) {
        const std::optional<CanLogDecoder::Line> line = decoder.decode(text);
        if (!line) continue;
        failed = failed || line->is_error;
        if (line->is_error) {
            fmt::print(stderr, "skyig: {}\n", line->text);
        } else {
            fmt::print("{}\n", line->text);
        }
    }
    if (in.bad()) {
        fmt::print(stderr, "skyig: {}: reading stopped by an error\n", options.can_path);
        failed = true;
    }
    if (!options.json) fmt::print("{}\n", decoder.summary());
    return failed ? 1 : 0;
}

}  // namespace skyig::clients
