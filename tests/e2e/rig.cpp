#include "tests/e2e/rig.h"

#include <algorithm>
#include <sstream>

namespace skyig::tests {

std::string Rig::settings(const std::optional<std::string>& start_utc, const std::string& host_owns,
                          const std::string& instructor_owns) const {
    const auto local = [](std::uint16_t port) { return "\"127.0.0.1:" + std::to_string(port) + "\"\n"; };
    std::string text = "version = 1\n[daemon]\nrate_hz = 60\n[host]\nlisten = " + local(host_port);
    text += "reply_to = " + local(reply_port) + "lost_after_s = 0.4\nowns = " + host_owns + "\n";
    text += "[[source]]\nname = \"instructor\"\nkind = \"cigi\"\nlisten = " + local(instructor_port);
    text += "owns = " + instructor_owns + "\n";
    if (start_utc) text += "[start]\nutc = \"" + *start_utc + "\"\n";
    return text + channel_toml("only", 64, 48, 0);
}

Replayed replay(const std::string& daemon, const std::string& config_path, const std::string& recording,
                const std::vector<std::string>& more, std::chrono::seconds limit) {
    const ScratchDirectory scratch;
    std::vector<std::string> command{daemon,
                                     "--config",
                                     config_path,
                                     "--replay",
                                     recording,
                                     "--hashes",
                                     scratch.file("hashes"),
                                     "--events",
                                     scratch.file("events"),
                                     "--report",
                                     scratch.file("report")};
    command.insert(command.end(), more.begin(), more.end());
    Replayed out;
    out.finished = Process(command).wait(limit);
    out.hashes = read_text(scratch.file("hashes"));
    out.events = read_text(scratch.file("events"));
    out.report = read_text(scratch.file("report"));
    return out;
}

std::string events_of_frames(const std::string& events) {
    std::istringstream in(events);
    std::string out;
    for (std::string line; std::getline(in, line);)
        if (!line.starts_with("0 ") && line.find(" recorded with ") == std::string::npos) out += line + '\n';
    return out;
}

long line_count(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

}  // namespace skyig::tests
