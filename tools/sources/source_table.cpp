// SPDX-License-Identifier: Apache-2.0
#include "tools/sources/source_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "host/device/ptp_state.hpp"
#include "host/receive/message_values.hpp"
#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/counter_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"
#include "tools/listen/pose_rows.hpp"
#include "tools/listen/received_state.hpp"
#include "tools/listen/subscription.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// 32 targets with two stations each and five cameras are 69 rows; whoever sends more names than this is not a daemon.
constexpr std::size_t kMaxRows = 128;
constexpr std::size_t kMaxDaemons = 16;
// Five cameras or rigs with two systems and two views each; 32 KiB each.
constexpr std::size_t kMaxPreviews = 32;
constexpr std::size_t kMaxEvents = 50;
// More arrivals a second than any source has: the rate shown is this at most.
constexpr std::size_t kMaxArrivals = 4096;
// Longest text that is kept of a message.
constexpr std::size_t kMaxText = 200;
// Both planes of a station pass within a turn of its rotors, of 20 ms at most; with room for what comes late.
constexpr std::int64_t kCycle_ns = 100'000'000;

double age_of(std::int64_t utc_ns, std::int64_t utime_us) {
  return static_cast<double>(utc_ns) * 1e-9 - static_cast<double>(utime_us) * 1e-6;
}

std::string kept(const std::string& text) { return text.substr(0, kMaxText); }

Vector3 vector_of(const double (&values)[3]) { return {values[0], values[1], values[2]}; }

PoseDetails details_of(const pose_t& message) {
  PoseDetails details;
  details.parent_frame = kept(message.parent_frame);
  details.child_frame = kept(message.child_frame);
  details.residual_rms_rad = message.residual_rms_rad;
  details.observations = message.observations;
  if (message.has_second != 0) {
    const double* q = message.second_orientation_wxyz;
    details.second = LighthouseFromBody{Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(),
                                        vector_of(message.second_position_m)};
  }
  return details;
}

// A message of one sweep tells one axis: the other is that of the sweep before.
void add_other_axis(Sights& sights, const Sights& before) {
  bool has_x = false, has_y = false;
  for (const auto& sensor : sights.sensors) {
    has_x = has_x || (sensor && sensor->x_over_z);
    has_y = has_y || (sensor && sensor->y_over_z);
  }
  if (has_x == has_y) return;
  for (std::size_t number = 0; number < sights.sensors.size(); ++number) {
    const auto& old = before.sensors[number];
    if (!old || !(has_x ? old->y_over_z : old->x_over_z)) continue;
    auto& sensor = sights.sensors[number];
    if (!sensor) sensor = SensorSight{std::nullopt, std::nullopt, old->used};
    (has_x ? sensor->y_over_z : sensor->x_over_z) = has_x ? old->y_over_z : old->x_over_z;
  }
}

// "PTP slave", or of a rig "left PTP slave, right PTP listening".
std::string ptp_of(const source_status_t& source) {
  constexpr std::string_view kCounter = "clock.ptp_state";
  std::string text;
  for (const counter_t& counter : source.counters) {
    const std::string_view name = counter.name;
    if (!name.ends_with(kCounter) || counter.value <= 0 || counter.value > static_cast<int>(host::PtpState::kUnread)) {
      continue;
    }
    const std::string_view head = name.substr(0, name.size() - kCounter.size());
    text += text.empty() ? "" : ", ";
    if (head == "left." || head == "right.") text += std::string(head.substr(0, head.size() - 1)) + ' ';
    text += host::text_of(static_cast<host::PtpState>(counter.value));
  }
  return text;
}

}  // namespace

void SourceTable::take(const std::string& channel, const void* data, int size, std::int64_t utc_ns,
                       std::int64_t now_ns) {
  pose_t pose;
  bearings_t bearings;
  pointing_t pointing;
  spin_t spin;
  status_t status;
  target_state_t state;
  preview_t preview;
  if (decode(pose, data, size)) {
    add(channel, pose, utc_ns, now_ns);
  } else if (decode(state, data, size)) {
    add(channel, state, utc_ns, now_ns);
  } else if (decode(bearings, data, size)) {
    add(bearings, now_ns);
  } else if (decode(pointing, data, size)) {
    add(channel, pointing, utc_ns, now_ns);
  } else if (decode(spin, data, size)) {
    add(channel, spin, utc_ns, now_ns);
  } else if (decode(status, data, size)) {
    add(status, now_ns);
  } else if (decode(preview, data, size)) {
    add(channel, preview, utc_ns, now_ns);
  } else if (clock_exchange_t clock; !decode(clock, data, size)) {  // between daemons: no row
    ++left_out_.foreign;
  }
}

