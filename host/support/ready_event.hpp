// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Notifies a poll loop from another thread: a descriptor that is readable from set() to clear().
class ReadyEvent {
 public:
  /// Throws std::system_error where the kernel gives no descriptor.
  ReadyEvent() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (!fd_.valid()) throw std::system_error(errno, std::generic_category(), "eventfd");
  }

  int fd() const { return fd_.get(); }
  /// May be called any number of times: it fails only while the descriptor is readable anyway.
  void set() {
    const std::uint64_t one = 1;
    static_cast<void>(::write(fd_.get(), &one, sizeof one) == sizeof one);
  }
  void clear() {
    std::uint64_t count = 0;
    static_cast<void>(::read(fd_.get(), &count, sizeof count) == 0);
  }

 private:
  UniqueFd fd_;
};

}  // namespace pharos::host
