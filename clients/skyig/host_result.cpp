#include "clients/skyig/host_result.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

namespace skyig::clients {

std::string to_text(const HostResult& result) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "flown           {}: {:.1f} s, {} messages at {:g} Hz, {} late{}\n", result.flight,
                   result.flown_s, result.messages, result.rate_hz, result.late_messages,
                   result.complete ? "" : ", interrupted");
    fmt::format_to(out, "answers         {}: CIGI {}, mode {}, database {}\n", result.to, result.version,
                   result.mode, result.database_number);
    fmt::format_to(out, "Start of Frame  {} received, {:.1f} a second, {} lost, {} restarts\n",
                   result.answers, result.answer_rate_hz, result.answers_lost, result.restarts);
    fmt::format_to(out, "round trip      p50 {} frames, {:.1f} ms; p99 {} frames, {:.1f} ms\n",
                   result.round_trip_frames_p50, result.round_trip_p50_ms, result.round_trip_frames_p99,
                   result.round_trip_p99_ms);
    return text;
}

std::string to_json(const HostResult& result) {
    nlohmann::ordered_json json;
    json["flight"] = result.flight;
    json["flown_s"] = result.flown_s;
    json["complete"] = result.complete;
    json["rate_hz"] = result.rate_hz;
    json["messages"] = result.messages;
    json["late_messages"] = result.late_messages;
    json["answers"] = {{"from", result.to},
                       {"version", result.version},
                       {"mode", result.mode},
                       {"database_number", result.database_number},
                       {"start_of_frame", result.answers},
                       {"lost", result.answers_lost},
                       {"restarts", result.restarts},
                       {"rate_hz", result.answer_rate_hz}};
    json["round_trip"] = {{"p50_frames", result.round_trip_frames_p50},
                          {"p99_frames", result.round_trip_frames_p99},
                          {"p50_ms", result.round_trip_p50_ms},
                          {"p99_ms", result.round_trip_p99_ms}};
    return json.dump(2) + '\n';
}

}  // namespace skyig::clients
