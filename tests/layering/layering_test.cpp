// Reads every source file of the tree and fails on an include or a call that the house rules do not allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct SourceFile {
    std::string path;  // relative to the root, with forward slashes
    std::string text;
};

const std::vector<std::string> kRooms{"protocol", "config", "server", "render", "clients"};

// Who may include whom, beside itself.
const std::map<std::string, std::set<std::string>> kAllowed{
    {"protocol", {}},
    {"config", {}},
    {"render", {}},
    {"server", {"protocol", "config", "render"}},
    {"clients", {"protocol", "config", "render", "server"}},
};

std::vector<SourceFile> read_sources() {
    std::vector<SourceFile> files;
    const fs::path root = SKYIG_SOURCE_DIR;
    for (const std::string& room : kRooms) {
        for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream in(entry.path());
            std::ostringstream text;
            text << in.rdbuf();
            files.push_back({fs::relative(entry.path(), root).generic_string(), text.str()});
        }
    }
    return files;
}

std::string first_folder(const std::string& path) {
    return path.substr(0, path.find('/'));
}

std::vector<std::string> includes_of(const std::string& text) {
    static const std::regex kInclude(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re", std::regex::multiline);
    std::vector<std::string> out;
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it)
        out.push_back((*it)[1]);
    return out;
}

// Comments may speak of what code may not do.
std::string without_comments(const std::string& text) {
    return std::regex_replace(text, std::regex(R"(//[^\n]*)"), "");
}

/// The rule that this include breaks, or an empty string.
std::string broken_rule(const std::string& path, const std::string& include) {
    const std::string from = first_folder(path);
    const std::string to = first_folder(include);
    const bool ours =
        std::find(kRooms.begin(), kRooms.end(), to) != kRooms.end() && include.find('/') != std::string::npos;
    if (ours && to != from && !kAllowed.at(from).contains(to)) return from + " may not include " + to;
    if (to == "tests") return "nothing outside tests may include tests";
    if (to == "epoxy" && !path.starts_with("render/gl/")) return "only render/gl may include epoxy";
    if (include == "iostream" && from != "clients") return "iostream belongs to clients alone";
    return "";
}

TEST(Layering, IncludesFollowTheDrawnArrows) {
    const auto files = read_sources();
    ASSERT_GT(files.size(), 40U);
    for (const SourceFile& file : files) {
        for (const std::string& include : includes_of(file.text)) {
            EXPECT_EQ(broken_rule(file.path, include), "") << file.path << " includes " << include;
        }
    }
}

TEST(Layering, RulesCatchEachForbiddenArrow) {
    EXPECT_NE(broken_rule("protocol/cigi/message.cpp", "server/clock.h"), "");
    EXPECT_NE(broken_rule("protocol/cigi/message.cpp", "config/config.h"), "");
    EXPECT_NE(broken_rule("config/config.cpp", "protocol/result.h"), "");
    EXPECT_NE(broken_rule("render/plan.cpp", "server/world/world.h"), "");
    EXPECT_NE(broken_rule("render/plan.cpp", "config/config.h"), "");
    EXPECT_NE(broken_rule("render/renderer.cpp", "epoxy/gl.h"), "");
    EXPECT_NE(broken_rule("server/log.cpp", "iostream"), "");
    EXPECT_NE(broken_rule("server/log.cpp", "tests/data.h"), "");
    EXPECT_EQ(broken_rule("server/frame_loop.cpp", "render/renderer.h"), "");
    EXPECT_EQ(broken_rule("render/gl/draw.cpp", "epoxy/gl.h"), "");
    EXPECT_EQ(broken_rule("clients/skyig/main.cpp", "protocol/cigi/packets.h"), "");
}

TEST(Layering, OnlyClocksAndSocketsAskForTheTime) {
    const std::regex now(R"(\bnow\s*\(\)|clock_gettime|gettimeofday|\btime\s*\(\s*(NULL|nullptr|0)\s*\))");
    for (const SourceFile& file : read_sources()) {
        if (file.path == "server/clock.cpp" || file.path.starts_with("protocol/transport/")) continue;
        std::smatch match;
        const std::string code = without_comments(file.text);
        // Asking the one Clock that is handed in is what everyone should do.
        const std::string asked =
            std::regex_replace(code, std::regex(R"((clock_?|clock\(\))(\.|->)\w*now\w*\s*\(\))"), "");
        EXPECT_FALSE(std::regex_search(asked, match, now))
            << file.path << " asks for the time by " << match.str();
    }
}

TEST(Layering, NobodyCallsTheCAllocator) {
    const std::regex allocator(R"(\b(malloc|calloc|realloc|strdup)\s*\()");
    for (const SourceFile& file : read_sources()) {
        EXPECT_FALSE(std::regex_search(without_comments(file.text), allocator)) << file.path;
    }
}

TEST(Layering, FilesStaySmall) {
    for (const SourceFile& file : read_sources()) {
        const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
        EXPECT_LE(lines, 500) << file.path;
    }
}

}  // namespace
