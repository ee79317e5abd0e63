// SPDX-License-Identifier: Apache-2.0
#include "pharos/report/convert.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::report {
namespace {

static_assert(wire::Ootx::kMaxData == lighthouse::kMaxOotxPayload);
static_assert(wire::Lh2Ootx::kMaxData == lighthouse::kMaxOotxPayload);
static_assert(wire::kMaxLh2Channel + 1 == lighthouse::kLh2Channels);
static_assert(wire::kMaxLh2Centre_sixths == lighthouse::lh2_turn_sixths(0));  // channel 0 has the longest turn
static_assert(kNanosecondsPerTick == 20);
// Everything that the decoder outputs fits the line's ranges.
static_assert(wire::kMinPulse_ticks <= lighthouse::kShortestPulse_ticks);
static_assert(wire::kMaxPulse_ticks >= lighthouse::kLongestPulse_ticks);
static_assert(wire::kMinFlash_ticks <= lighthouse::kShortestFlash_ticks);
static_assert(wire::kMaxCentre_half_ticks >= 2 * lighthouse::kSweepWindowEnd_ticks);
static_assert(wire::kMinPeriod_sixteenth_ticks < 16 * lighthouse::kTurn_ticks);
static_assert(wire::kMaxPeriod_sixteenth_ticks > 16 * lighthouse::kTurn_ticks);

/// Only a faulty sender breaks the unit length: doubles keep it to 1e-15.
constexpr double kUnitTolerance = 1e-6;

// Counters as a list of numbers: a line of code for each would be half a kilobyte on the target.
template <class Counters>
using Values = std::array<std::uint32_t, sizeof(Counters) / sizeof(std::uint32_t)>;

template <class Counters>
wire::Counters counters_to_wire(wire::CounterGroup group, std::int64_t time_ticks, const Counters& counters) {
  static_assert(std::tuple_size_v<Values<Counters>> <= wire::Counters::kMaxValues);
  wire::Counters message;
  message.time_ticks = time_ticks;
  message.group = group;
  for (const std::uint32_t value : std::bit_cast<Values<Counters>>(counters)) message.values.push_back(value);
  return message;
}

wire::SweepHead head_of(const lighthouse::Sweep& sweep) {
  wire::SweepHead head;
  head.flash_start_ticks = sweep.flash.start_ticks;
  head.flash_length_ticks = sweep.flash.length_ticks;
  head.period_sixteenth_ticks = sweep.period_sixteenth_ticks;
  head.flash_sensors = sweep.flash.sensors;
  head.flags = sweep.flags;
  head.station = sweep.flash.station;
  head.axis = sweep.flash.axis;
  head.data = sweep.flash.data;
  head.skip = sweep.flash.skip;
  return head;
}

wire::SweepHit to_wire(const lighthouse::Hit& hit) { return {hit.sensor, hit.width_ticks, hit.centre_half_ticks}; }

wire::PoseFields fields_of(const LighthouseFromBody& pose) {
  const Quaternion q = pose.quaternion();
  return {{q.w(), q.x(), q.y(), q.z()}, {pose.t.x(), pose.t.y(), pose.t.z()}};
}

std::optional<LighthouseFromBody> pose_of(const wire::PoseFields& fields) {
  const auto& [w, x, y, z] = fields.orientation_wxyz;
  const Quaternion q(w, x, y, z);
  if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) return std::nullopt;
  const auto& [px, py, pz] = fields.position_m;
  return LighthouseFromBody{q.normalized().toRotationMatrix(), Vector3(px, py, pz)};
}

wire::PoseResult answer_of(const LighthousePoseEstimate& estimate) {
  wire::PoseResult answer;
  answer.pose = fields_of(estimate.pose);
  std::size_t next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      answer.covariance[next++] = static_cast<float>(estimate.covariance(row, column));
    }
  }
  answer.residual_rms_rad = static_cast<float>(estimate.residual_rms);
  answer.adop_deg_per_rad = static_cast<float>(estimate.adop_deg_per_rad);
  answer.pdop_m_per_rad = static_cast<float>(estimate.pdop_m_per_rad);
  answer.iterations = static_cast<std::uint8_t>(std::clamp(estimate.iterations, 0, 255));
  if (estimate.second) {
    answer.second = wire::SecondPose{fields_of(estimate.second->pose), static_cast<float>(estimate.second->delta_chi2)};
  }
  return answer;
}

std::optional<LighthousePoseEstimate> estimate_of(const wire::PoseResult& answer) {
  LighthousePoseEstimate estimate;
  const auto pose = pose_of(answer.pose);
  if (!pose) return std::nullopt;
  estimate.pose = *pose;
  std::size_t next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      const double value = static_cast<double>(answer.covariance[next++]);
      estimate.covariance(row, column) = value;
      estimate.covariance(column, row) = value;
    }
  }
  estimate.residual_rms = static_cast<double>(answer.residual_rms_rad);
  estimate.adop_deg_per_rad = static_cast<double>(answer.adop_deg_per_rad);
  estimate.pdop_m_per_rad = static_cast<double>(answer.pdop_m_per_rad);
  estimate.iterations = answer.iterations;
  if (answer.second) {
    const auto second = pose_of(answer.second->pose);
    if (!second) return std::nullopt;
    estimate.second = {*second, static_cast<double>(answer.second->delta_chi2)};
  }
  return estimate;
}

}  // namespace

wire::Sweep to_wire(const lighthouse::Sweep& sweep) {
  wire::Sweep message{head_of(sweep), {}};
  for (const lighthouse::Hit& hit : sweep.hits) message.hits.push_back(to_wire(hit));
  return message;
}

