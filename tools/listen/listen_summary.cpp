// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/listen_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/support/printable.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kMsPerNs = 1e-6;

double root_mean(double sum, std::int64_t count) {
  return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

std::string error_text(const char* what, const ErrorSums& error) {
  if (error.count == 0) return "";
  std::string text =
      fmt::format("  {} ({} poses): {:.3f} deg RMS, {:.3f} deg largest; {:.2f} mm RMS, {:.2f} mm largest", what,
                  error.count, error.rms_rotation_rad() * kDegPerRad, error.max_rotation_rad * kDegPerRad,
                  error.rms_position_m() * kMmPerM, error.max_position_m * kMmPerM);
  if (error.with_nees > 0) text += fmt::format("; NEES {:.2f} (1: as stated)", error.mean_nees());
  return text + '\n';
}

}  // namespace

PoseError pose_error(const LighthouseFromBody& measured, const LighthouseFromBody& truth, bool has_turn) {
  const Vector6 delta = pose_difference(measured, truth);
  if (has_turn) return {delta.head<3>().norm(), delta.tail<3>().norm()};
  const Vector3 z = measured.R.col(2);
  const Vector3 true_z = truth.R.col(2);
  return {std::atan2(z.cross(true_z).norm(), z.dot(true_z)), delta.tail<3>().norm()};
}

std::optional<double> pose_nees(const LighthouseFromBody& measured, const LighthouseFromBody& truth,
                                const Matrix6& covariance) {
  const auto information = positive_inverse<6>(covariance);
  if (!information) return std::nullopt;
  const Vector6 delta = pose_difference(truth, measured);
  return delta.dot(*information * delta) / static_cast<double>(delta.size());
}

void ErrorSums::add(const PoseError& error) {
  ++count;
  squared_rotation_rad2 += error.rotation_rad * error.rotation_rad;
  squared_position_m2 += error.position_m * error.position_m;
  max_rotation_rad = std::max(max_rotation_rad, error.rotation_rad);
  max_position_m = std::max(max_position_m, error.position_m);
  if (!error.nees) return;
  ++with_nees;
  nees += *error.nees;
}

double ErrorSums::rms_rotation_rad() const { return root_mean(squared_rotation_rad2, count); }
double ErrorSums::rms_position_m() const { return root_mean(squared_position_m2, count); }

bool ListenSummary::has_room(const ReceivedPose& pose) const {
  return streams_.size() < kMaxStreams || streams_.contains({pose.channel, pose.target, pose.station, pose.source});
}

double ListenSummary::add(const ReceivedPose& pose, std::int64_t monotonic_ns) {
  Stream& stream = streams_[{pose.channel, pose.target, pose.station, pose.source}];
  SourceSummary& summary = stream.summary;
  summary.channel = pose.channel;
  summary.source = pose.source;
  summary.target = pose.target;
  summary.station = pose.station;
  if (pose.of_camera || pose.fused) summary.camera = pose.station_id;
  const auto [last, first] = last_sequence_.try_emplace({pose.channel, pose.source + '/' + pose.target}, pose.sequence);
  if (!first && pose.sequence > last->second) summary.lost += pose.sequence - last->second - 1;
  last->second = pose.sequence;
  if (!pose.pose) {
    ++summary.refused;
    return 0.0;
  }
  if (summary.poses == 0) stream.first_utime_us = pose.utime_us;
  ++poses_;
  ++summary.poses;
  summary.seconds = static_cast<double>(pose.utime_us - stream.first_utime_us) * 1e-6;
  summary.age.add(static_cast<std::int64_t>(pose.age_s * 1e9));
  stream.arrivals_ns.push_back(monotonic_ns);
  while (stream.arrivals_ns.front() <= monotonic_ns - kSecond_ns) stream.arrivals_ns.pop_front();
  return static_cast<double>(stream.arrivals_ns.size());
}

void ListenSummary::add_error(const ReceivedPose& pose, const PoseError& error) {
  SourceSummary& summary = streams_[{pose.channel, pose.target, pose.station, pose.source}].summary;
  const bool uncalibrated = pose.flags.find("uncalibrated") != std::string::npos;
  (uncalibrated ? summary.uncalibrated_error : summary.error).add(error);
}

std::vector<SourceSummary> ListenSummary::sources() const {
  std::vector<SourceSummary> result;
  for (const auto& [key, stream] : streams_) result.push_back(stream.summary);
  return result;
}

std::string summary_text(const std::vector<SourceSummary>& sources) {
  std::string out;
  for (const SourceSummary& source : sources) {
    std::string by = source.camera.empty()            ? fmt::format("station {}", source.station)
                     : source.source == kFusionSource ? kFusionSource
                                                      : "camera " + source.camera;
    const auto same = [&source](const SourceSummary& other) {
      return other.channel == source.channel && other.target == source.target && other.station == source.station;
    };
    if (std::count_if(sources.begin(), sources.end(), same) > 1) by += ", source " + source.source;
    out += host::printable(fmt::format("{}, target {}, {}: {} poses in {:.1f} s ({:.1f}/s), {} refused, {} lost",
                                       source.channel, source.target, by, source.poses, source.seconds,
                                       source.rate_hz(), source.refused, source.lost)) +
           '\n';
    if (source.poses > 0) {
      const auto age_ms = [&](double q) { return static_cast<double>(source.age.quantile_ns(q)) * kMsPerNs; };
      out += fmt::format("  age on arrival: {:.1f} ms median, {:.1f} ms 99 %, {:.1f} ms largest\n", age_ms(0.5),
                         age_ms(0.99), age_ms(1.0));
    }
    out += error_text("error against truth", source.error);
    out += error_text("the same before calibration", source.uncalibrated_error);
  }
  return out.empty() ? "nothing was received\n" : out;
}

}  // namespace pharos::tools
