// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listener.hpp"

#include <cstdio>
#include <limits>
#include <utility>

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

void Listener::take(const std::string& channel, const void* data, int size, std::int64_t utc_ns,
                    std::int64_t monotonic_ns) {
  pose_t pose;
  pointing_t pointing;
  spin_t spin;
  status_t status;
  target_state_t state;
  clock_exchange_t clock{};
  preview_t preview{};
  if (decode(pose, data, size)) {
    take_pose(received_pose(channel, pose, utc_ns), monotonic_ns);
  } else if (decode(state, data, size)) {
    ReceivedPose received = received_state(channel, state, utc_ns);
    if (format_ == ListenFormat::kJson) {
      std::puts(state_json(state).c_str());
      std::fflush(stdout);
    }
    take_pose(std::move(received), monotonic_ns);
  } else if (decode(pointing, data, size)) {
    take_other([&](bool json) { return json ? pointing_json(pointing) : pointing_line(pointing); });
  } else if (decode(spin, data, size)) {
    take_other([&](bool json) { return json ? spin_json(spin) : spin_line(spin); });
  } else if (decode(status, data, size)) {
    print_those_known(monotonic_ns);
    take_other([&](bool json) { return json ? status_json(status) : status_lines(status); });
  } else if (decode(clock, data, size)) {
    take_other([&](bool json) { return json ? clock_json(clock) : clock_line(clock); });
  } else if (decode(preview, data, size)) {
    take_other([&](bool json) { return json ? preview_json(preview) : preview_line(preview); });
  } else {
    ++other_types_;
  }
}

void Listener::take_pose(ReceivedPose pose, std::int64_t monotonic_ns) {
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
  std::puts(row.c_str());
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