void write(const SweepInPlace& message, wire::ByteWriter& out) {
  write(head_of(message.sweep), message.sweep.hits.size(), out);
  for (const lighthouse::Hit& hit : message.sweep.hits) write(to_wire(hit), out);
}

lighthouse::Sweep from_wire(const wire::Sweep& message) {
  lighthouse::Sweep sweep;
  sweep.flash.start_ticks = message.flash_start_ticks;
  sweep.flash.length_ticks = message.flash_length_ticks;
  sweep.flash.station = message.station;
  sweep.flash.axis = message.axis;
  sweep.flash.data = message.data;
  sweep.flash.skip = message.skip;
  sweep.flash.sensors = message.flash_sensors;
  sweep.period_sixteenth_ticks = message.period_sixteenth_ticks;
  sweep.flags = message.flags;
  for (const wire::SweepHit& hit : message.hits) {
    sweep.hits.push_back({hit.sensor, hit.width_ticks, hit.centre_half_ticks});
  }
  return sweep;
}

wire::Ootx to_wire(const lighthouse::OotxPayload& payload) {
  return {payload.time_ticks, payload.station, payload.bytes};
}

lighthouse::OotxPayload from_wire(const wire::Ootx& message) {
  return {message.time_ticks, message.station, message.data};
}

wire::Lh2Sweep to_wire(const lighthouse::Lh2Sweep& sweep) {
  wire::Lh2Sweep message;
  // Rounded down, so that the sixths are not negative before time zero.
  const std::int64_t sixths = sweep.sync_sixths % lighthouse::kSixthsPerTick;
  const std::int64_t rest = sixths < 0 ? sixths + lighthouse::kSixthsPerTick : sixths;
  message.sync_ticks = (sweep.sync_sixths - rest) / lighthouse::kSixthsPerTick;
  message.sync_sixths = static_cast<std::uint8_t>(rest);
  message.channel = sweep.channel;
  message.plane = sweep.plane;
  message.slow_bit = sweep.slow_bit;
  for (const lighthouse::Lh2Hit& hit : sweep.hits) {
    message.hits.push_back({hit.sensor, hit.width_ticks, hit.centre_sixths});
  }
  return message;
}

lighthouse::Lh2Sweep from_wire(const wire::Lh2Sweep& message) {
  lighthouse::Lh2Sweep sweep;
  sweep.sync_sixths = message.sync_ticks * lighthouse::kSixthsPerTick + message.sync_sixths;
  sweep.channel = message.channel;
  sweep.plane = message.plane;
  sweep.slow_bit = message.slow_bit;
  for (const wire::Lh2SweepHit& hit : message.hits) {
    sweep.hits.push_back({hit.sensor, hit.width_ticks, hit.centre_sixths});
  }
  return sweep;
}

wire::Lh2Ootx to_wire(const Lh2OotxReport& report) {
  return {report.payload.time_ticks, report.payload.station, report.payload.bytes};
}

Lh2OotxReport from_wire(const wire::Lh2Ootx& message) { return {{message.time_ticks, message.channel, message.data}}; }

wire::Counters to_wire(const DecoderReport& report) {
  return counters_to_wire(wire::CounterGroup::kDecoder, report.time_ticks, report.counters);
}

wire::Counters to_wire(const DeviceReport& report) {
  return counters_to_wire(wire::CounterGroup::kDevice, report.time_ticks, report.counters);
}

DecoderReport decoder_report(const wire::Counters& message) {
  DecoderReport report;
  report.time_ticks = message.time_ticks;
  std::size_t next = 0;
#define PHAROS_X(name, text) \
  if (next < message.values.size()) report.counters.name = message.values[next++];
  PHAROS_DECODER_COUNTERS(PHAROS_X)
#undef PHAROS_X
  return report;
}

DeviceReport device_report(const wire::Counters& message) {
  DeviceReport report;
  report.time_ticks = message.time_ticks;
  std::size_t next = 0;
#define PHAROS_X(name, text) \
  if (next < message.values.size()) report.counters.name = message.values[next++];
  PHAROS_DEVICE_COUNTERS(PHAROS_X)
#undef PHAROS_X
  return report;
}

wire::RawEdge to_wire(const lighthouse::Edge& edge) { return {edge.stamp_ticks, edge.sensor, edge.rising}; }

EdgesReport from_wire(const wire::RawEdges& message) {
  EdgesReport report;
  report.edges_lost = message.edges_lost;
  for (const wire::RawEdge& edge : message.edges) report.edges.push_back({edge.stamp_ticks, edge.sensor, edge.rising});
  return report;
}

wire::Pose to_wire(const PoseReport& report) {
  wire::Pose message;
  message.time_ticks = report.time_ticks;
  message.station = report.station;
  message.flags = report.flags;
  message.observations =
      static_cast<std::uint16_t>(std::clamp(report.observations, 0, int{std::numeric_limits<std::uint16_t>::max()}));
  if (report.pose) {
    message.answer = answer_of(*report.pose);
  } else {
    message.refusal = static_cast<std::uint8_t>(report.pose.error());
  }
  return message;
}

std::optional<PoseReport> from_wire(const wire::Pose& message) {
  if (message.refusal > static_cast<std::uint8_t>(pose::kLastRefusal)) return std::nullopt;
  PoseReport report;
  report.station = message.station;
  report.flags = message.flags;
  report.time_ticks = message.time_ticks;
  report.observations = message.observations;
  if (!message.answer) {
    report.pose = static_cast<pose::Refusal>(message.refusal);
    return report;
  }
  auto estimate = estimate_of(*message.answer);
  if (!estimate) return std::nullopt;
  estimate->time_ns = ticks_to_nanoseconds(message.time_ticks);
  estimate->observations = message.observations;
  report.pose = *estimate;
  return report;
}

}  // namespace pharos::report
