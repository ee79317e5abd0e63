// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/event_loop.hpp"

#include <sys/epoll.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace pharos::host {
namespace {

constexpr int kEventsPerTurn = 16;  // more than a daemon has descriptors; further events wait for the next turn

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

EventLoop::EventLoop() : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (!epoll_.valid()) fail("epoll_create1");
}

void EventLoop::watch(int fd, Handler handler) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = fd;
  const int operation = handlers_.count(fd) != 0 ? EPOLL_CTL_MOD : EPOLL_CTL_ADD;
  if (::epoll_ctl(epoll_.get(), operation, fd, &event) != 0) fail("epoll_ctl");
  handlers_[fd] = std::make_shared<Handler>(std::move(handler));
}

void EventLoop::forget(int fd) {
  if (handlers_.erase(fd) != 0) ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
}

int EventLoop::turn(int timeout_ms) {
  std::array<epoll_event, kEventsPerTurn> events{};
  const int count = ::epoll_wait(epoll_.get(), events.data(), kEventsPerTurn, timeout_ms);
  if (count < 0 && errno != EINTR) fail("epoll_wait");
  int handled = 0;
  for (int i = 0; i < count; ++i) {
    const auto found = handlers_.find(events[static_cast<std::size_t>(i)].data.fd);
    if (found == handlers_.end()) continue;                  // an earlier handler of this turn removed it
    const std::shared_ptr<Handler> handler = found->second;  // keeps it alive while it removes itself
    (*handler)();
    ++handled;
  }
  return handled;
}

void EventLoop::run() {
  running_ = true;
  while (running_) turn(-1);
}

}  // namespace pharos::host
