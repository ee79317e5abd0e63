// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/port_feed.hpp"

#include <utility>

namespace pharos::host {
namespace {

// A third of a second at 460,800 baud; the kernel holds 4 KiB.
constexpr std::size_t kReadBytes = 16 * 1024;

}  // namespace

PortFeed::PortFeed(EventLoop& loop, const Clock& clock, std::string name, const std::string& path, int baud,
                   ByteFeedEvents events)
    : loop_(loop),
      clock_(clock),
      log_(std::move(name)),
      baud_(baud),
      port_(path, baud),
      events_(std::move(events)),
      buffer_(kReadBytes) {}

PortFeed::~PortFeed() {
  if (port_.is_open()) loop_.forget(port_.fd());
}

void PortFeed::attend(std::int64_t monotonic_ns) {
  switch (port_.try_open(monotonic_ns)) {
    case ReopeningPort::Attempt::kNone:
    case ReopeningPort::Attempt::kStillGone:
      return;
    case ReopeningPort::Attempt::kOpened:
      log_.info("open", port_.path() + " is open", monotonic_ns);
      loop_.watch(port_.fd(), [this] { on_readable(); });
      return;
    case ReopeningPort::Attempt::kFailed:
      log_.warn("not open", port_.failure().message + "; trying again", monotonic_ns);
      return;
  }
}

void PortFeed::on_readable() {
  const int fd = port_.fd();
  const Transfer transfer = port_.read(buffer_, clock_.monotonic_ns());
  const Arrival arrival{clock_.utc_ns(), clock_.monotonic_ns()};
  if (transfer.bytes > 0) events_.bytes({buffer_.data(), transfer.bytes}, arrival);
  if (!transfer.gone) return;
  loop_.forget(fd);
  was_lost_ = true;
  log_.warn("unplugged", port_.path() + " was unplugged; waiting for it", arrival.monotonic_ns);
  events_.lost();
}

SourceState PortFeed::state() const {
  if (port_.is_open()) return SourceState::kOk;
  const OpenError error = port_.failure().error;
  return error == OpenError::kNone || error == OpenError::kMissing ? SourceState::kGone : SourceState::kError;
}

std::string PortFeed::error() const {
  if (port_.is_open()) return "";
  if (!port_.failure().message.empty()) return port_.failure().message;
  return port_.path() + (was_lost_ ? ": unplugged; waiting for it" : ": not opened yet");
}

NamedCounts PortFeed::counters() const {
  return {{"port.opened", static_cast<std::int64_t>(port_.times_opened())},
          {"port.lost", static_cast<std::int64_t>(port_.times_lost())},
          {"port.log_lines_held_back", static_cast<std::int64_t>(log_.suppressed())}};
}

}  // namespace pharos::host
