// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tools/listen/received_pose.hpp"
#include "tools/listen/sight_monitor.hpp"

namespace pharos {
class pointing_t;
class status_t;
}  // namespace pharos

namespace pharos::tools {

/// `text` for a terminal, at most `size` characters: whoever can send a message must not send escape sequences.
std::string printable(std::string_view text, std::size_t size);

/// What `pharos watch` shows: a row a source, the newest events, the daemons' states. Times are monotonic.
class WatchTable {
 public:
  void add(const ReceivedPose& pose, std::int64_t now_ns);
  void add(const std::string& channel, const pointing_t& pointing, std::int64_t utc_ns, std::int64_t now_ns);
  void add(const status_t& status, std::int64_t now_ns);
  /// A message of another type, or a broken one.
  void add_unknown() { ++unknown_; }
  /// Several times a second: sources that have stopped become LOST.
  void tick(std::int64_t utc_ns, std::int64_t now_ns);

  /// The table as lines of at most `columns` characters, newest events last.
  std::vector<std::string> lines(std::int64_t now_ns, std::size_t columns) const;
  /// Valid poses and pointings, and status messages.
  std::int64_t received() const { return received_; }

 private:
  struct Row {
    std::string station;
    std::string status;  // of the newest message
    std::string value;   // position and attitude, or the axis, of the newest valid one
    std::string sigma;
    std::string flags;
    std::int64_t last_ns = 0;  // newest valid one; 0: none yet
    double age_at_arrival_s = 0.0;
    std::deque<std::int64_t> arrivals_ns;  // valid ones of the last second
    std::int64_t refused = 0;
    std::int64_t lost = 0;  // gaps in the sequence numbers
    std::int64_t sequence = -1;
  };
  struct Daemon {
    std::string state;
    std::string message;
    std::int64_t last_ns = 0;
    std::map<std::pair<std::string, std::string>, std::string> errors;  // of its sources, by source and target
  };
  using Key = std::tuple<std::string, std::string, std::string, int>;  // channel, source, target, station

  Row* row_of(const Key& key);
  void arrived(Row& row, std::int64_t sequence, bool valid, double age_s, std::int64_t now_ns);
  void event(std::string line);
  std::string row_text(const Key& key, const Row& row, std::int64_t now_ns) const;

  std::map<Key, Row> rows_;
  std::map<std::string, Daemon> daemons_;  // by host
  std::deque<std::string> events_;
  SightMonitor sight_;
  std::int64_t unknown_ = 0;
  std::int64_t rows_left_out_ = 0;  // messages of sources beyond the table's size
  std::int64_t received_ = 0;
};

}  // namespace pharos::tools
