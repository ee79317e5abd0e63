// SPDX-License-Identifier: Apache-2.0
#include "tools/view/log_player.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kLogSecond_ns = 1'000'000'000;
constexpr std::int64_t kNsPerUs = 1'000;
// A gap that no recording has: the time of the message is broken.
constexpr std::int64_t kLongestGap_ns = 86'400 * kLogSecond_ns;
// Played unseen before a place that is jumped to: states come once a second, rates count the last one.
constexpr std::int64_t kLead_ns = 3 * kLogSecond_ns;
constexpr std::int64_t kTick_ns = kLogSecond_ns / 10;
constexpr std::int64_t kMaxTime_us = 4'102'444'800'000'000;  // year 2100

const char* const kGiveLog = "; give a log of lcm-logger";

// A file can be read again from any place; a pipe cannot.
host::ByteSource open_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw host::InputError(path + ": " + std::strerror(errno) + kGiveLog);
  if (!S_ISREG(status.st_mode)) throw host::InputError(path + ": is not a file" + kGiveLog);
  return host::ByteSource(path);
}

}  // namespace

LogPlayer::LogPlayer(const std::string& path) : path_(path), reader_(open_file(path)) {
  build_index();
  if (index_.empty()) {
    throw host::InputError(path + ": has no LCM message" + kGiveLog);
  }
  seek(0);
}

void LogPlayer::build_index() {
  bool any = false;
  std::int64_t place = reader_.position();
  while (const auto message = reader_.next()) {
    const std::int64_t at = place;
    place = reader_.position();
    if (!any && message->utime_us > 0 && message->utime_us < kMaxTime_us) {
      any = true;
      first_ns_ = message->utime_us * kNsPerUs;
    }
    const auto time_ns = any ? time_of(*message) : std::nullopt;
    if (!time_ns) {
      ++skipped_;
      continue;
    }
    // An entry a second of a day's gap would be many: one for each second that has a message.
    if (index_.empty() || *time_ns / kLogSecond_ns > index_.back().time_ns / kLogSecond_ns)
      index_.push_back({at, *time_ns});
    newest_ns_ = *time_ns;
  }
  duration_ns_ = newest_ns_;
  skipped_ += reader_.counters().damaged + (reader_.counters().cut_off ? 1 : 0);
}

std::optional<std::int64_t> LogPlayer::time_of(const LoggedMessage& message) const {
  if (message.utime_us <= 0 || message.utime_us >= kMaxTime_us) return std::nullopt;
  const std::int64_t time_ns = message.utime_us * kNsPerUs - first_ns_;
  if (time_ns > newest_ns_ + kLongestGap_ns) return std::nullopt;
  return std::max(time_ns, newest_ns_);
}

void LogPlayer::seek(std::int64_t position_ns) {
  const std::int64_t from_ns = std::max<std::int64_t>(position_ns - kLead_ns, 0);
  auto at = std::upper_bound(index_.begin(), index_.end(), from_ns,
                             [](std::int64_t time_ns, const Place& place) { return time_ns < place.time_ns; });
  if (at != index_.begin()) --at;
  waiting_.reset();
  reader_ = LcmLogReader(host::ByteSource(path_), at->file_position);
  newest_ns_ = at->time_ns;
  position_ns_ = at->time_ns;
  table_ = SourceTable();
  play_up_to(position_ns);
}

void LogPlayer::play_up_to(std::int64_t position_ns) {
  for (;;) {
    if (!waiting_) waiting_ = reader_.next();
    if (!waiting_) break;
    const auto time_ns = time_of(*waiting_);
    if (time_ns && *time_ns > position_ns) break;
    if (time_ns) {
      newest_ns_ = *time_ns;
      const std::int64_t utc_ns = first_ns_ + *time_ns;
      // LOST is noticed as often as live.
      for (; position_ns_ + kTick_ns <= *time_ns && *time_ns - position_ns_ < kLead_ns; position_ns_ += kTick_ns) {
        table_.tick(first_ns_ + position_ns_, first_ns_ + position_ns_);
      }
      position_ns_ = *time_ns;
      table_.take(std::string(waiting_->channel), waiting_->data.data(), static_cast<int>(waiting_->data.size()),
                  utc_ns, utc_ns);
    }
    waiting_.reset();
  }
  position_ns_ = position_ns;
  table_.tick(utc_ns(), utc_ns());
}

void LogPlayer::control(const ControlRequest& request) {
  if (request.speed) speed_ = *request.speed;
  if (request.playing) playing_ = *request.playing;
  if (request.seek_s) {
    const double position_ns = std::min(*request.seek_s * 1e9, static_cast<double>(duration_ns_));
    seek(static_cast<std::int64_t>(position_ns));
  } else if (playing_ && position_ns_ >= duration_ns_) {
    seek(0);  // play at the end: again
  }
}

void LogPlayer::advance(double elapsed_s) {
  if (!playing_) return;
  const auto step_ns = static_cast<std::int64_t>(elapsed_s * speed_ * 1e9);
  play_up_to(std::min(position_ns_ + step_ns, duration_ns_));
  if (position_ns_ >= duration_ns_) playing_ = false;
}

ReplayState LogPlayer::state() const {
  return {static_cast<double>(position_ns_) * 1e-9, static_cast<double>(duration_ns_) * 1e-9, speed_, playing_,
          skipped_};
}

}  // namespace pharos::tools