SourceRow* SourceTable::row_of(const SourceKey& key) {
  const auto at = rows_.find(key);
  if (at != rows_.end()) return &at->second;
  if (rows_.size() < kMaxRows) return &rows_[key];
  ++left_out_.too_many;
  return nullptr;
}

// A source numbers the messages of all its stations on a target together.
void SourceTable::count_gap(const SourceKey& key, SourceRow& row, std::int64_t sequence) {
  const auto [last, first] = sequences_.try_emplace({key.channel, key.source, key.target, 0}, sequence);
  if (!first && sequence > last->second) row.lost += sequence - last->second - 1;
  last->second = sequence;
}

void SourceTable::arrived(SourceRow& row, bool valid, double age_s, std::int64_t now_ns) {
  row.heard_ns = now_ns;
  ++row.version;
  if (!valid) {
    ++row.refused;
    return;
  }
  ++received_;
  row.valid_ns = now_ns;
  row.age_at_arrival_s = age_s;
  row.arrivals_ns.push_back(now_ns);
  if (row.arrivals_ns.size() > kMaxArrivals) row.arrivals_ns.pop_front();
}

void SourceTable::add(const std::string& channel, const pose_t& message, std::int64_t utc_ns, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  ReceivedPose pose = received_pose(channel, message, utc_ns);
  const SourceKey key{channel, message.source, message.target, pose.station};
  SourceRow* row = row_of(key);
  if (row == nullptr) return;
  count_gap(key, *row, message.sequence);
  arrived(*row, pose.pose.has_value(), pose.age_s, now_ns);
  row->by = kept(message.station_or_camera);
  row->status = kept(message.status);
  row->flags = kept(message.flags);
  if (!pose.pose) return;
  const std::string found = sight_.add(pose, now_ns);
  if (!found.empty()) event(found);
  row->details = details_of(message);
  row->pose = std::move(pose);
}

void SourceTable::add(const std::string& channel, const pointing_t& message, std::int64_t utc_ns, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  const SourceKey key{channel, message.source, message.target, 0};
  SourceRow* row = row_of(key);
  if (row == nullptr) return;
  count_gap(key, *row, message.sequence);
  arrived(*row, message.valid != 0, age_of(utc_ns, message.utime), now_ns);
  row->by = kept(message.station_or_camera);
  row->status = kept(message.status);
  row->flags = kept(message.flags);
  if (message.valid == 0) return;
  row->axis = {vector_of(message.axis_station), message.pitch_rad, message.yaw_rad, message.sigma_axis_rad};
}

void SourceTable::add(const std::string& channel, const spin_t& message, std::int64_t utc_ns, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  const SourceKey key{channel, message.source, message.target, 0};
  SourceRow* row = row_of(key);
  if (row == nullptr) return;
  count_gap(key, *row, message.sequence);
  arrived(*row, message.valid != 0, age_of(utc_ns, message.utime), now_ns);
  row->by = kept(message.station_or_camera);
  row->status = kept(message.status);
  if (message.valid == 0) return;
  row->spin = {vector_of(message.rate_rad_s), message.sigma_rate_rad_s};
}

void SourceTable::add(const std::string& channel, const target_state_t& message, std::int64_t utc_ns,
                      std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  ReceivedPose state = received_state(channel, message, utc_ns);
  const SourceKey key{channel, kFusionSource, message.target, 0};
  SourceRow* row = row_of(key);
  if (row == nullptr) return;
  count_gap(key, *row, message.sequence);
  arrived(*row, state.pose.has_value(), state.age_s, now_ns);
  row->by = kFusionSource;
  if (!row->status.empty() && row->status != state.status) {
    event(fmt::format("{} {} fused state: {}", clock_text(message.utime), message.target, state.status));
  }
  row->status = kept(state.status);
  row->flags = kept(state.flags);
  row->fused = state.fused;
  if (!state.pose) return;
  const std::string found = sight_.add(state, now_ns);
  if (!found.empty()) event(found);
  row->details = {"vehicle", "target", 0.0, 0, std::nullopt};
  row->pose = std::move(state);
}

