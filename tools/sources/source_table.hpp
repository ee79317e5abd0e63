// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/listen/sight_monitor.hpp"
#include "tools/sources/source_row.hpp"

namespace pharos {
class bearings_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::tools {

/// Messages that are in no row, by cause.
struct LeftOut {
  std::int64_t foreign = 0;     // another type under the same channel name, or broken bytes
  std::int64_t impossible = 0;  // of a known type, with values that no pharosd sends
  std::int64_t too_many = 0;    // of more sources or daemons than the table has rows

  std::int64_t sum() const { return foreign + impossible + too_many; }
};

/// Every source that tells poses, axes or spins: a row each; the daemons' states; cameras' pictures; the newest events.
/// Its size is bounded whatever comes. `utc_ns` is the time of arrival, `now_ns` the same on the clock of ages (both of
/// the log where one is replayed).
class SourceTable {
 public:
  using Rows = std::map<SourceKey, SourceRow>;
  using SightsOf = std::map<SourceKey, Sights>;  // channel empty
  using Daemons = std::map<std::string, DaemonState>;

  /// A message of any type as it came; decoded here.
  void take(const std::string& channel, const void* data, int size, std::int64_t utc_ns, std::int64_t now_ns);
  /// Some times a second: sources that have stopped become LOST.
  void tick(std::int64_t utc_ns, std::int64_t now_ns);

  void add(const std::string& channel, const pose_t& pose, std::int64_t utc_ns, std::int64_t now_ns);
  void add(const std::string& channel, const pointing_t& pointing, std::int64_t utc_ns, std::int64_t now_ns);
  void add(const std::string& channel, const spin_t& spin, std::int64_t utc_ns, std::int64_t now_ns);
  void add(const std::string& channel, const target_state_t& state, std::int64_t utc_ns, std::int64_t now_ns);
  void add(const bearings_t& bearings, std::int64_t now_ns);
  void add(const status_t& status, std::int64_t now_ns);
  void add(const std::string& channel, preview_t& preview, std::int64_t utc_ns, std::int64_t now_ns);

  const Rows& rows() const { return rows_; }
  const Daemons& daemons() const { return daemons_; }
  const std::deque<SourceEvent>& events() const { return events_; }
  /// Of each camera the newest, in the order in which cameras came; a camera keeps its place.
  const std::vector<CameraPreview>& previews() const { return previews_; }
  const LeftOut& left_out() const { return left_out_; }
  /// Valid poses, axes and spins, and status messages.
  std::int64_t received() const { return received_; }
  /// Light of a row's station on its target; null where none was told.
  const Sights* sights_of(const SourceKey& key) const;
  /// What the daemons tell of a row's source; null where they tell nothing.
  const SourceHealth* health_of(const SourceKey& key) const;

 private:
  SourceRow* row_of(const SourceKey& key);
  void count_gap(const SourceKey& key, SourceRow& row, std::int64_t sequence);
  void arrived(SourceRow& row, bool valid, double age_s, std::int64_t now_ns);
  void event(std::string text);

  Rows rows_;
  SightsOf sights_;
  Daemons daemons_;
  std::vector<CameraPreview> previews_;
  std::map<SourceKey, std::int64_t> sequences_;  // newest of each source on each target, all stations
  std::deque<SourceEvent> events_;
  std::int64_t events_told_ = 0;
  SightMonitor sight_;
  LeftOut left_out_;
  std::int64_t received_ = 0;
};

}  // namespace pharos::tools
