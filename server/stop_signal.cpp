#include "server/stop_signal.h"

#include <sys/signalfd.h>
#include <unistd.h>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

namespace skyig::server {

StopSignal::StopSignal(bool reloads) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    if (reloads) sigaddset(&signals, SIGHUP);
    const int blocked = pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    if (blocked != 0)
        throw std::runtime_error(std::string("cannot block signals: ") + std::strerror(blocked));
    descriptor_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ < 0)
        throw std::runtime_error(std::string("cannot wait for signals: ") + std::strerror(errno));
}

// The signals stay blocked: one that comes while the program ends must not cut its report short.
StopSignal::~StopSignal() {
    close(descriptor_);
}

bool StopSignal::requested() noexcept {
    signalfd_siginfo signal{};
    while (!requested_ &&
           read(descriptor_, &signal, sizeof(signal)) == static_cast<ssize_t>(sizeof(signal))) {
        if (signal.ssi_signo == SIGHUP)
            reload_ = true;
        else
            requested_ = true;
    }
    return requested_;
}

}  // namespace skyig::server
