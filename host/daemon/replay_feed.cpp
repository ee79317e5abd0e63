// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/replay_feed.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/byte_source.hpp"

namespace pharos::host {
namespace {

// At full speed: number of chunks before the event loop handles signals and status again.
constexpr int kChunksPerTurn = 64;

}  // namespace

ReplayFeed::ReplayFeed(EventLoop& loop, ReplayTimeline& timeline, std::string name,
                       std::vector<std::filesystem::path> files, ByteFeedEvents events)
    : loop_(loop),
      timeline_(timeline),
      name_(std::move(name)),
      files_(std::move(files)),
      reader_(ByteSource(files_.at(0).string())),
      events_(std::move(events)) {
  player_ = timeline_.add(reader_->header().monotonic_ns);
  loop_.watch(timer_.fd(), [this] { on_timer(); });
}

ReplayFeed::~ReplayFeed() { loop_.forget(timer_.fd()); }

void ReplayFeed::attend(std::int64_t) {
  if (started_) return;
  started_ = true;
  spdlog::info("{}: replaying {} ({}, {} baud){}", name_, reader_->name(), reader_->header().target,
               reader_->header().baud,
               files_.size() > 1 ? " and " + std::to_string(files_.size() - 1) + " files that follow it" : "");
  read_next();
  timer_.start({});
}

void ReplayFeed::read_next() {
  do {
    next_ = reader_->next();
  } while (!next_ && open_next_file());
  if (!next_) {
    timeline_.end(player_);
    return;
  }
  timeline_.set_next(player_, next_->monotonic_ns);
  if (next_->lost_before > 0) events_.lost();
}

// False behind the last file.
bool ReplayFeed::open_next_file() {
  if (reader_->cut_off()) spdlog::info("{}: {} is cut off in a chunk", name_, reader_->name());
  while (++file_ < files_.size()) {
    try {
      StreamReader next{ByteSource(files_[file_].string())};
      add_up();
      reader_.emplace(std::move(next));
      return true;
    } catch (const InputError& error) {
      ++files_unreadable_;
      spdlog::warn("{}: {}", name_, error.what());
    }
  }
  return false;
}

void ReplayFeed::add_up() {
  dropped_bytes_ += reader_->dropped_bytes();
  lost_bytes_ += reader_->lost_bytes();
  bad_times_ += reader_->bad_times();
}

void ReplayFeed::on_timer() {
  timer_.take_expiries();
  for (int i = 0; next_ && i < kChunksPerTurn; ++i) {
    if (const std::int64_t wait_ns = timeline_.wait_ns(player_); wait_ns > 0) {
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

void ReplayFeed::play(const StreamChunk& chunk) {
  played_ns_ = chunk.monotonic_ns;
  timeline_.played(chunk.monotonic_ns, chunk.utc_ns);
  events_.bytes(chunk.bytes, {chunk.utc_ns, chunk.monotonic_ns});
}

void ReplayFeed::finish() {
  finished_ = true;
  add_up();
  spdlog::info("{}: the recording has come to its end", name_);
  if (bad_times_ > 0) spdlog::warn("{}: {} chunks were dropped for their impossible times", name_, bad_times_);
  events_.finished();
}

NamedCounts ReplayFeed::counters() const {
  const StreamReader* reading = finished_ ? nullptr : &*reader_;
  const auto sum = [&](std::uint64_t before, std::uint64_t now) { return static_cast<std::int64_t>(before + now); };
  return {{"replay.dropped_bytes", sum(dropped_bytes_, reading ? reading->dropped_bytes() : 0)},
          {"replay.lost_bytes", sum(lost_bytes_, reading ? reading->lost_bytes() : 0)},
          {"replay.chunks_bad_time", sum(bad_times_, reading ? reading->bad_times() : 0)},
          {"replay.files_unreadable", files_unreadable_},
          {"replay.silences_cut", timeline_.silences_cut()}};
}

}  // namespace pharos::host
