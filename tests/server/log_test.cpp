#include "server/log.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace skyig::server {
namespace {

using testing::ElementsAre;

struct Kept {
    ManualClock clock;
    std::vector<std::string> lines;
    Log log{clock, [this](Severity, std::string_view line) { lines.emplace_back(line); }, Severity::kInfo};
};

/// Standard error for as long as it lives: a pipe whose other end the test holds.
class PipeForStderr {
  public:
    PipeForStderr() : saved_(::dup(STDERR_FILENO)) {
        EXPECT_EQ(::pipe2(ends_, O_NONBLOCK), 0);
        ::dup2(ends_[1], STDERR_FILENO);
    }
    ~PipeForStderr() {
        ::dup2(saved_, STDERR_FILENO);
        ::close(saved_);
        ::close(ends_[1]);
        close_reader();
    }
    PipeForStderr(const PipeForStderr&) = delete;
    PipeForStderr& operator=(const PipeForStderr&) = delete;
    PipeForStderr(PipeForStderr&&) = delete;
    PipeForStderr& operator=(PipeForStderr&&) = delete;

    void fill() const {
        const std::string block(4096, 'x');
        while (::write(ends_[1], block.data(), block.size()) > 0) {
        }
        // From now on a write would wait, as on a terminal that has been stopped.
        ::fcntl(ends_[1], F_SETFL, 0);
    }
    void close_reader() {
        if (ends_[0] >= 0) ::close(ends_[0]);
        ends_[0] = -1;
    }

  private:
    int saved_;
    int ends_[2] = {-1, -1};
};

TEST(Log, StderrThatNobodyReadsLosesLinesAndHoldsNobodyUp) {
    ManualClock clock;
    Log log(clock);
    const PipeForStderr pipe;
    pipe.fill();
    for (int i = 0; i < 100; ++i)
        log.error("line {}", i);  // would wait for ever
}

TEST(Log, WritesWhatIsImportantEnough) {
    ManualClock clock;
    std::vector<std::string> lines;
    Log log(
        clock,
        [&](Severity severity, std::string_view line) {
            lines.push_back(fmt::format("{}{}", static_cast<int>(severity), line));
        },
        Severity::kWarning);
    log.error("a {}", 1);
    log.warning("b");
    log.notice("c");
    log.info("d");
    EXPECT_THAT(lines, ElementsAre("3a 1", "4b"));
}

TEST(Log, LimitedLinesComeOnceInTheirIntervalWithACountOfTheRest) {
    Kept kept;
    for (int i = 0; i < 100; ++i) {
        kept.log.limited("loss", 10.0, Severity::kWarning, "lost {}", i);
        kept.clock.advance_s(0.25);
    }
    EXPECT_THAT(kept.lines, ElementsAre("lost 0", "lost 40 (39 more like this left out)",
                                        "lost 80 (39 more like this left out)"));
}

TEST(Log, KeysDoNotLimitOneAnother) {
    Kept kept;
    kept.log.limited("a", 10.0, Severity::kWarning, "a");
    kept.log.limited("b", 10.0, Severity::kWarning, "b");
    kept.log.limited("a", 10.0, Severity::kWarning, "a");
    EXPECT_THAT(kept.lines, ElementsAre("a", "b"));
}

TEST(Log, EachOfSeveralIsLimitedByItself) {
    Kept kept;
    kept.log.limited({"host lost", 0}, 10.0, Severity::kWarning, "first");
    kept.log.limited({"host lost", 1}, 10.0, Severity::kWarning, "second");
    kept.log.limited({"host lost", 1}, 10.0, Severity::kWarning, "second");
    EXPECT_THAT(kept.lines, ElementsAre("first", "second"));
}

TEST(Log, ManyKeysShareTheLastLimit) {
    Kept kept;
    for (std::size_t i = 0; i < Log::kMaxKeys + 40; ++i)
        kept.log.limited({"key", i}, 10.0, Severity::kWarning, "{}", i);
    EXPECT_EQ(kept.lines.size(), Log::kMaxKeys);
}

TEST(Log, ThreadsDoNotMixTheirLines) {
    Kept kept;
    const auto talk = [&kept](char letter) {
        for (int i = 0; i < 500; ++i)
            kept.log.info("{}", std::string(20, letter));
    };
    std::thread other(talk, 'b');
    talk('a');
    other.join();
    ASSERT_EQ(kept.lines.size(), 1000U);
    for (const std::string& line : kept.lines)
        EXPECT_EQ(line, std::string(20, line.front()));
}

TEST(Log, TheThresholdMayChange) {
    Kept kept;
    kept.log.info("a");
    kept.log.set_threshold(Severity::kWarning);
    kept.log.info("b");
    kept.log.warning("c");
    EXPECT_THAT(kept.lines, ElementsAre("a", "c"));
}

TEST(Log, PrefixesThePriorityWhenNoTerminalListens) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const int saved = ::dup(STDERR_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ManualClock clock;
    Log log(clock);
    log.warning("port {} is busy", 8004);
    ::dup2(saved, STDERR_FILENO);
    ::close(saved);
    ::close(ends[1]);
    std::array<char, 100> buffer{};
    const ssize_t size = ::read(ends[0], buffer.data(), buffer.size());
    ::close(ends[0]);
    ASSERT_GT(size, 0);
    EXPECT_EQ(std::string_view(buffer.data(), static_cast<std::size_t>(size)), "<4>port 8004 is busy\n");
}

}  // namespace
}  // namespace skyig::server
