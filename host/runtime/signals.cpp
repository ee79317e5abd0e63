// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace pharos::host {
namespace {

UniqueFd descriptor_of(const sigset_t& set) {
  UniqueFd fd(::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!fd.valid()) throw std::system_error(errno, std::generic_category(), "signalfd");
  return fd;
}

}  // namespace

Signals::Signals(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  if (const int error = pthread_sigmask(SIG_BLOCK, &set, nullptr); error != 0) {
    throw std::system_error(error, std::generic_category(), "pthread_sigmask");
  }
  fd_ = descriptor_of(set);
  for (const int signal : signals) {
    sigemptyset(&set);
    sigaddset(&set, signal);
    each_fd_.push_back(descriptor_of(set));
  }
}

std::optional<int> Signals::take() {
  for (const UniqueFd& fd : each_fd_) {
    signalfd_siginfo info{};
    if (::read(fd.get(), &info, sizeof info) == sizeof info) return static_cast<int>(info.ssi_signo);
  }
  return std::nullopt;
}

}  // namespace pharos::host
