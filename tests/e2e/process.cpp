#include "tests/e2e/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace skyig::tests {

namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts)
        out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
    std::vector<std::string> out = more;
    for (char** entry = environ; *entry != nullptr; ++entry)
        out.emplace_back(*entry);
    return out;
}

template <class Done>
bool poll_until(std::chrono::seconds limit, Done done) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

}  // namespace

ScratchDirectory::ScratchDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "skyig-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no directory for test files");
    path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string ScratchDirectory::write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
}

std::string read_text(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

Process::Process(const std::vector<std::string>& command, const std::vector<std::string>& environment) {
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    const std::string out = scratch_.file("out");
    const std::string err = scratch_.file("err");
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), kWrite, 0600);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), kWrite, 0600);
    std::vector<std::string> words = command;
    std::vector<std::string> variables = environment_with(environment);
    const int failed = posix_spawn(&pid_, command.front().c_str(), &files, nullptr, pointers(words).data(),
                                   pointers(variables).data());
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) throw std::runtime_error(command.front() + " cannot be started");
}

Process::~Process() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const {
    kill(pid_, number);
}

Finished Process::wait(std::chrono::seconds limit) {
    Finished finished;
    int status = 0;
    if (poll_until(limit, [&] { return waitpid(pid_, &status, WNOHANG) == pid_; })) {
        finished.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        pid_ = -1;
    }
    finished.out = read_text(scratch_.file("out"));
    finished.err = read_text(scratch_.file("err"));
    return finished;
}

bool Process::wait_for_err(const std::string& part, std::chrono::seconds limit) const {
    return poll_until(limit, [&] { return err_so_far().find(part) != std::string::npos; });
}

Finished run(const std::vector<std::string>& command, const std::vector<std::string>& environment) {
    return Process(command, environment).wait();
}

}  // namespace skyig::tests
