// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/timer.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace pharos::host {
namespace {

timespec to_timespec(std::chrono::nanoseconds duration) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(duration);
  return {static_cast<time_t>(seconds.count()), static_cast<long>((duration - seconds).count())};
}

}  // namespace

Timer::Timer() : fd_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
  if (!fd_.valid()) throw std::system_error(errno, std::generic_category(), "timerfd_create");
}

void Timer::start(std::chrono::nanoseconds first, std::chrono::nanoseconds period) {
  itimerspec when{};
  when.it_value = to_timespec(std::max(first, std::chrono::nanoseconds(1)));  // zero would disarm it
  when.it_interval = to_timespec(period);
  if (::timerfd_settime(fd_.get(), 0, &when, nullptr) != 0) {
    throw std::system_error(errno, std::generic_category(), "timerfd_settime");
  }
}

void Timer::stop() {
  const itimerspec never{};
  ::timerfd_settime(fd_.get(), 0, &never, nullptr);
}

std::uint64_t Timer::take_expiries() {
  std::uint64_t expiries = 0;
  return ::read(fd_.get(), &expiries, sizeof expiries) == sizeof expiries ? expiries : 0;
}

}  // namespace pharos::host
