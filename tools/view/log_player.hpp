// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/lcm_log/lcm_log.hpp"
#include "tools/sources/source_table.hpp"
#include "tools/view/routes.hpp"
#include "tools/view/state_json.hpp"

namespace pharos::tools {

/// Replays a log into a table: in its own time, faster or slower, from any place. Ages and rates are those that were
/// when it was recorded. Times of messages only go forward: an older one counts as of the time before it, one that is
/// more than a day later than all before as broken.
class LogPlayer {
 public:
  /// Reads the whole log once for its index; a packed one (.gz) is unpacked again up to each place that is sought.
  /// Throws host::InputError for a file that cannot be read or holds no message.
  explicit LogPlayer(const std::string& path);

  void control(const ControlRequest& request);
  /// Plays `elapsed_s` of real time.
  void advance(double elapsed_s);

  const SourceTable& table() const { return table_; }
  /// The log's time of what is shown, UTC.
  std::int64_t utc_ns() const { return first_ns_ + position_ns_; }
  ReplayState state() const;

 private:
  // The first message of a second of the log, and the time that the message before it had.
  struct Place {
    std::int64_t file_position = 0;
    std::int64_t time_ns = 0;
  };
  void build_index();
  void seek(std::int64_t position_ns);
  void play_up_to(std::int64_t position_ns);
  // A message's time after the first one's; empty for a broken one.
  std::optional<std::int64_t> time_of(const LoggedMessage& message) const;

  std::string path_;
  LcmLogReader reader_;
  SourceTable table_;
  std::vector<Place> index_;  // one a second
  std::int64_t first_ns_ = 0;
  std::int64_t duration_ns_ = 0;
  std::int64_t position_ns_ = 0;
  std::int64_t newest_ns_ = 0;  // of the messages read so far
  std::int64_t skipped_ = 0;
  std::optional<LoggedMessage> waiting_;  // the first one after position_ns_; the reader's until its next one
  double speed_ = 1.0;
  bool playing_ = true;
};

}  // namespace pharos::tools
