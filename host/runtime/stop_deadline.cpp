// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/stop_deadline.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <system_error>

namespace pharos::host {
namespace {

// Waits for any of the descriptors; -1: without limit. False after the time-out.
template <std::size_t N>
bool wait_for_any(std::array<pollfd, N>& fds, int timeout_ms) {
  int ready = 0;
  do {
    ready = ::poll(fds.data(), fds.size(), timeout_ms);
  } while (ready < 0 && errno == EINTR);
  return ready != 0;
}

}  // namespace

StopDeadline::StopDeadline(std::initializer_list<int> signals, std::chrono::milliseconds limit) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  signals_.reset(::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!signals_.valid()) throw std::system_error(errno, std::generic_category(), "signalfd");
  thread_ = std::thread([this, limit] { wait(limit); });
}

StopDeadline::~StopDeadline() {
  over_.set();
  thread_.join();
}

void StopDeadline::wait(std::chrono::milliseconds limit) {
  std::array<pollfd, 3> any{{{over_.fd(), POLLIN, 0}, {begun_.fd(), POLLIN, 0}, {signals_.get(), POLLIN, 0}}};
  wait_for_any(any, -1);
  std::array<pollfd, 1> over{{{over_.fd(), POLLIN, 0}}};
  if (!wait_for_any(over, static_cast<int>(limit.count()))) ::_exit(exit_code_);
}

}  // namespace pharos::host
