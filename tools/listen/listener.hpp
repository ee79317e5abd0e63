// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "tools/listen/listen_summary.hpp"
#include "tools/listen/sight_monitor.hpp"
#include "tools/listen/truth_file.hpp"

namespace pharos {
class target_state_t;
}
namespace pharos::tools {

enum class ListenFormat : std::uint8_t { kLines, kCsv, kJson, kTum, kNone };

/// Prints messages, and keeps their statistics.
class Listener {
 public:
  /// `covariance`: 36 more columns of a table; not with kTum.
  Listener(ListenFormat format, bool covariance, std::optional<TruthFile> truth);

  /// Printed before the first message: the header row of a CSV table.
  void begin();
  /// Any message of a channel listened to: pose_t, target_state_t, pointing_t, spin_t, status_t, clock_exchange_t
  /// and preview_t are printed (the last five not as CSV or TUM, which have no place for them; of a preview all but its
  /// picture), others passed over and counted, as are those with values that no pharosd sends.
  void take(const std::string& channel, const void* data, int size, std::int64_t utc_ns, std::int64_t monotonic_ns);
  /// Several times a second: prints a row LOST for each source whose poses have stopped (lines only).
  void tick(std::int64_t utc_ns, std::int64_t monotonic_ns);
  /// Prints the poses still held for their truth, and compares those that were printed before it was written.
  void finish();

  /// Of kTum: what has no line.
  const host::TumLeftOut* left_out() const { return rows_ ? &rows_->tum().left_out() : nullptr; }

  const ListenSummary& summary() const { return summary_; }
  /// What was received and passed over.
  struct PassedOver {
    std::int64_t other_types = 0;  // none of Pharos', or damaged
    std::int64_t impossible = 0;   // values that no pharosd sends
    std::int64_t too_many = 0;     // of more sources than are kept
  };
  const PassedOver& passed_over() const { return passed_over_; }
  /// Status, spin, pointing, clock and preview messages.
  std::int64_t other_messages() const { return other_messages_; }

 private:
  /// `take` gets the message if its values are possible, else it is counted; false if `data` is no such message.
  template <class Message, class Take>
  bool take_as(const void* data, int size, const Take& take);
  void take_state(const std::string& channel, const target_state_t& state, std::int64_t utc_ns,
                  std::int64_t monotonic_ns);
  void take_pose(ReceivedPose pose, std::int64_t monotonic_ns);
  /// A message other than a pose; `text` returns its JSON object or its lines.
  void take_other(const std::function<std::string(bool json)>& text);
  /// Prints in order: a pose held for its truth delays the ones after it.
  void print_those_known(std::int64_t monotonic_ns);
  /// False: its truth is not available (yet).
  bool compare(ReceivedPose& pose);
  void print(const ReceivedPose& pose);
  void print_row(const std::string& row);

  ListenFormat format_;
  std::optional<TruthFile> truth_;
  struct Waiting {
    ReceivedPose pose;
    std::int64_t arrival_ns;
  };
  std::deque<Waiting> waiting_;
  std::vector<ReceivedPose> not_compared_;  // printed without an error
  std::unique_ptr<host::RowWriter> rows_;   // of CSV, JSON and TUM
  ListenSummary summary_;
  SightMonitor sight_;
  PassedOver passed_over_;
  std::int64_t other_messages_ = 0;
};

}  // namespace pharos::tools
