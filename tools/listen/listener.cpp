// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listener.hpp"

#include <cstdio>
#include <limits>
#include <utility>

#include "host/receive/message_values.hpp"
#include "host/support/printable.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"
#include "tools/listen/clock_rows.hpp"
#include "tools/listen/pointing_rows.hpp"
#include "tools/listen/pose_rows.hpp"
#include "tools/listen/preview_rows.hpp"
#include "tools/listen/received_state.hpp"
#include "tools/listen/spin_rows.hpp"
#include "tools/listen/status_rows.hpp"
#include "tools/listen/subscription.hpp"

namespace pharos::tools {
namespace {

// Poses without a truth yet that are kept for the end: ten minutes at 60 Hz.
constexpr std::size_t kMaxNotCompared = 36'000;
// A pose is held this long until its truth is available, which a simulator writes up to a frame later; then it is
// printed without.
constexpr std::int64_t kLongestWait_ns = 500'000'000;

}  // namespace

Listener::Listener(ListenFormat format, bool covariance, std::optional<TruthFile> truth)
    : format_(format), truth_(std::move(truth)) {
  if (format_ == ListenFormat::kLines || format_ == ListenFormat::kNone) return;
  const auto row_format = format_ == ListenFormat::kJson  ? host::RowFormat::kJson
                          : format_ == ListenFormat::kTum ? host::RowFormat::kTum
                                                          : host::RowFormat::kCsv;
  rows_ = std::make_unique<host::RowWriter>(stdout, row_format, pose_columns(), host::RowExtras{covariance});
}

void Listener::begin() {
  if (rows_) rows_->flush();
}

template <class Message, class Take>
bool Listener::take_as(const void* data, int size, const Take& take) {
  Message message{};
  if (!decode(message, data, size)) return false;
  if (host::is_possible(message)) {
    take(message);
  } else {
    ++passed_over_.impossible;
  }
  return true;
}

void Listener::take(const std::string& channel, const void* data, int size, std::int64_t utc_ns,
                    std::int64_t monotonic_ns) {
  const auto other = [this](auto json_text, auto line_text) {
    return [this, json_text, line_text](const auto& message) {
      take_other([&](bool json) { return json ? json_text(message) : line_text(message); });
    };
  };
  const bool known =
      take_as<pose_t>(data, size,
                      [&](const pose_t& pose) { take_pose(received_pose(channel, pose, utc_ns), monotonic_ns); }) ||
      take_as<target_state_t>(data, size,
                              [&](const target_state_t& state) { take_state(channel, state, utc_ns, monotonic_ns); }) ||
      take_as<status_t>(data, size,
                        [&](const status_t& status) {
                          print_those_known(monotonic_ns);
                          other(status_json, status_lines)(status);
                        }) ||
      take_as<pointing_t>(data, size, other(pointing_json, pointing_line)) ||
      take_as<spin_t>(data, size, other(spin_json, spin_line)) ||
      take_as<clock_exchange_t>(data, size, other(clock_json, clock_line)) ||
      take_as<preview_t>(data, size, other(preview_json, preview_line));
  if (!known) ++passed_over_.other_types;
}

void Listener::take_state(const std::string& channel, const target_state_t& state, std::int64_t utc_ns,
                          std::int64_t monotonic_ns) {
  ReceivedPose received = received_state(channel, state, utc_ns);
  if (format_ == ListenFormat::kJson && summary_.has_room(received)) {
    std::puts(state_json(state).c_str());
    std::fflush(stdout);
  }
  take_pose(std::move(received), monotonic_ns);
}

void Listener::take_pose(ReceivedPose pose, std::int64_t monotonic_ns) {
  if (!summary_.has_room(pose)) {
    ++passed_over_.too_many;
    return;
  }
  pose.rate_hz = summary_.add(pose, monotonic_ns);
  print_row(sight_.add(pose, monotonic_ns));
  waiting_.push_back({std::move(pose), monotonic_ns});
  print_those_known(monotonic_ns);
}

void Listener::tick(std::int64_t utc_ns, std::int64_t monotonic_ns) {
  print_those_known(monotonic_ns);
  for (const std::string& row : sight_.lost(utc_ns, monotonic_ns)) print_row(row);
}

void Listener::print_row(const std::string& row) {
  if (format_ != ListenFormat::kLines || row.empty()) return;
  std::puts(host::printable(row).c_str());
  std::fflush(stdout);
}

void Listener::print_those_known(std::int64_t monotonic_ns) {
  for (; !waiting_.empty(); waiting_.pop_front()) {
    auto& [pose, arrival_ns] = waiting_.front();
    if (truth_ && pose.pose && !compare(pose)) {
      if (monotonic_ns - arrival_ns < kLongestWait_ns) return;
      if (not_compared_.size() < kMaxNotCompared) not_compared_.push_back(pose);
    }
    print(pose);
  }
}

bool Listener::compare(ReceivedPose& pose) {
  const auto truth = truth_->at(pose.station, pose.utime_us);
  if (!truth) return false;
  pose.error = pose_error(*pose.pose, *truth, pose.has_turn);
  if (pose.has_turn) pose.error->nees = pose_nees(*pose.pose, *truth, pose.covariance);
  summary_.add_error(pose, *pose.error);
  return true;
}

void Listener::finish() {
  print_those_known(std::numeric_limits<std::int64_t>::max());
  for (ReceivedPose& pose : not_compared_) compare(pose);
  not_compared_.clear();
}

void Listener::print(const ReceivedPose& pose) {
  const bool printed = pose.fused && format_ == ListenFormat::kJson;  // as it came
  if (format_ == ListenFormat::kNone || printed) return;
  if (format_ == ListenFormat::kLines) {
    std::puts(pose_line(pose).c_str());
    std::fflush(stdout);
    return;
  }
  write_pose_row(*rows_, pose);
}

void Listener::take_other(const std::function<std::string(bool)>& text) {
  ++other_messages_;
  if (format_ != ListenFormat::kLines && format_ != ListenFormat::kJson) return;
  std::puts(text(format_ == ListenFormat::kJson).c_str());
  std::fflush(stdout);
}

}  // namespace pharos::tools
