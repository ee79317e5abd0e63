// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/replay_feed.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "host/table/byte_source.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
// At full speed: number of chunks before the event loop handles signals and status again.
constexpr int kChunksPerTurn = 64;
// At real speed longer silences of the recording are cut to this.
constexpr std::int64_t kLongestWait_ns = 10'000'000'000;

}  // namespace

ReplayFeed::ReplayFeed(EventLoop& loop, const Clock& clock, std::string name, const std::string& file,
                       ReplaySpeed speed, ByteFeedEvents events)
    : loop_(loop),
      clock_(clock),
      name_(name),
      log_(std::move(name)),
      reader_(ByteSource(file)),
      speed_(speed),
      events_(std::move(events)) {
  loop_.watch(timer_.fd(), [this] { on_timer(); });
}

ReplayFeed::~ReplayFeed() { loop_.forget(timer_.fd()); }

void ReplayFeed::attend(std::int64_t monotonic_ns) {
  if (started_) return;
  started_ = true;
  read_next();
  spdlog::info("{}: replaying {} ({}, {} baud)", name_, reader_.name(), reader_.header().target, reader_.header().baud);
  shift_ns_ = monotonic_ns - (next_ ? next_->monotonic_ns : 0);
  timer_.start({});
}

void ReplayFeed::read_next() {
  next_ = reader_.next();
  if (next_ && next_->lost_before > 0) events_.lost();
}

void ReplayFeed::on_timer() {
  timer_.take_expiries();
  for (int i = 0; next_ && i < kChunksPerTurn; ++i) {
    if (const std::int64_t wait_ns = wait_for_next(); wait_ns > 0) {
      timer_.start(std::chrono::nanoseconds(wait_ns));
      return;
    }
    play(*next_);
    read_next();
  }
  if (next_) {
    timer_.start({});
  } else {
    finish();
  }
}

std::int64_t ReplayFeed::wait_for_next() {
  if (speed_ == ReplaySpeed::kFastest) return 0;
  const std::int64_t wait_ns = next_->monotonic_ns + shift_ns_ - clock_.monotonic_ns();
  if (wait_ns <= kLongestWait_ns) return wait_ns;
  shift_ns_ -= wait_ns - kLongestWait_ns;
  ++silences_cut_;
  log_.info("silence",
            "a silence of " + std::to_string(wait_ns / kNsPerS) + " s in the recording is cut to " +
                std::to_string(kLongestWait_ns / kNsPerS) + " s",
            clock_.monotonic_ns());
  return kLongestWait_ns;
}

void ReplayFeed::play(const StreamChunk& chunk) {
  played_ns_ = chunk.monotonic_ns;
  events_.bytes(chunk.bytes, {chunk.utc_ns, chunk.monotonic_ns});
}

void ReplayFeed::finish() {
  finished_ = true;
  spdlog::info("{}: the recording has come to its end{}", name_, reader_.cut_off() ? " (cut off in a chunk)" : "");
  if (reader_.bad_times() > 0) {
    spdlog::warn("{}: {} chunks were dropped for their impossible times", name_, reader_.bad_times());
  }
  events_.finished();
}

NamedCounts ReplayFeed::counters() const {
  return {{"replay.dropped_bytes", static_cast<std::int64_t>(reader_.dropped_bytes())},
          {"replay.lost_bytes", static_cast<std::int64_t>(reader_.lost_bytes())},
          {"replay.chunks_bad_time", static_cast<std::int64_t>(reader_.bad_times())},
          {"replay.silences_cut", silences_cut_}};
}

}  // namespace pharos::host
