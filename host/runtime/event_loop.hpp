// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// The daemon's event loop: calls handlers of ready descriptors in one thread.
///
/// Level-triggered: a handler that leaves bytes unread is called again. A handler may watch or forget any descriptor,
/// its own included. The loop owns no descriptor but its own; forget one before closing it.
class EventLoop {
 public:
  using Handler = std::function<void()>;

  /// Throws std::system_error if no epoll descriptor can be created.
  EventLoop();

  /// Calls `handler` whenever `fd` is readable, hung up or in error. Throws std::system_error for a descriptor that
  /// cannot be polled (a regular file).
  void watch(int fd, Handler handler);
  void forget(int fd);

  /// Waits at most `timeout_ms` (-1: without limit) and calls the handlers of ready descriptors. Returns their number.
  int turn(int timeout_ms);
  /// Runs until stop().
  void run();
  void stop() { running_ = false; }

 private:
  UniqueFd epoll_;
  std::map<int, std::shared_ptr<Handler>> handlers_;
  bool running_ = false;
};

}  // namespace pharos::host
