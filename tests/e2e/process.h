// The programs as a shell sees them: started with arguments, and what comes out of them.
#pragma once

#include <sys/types.h>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace skyig::tests {

struct Finished {
    /// Exit status; 128 + signal for a program that a signal ended; -1 if it had to be killed by the time
    /// limit.
    int status = -1;
    std::string out;
    std::string err;
};

/// A directory of its own, gone with everything in it at the end.
class ScratchDirectory {
  public:
    ScratchDirectory();
    ~ScratchDirectory();
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

  private:
    std::filesystem::path path_;
};

[[nodiscard]] std::string read_text(const std::string& path);

class Process {
  public:
    /// \param command      the program's path and its arguments
    /// \param environment  "NAME=value", on top of this process's
    explicit Process(const std::vector<std::string>& command,
                     const std::vector<std::string>& environment = {});
    /// Ends it if it still runs.
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const;
    /// Waits for its end; kills it when that takes too long.
    [[nodiscard]] Finished wait(std::chrono::seconds limit = std::chrono::seconds(60));
    /// What it has written to stderr so far.
    [[nodiscard]] std::string err_so_far() const { return read_text(scratch_.file("err")); }
    /// Waits until stderr holds `part`.
    [[nodiscard]] bool wait_for_err(const std::string& part,
                                    std::chrono::seconds limit = std::chrono::seconds(30)) const;

  private:
    ScratchDirectory scratch_;
    pid_t pid_ = -1;
};

[[nodiscard]] Finished run(const std::vector<std::string>& command,
                           const std::vector<std::string>& environment = {});

}  // namespace skyig::tests