void SourceTable::add(const bearings_t& message, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  const SourceKey key{"", message.source, message.target, static_cast<std::uint8_t>(message.station)};
  if (!sights_.contains(key) && sights_.size() >= kMaxRows) {
    ++left_out_.too_many;
    return;
  }
  Sights sights;
  sights.arrived_ns = now_ns;
  sights.calibrated = message.calibrated != 0;
  for (const bearing_t& bearing : message.bearings) {
    std::optional<SensorSight>& sensor = sights.sensors[static_cast<std::size_t>(bearing.sensor)];
    if (!sensor) sensor.emplace();
    sensor->used = sensor->used || bearing.used != 0;
    std::optional<double>& ratio = bearing.axis == 0 ? sensor->x_over_z : sensor->y_over_z;
    // Of two hits, a reflection and the true one, the one that was used is shown.
    if (!ratio || bearing.used != 0) ratio = 1.0 / std::tan(bearing.ideal_theta_rad);
  }
  Sights& newest = sights_[key];
  if (now_ns - newest.arrived_ns < kCycle_ns) add_other_axis(sights, newest);
  newest = sights;
}

void SourceTable::add(const status_t& message, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  const std::string host = kept(message.host);
  if (!daemons_.contains(host) && daemons_.size() >= kMaxDaemons) {
    ++left_out_.too_many;
    return;
  }
  ++received_;
  DaemonState& daemon = daemons_[host];
  if (!daemon.state.empty() && daemon.state != message.state) {
    event(fmt::format("{} {} is {}{}", clock_text(message.utime), host, message.state,
                      message.message.empty() ? "" : ": " + message.message));
  }
  daemon = {kept(message.version), kept(message.state), kept(message.message), now_ns, {}};
  for (const source_status_t& source : message.sources) {
    if (daemon.sources.size() >= kMaxRows) break;
    daemon.sources[{kept(source.source), kept(source.target)}] = {
        kept(source.state), kept(source.message),
        source.data_age_us < 0 ? -1.0 : static_cast<double>(source.data_age_us) * 1e-6, ptp_of(source)};
  }
}

void SourceTable::add(const std::string& channel, preview_t& message, std::int64_t utc_ns, std::int64_t now_ns) {
  if (!host::is_possible(message)) {
    ++left_out_.impossible;
    return;
  }
  auto at = std::find_if(previews_.begin(), previews_.end(), [&](const CameraPreview& one) {
    return one.channel == channel && one.source == message.source && one.view == message.view &&
           one.target == message.target;
  });
  if (at == previews_.end()) {
    if (previews_.size() >= kMaxPreviews) {
      ++left_out_.too_many;
      return;
    }
    previews_.push_back({});
    at = previews_.end() - 1;
    at->channel = channel;
    at->source = message.source;
    at->view = message.view;
    at->target = message.target;
  } else if (message.sequence > at->sequence) {
    at->lost += message.sequence - at->sequence - 1;
  }
  at->camera = kept(message.station_or_camera);
  at->status = kept(message.status);
  at->utime_us = message.utime;
  at->age_at_arrival_s = age_of(utc_ns, message.utime);
  at->heard_ns = now_ns;
  at->sequence = message.sequence;
  ++at->received;
  at->jpeg = std::make_shared<const std::vector<std::uint8_t>>(std::move(message.data));
}

void SourceTable::tick(std::int64_t utc_ns, std::int64_t now_ns) {
  for (const std::string& line : sight_.lost(utc_ns, now_ns)) event(line);
  for (auto& [key, row] : rows_) {
    while (!row.arrivals_ns.empty() && row.arrivals_ns.front() <= now_ns - kSecond_ns) row.arrivals_ns.pop_front();
  }
}

void SourceTable::event(std::string text) {
  events_.push_back({++events_told_, kept(text)});
  if (events_.size() > kMaxEvents) events_.pop_front();
}

const Sights* SourceTable::sights_of(const SourceKey& key) const {
  const auto at = sights_.find({"", key.source, key.target, key.station});
  return at == sights_.end() ? nullptr : &at->second;
}

const SourceHealth* SourceTable::health_of(const SourceKey& key) const {
  for (const auto& [host, daemon] : daemons_) {
    const auto at = daemon.sources.find({key.source, key.target});
    if (at != daemon.sources.end()) return &at->second;
    if (key.source != kFusionSource) continue;
    for (const auto& [name, health] : daemon.sources) {  // a state does not tell whose daemon's it is
      if (name.first.starts_with("fusion/") && name.second == key.target) return &health;
    }
  }
  return nullptr;
}

}  // namespace pharos::tools
