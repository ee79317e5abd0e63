// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/source_monitor.hpp"

#include <cmath>

namespace pharos::fusion {
namespace {

constexpr double kKept = 0.9;             // of a sum, per measurement
constexpr double kOutlierWeight = 0.05;   // of one measurement in the fraction of outliers
constexpr double kExplained = 0.8;        // of chi-squared by one offset
constexpr double kMirrored_rad = 0.8;     // mirrored and half-turned rings differ by far more than noise
constexpr double kOtherTarget_m = 0.3;    // no error of a source on the right target
constexpr double kScattered_chi2 = 60.0;  // two gated poses of one cause are within some sigmas of each other
constexpr double kNanosecond_s = 1e-9;
constexpr double kMemory_s = 2.0;     // of InnovationMean
constexpr double kMaxWhitened = 6.0;  // one outlier does not decide

}  // namespace

void ErrorSums::add(const Innovation& in, const TargetMeasurement& m, const Kinematics& mean,
                    const SourceSettings& source) {
  if (!in.ok) return;
  Vector6 time, scale;
  time << mean.rate_rad_s, mean.velocity_m_s;
  scale << Vector3::Zero(), mean.pose.t - source.T_vehicle_sensor.t;
  const auto whiten = [&](const Vector6& direction) {
    Vector6 x = m.directions.rows * direction;
    for (int i = 0; i < in.rank; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= in.factor(i, k) * x[k];
      x[i] /= in.factor(i, i);
    }
    for (int i = in.rank; i < 6; ++i) x[i] = 0.0;
    return x;
  };
  const Vector6 by_time = whiten(time);
  const Vector6 by_scale = whiten(scale);
  total = kKept * total + in.nis;
  time_residual = kKept * time_residual + by_time.dot(in.whitened);
  time_time = kKept * time_time + by_time.squaredNorm();
  scale_residual = kKept * scale_residual + by_scale.dot(in.whitened);
  scale_scale = kKept * scale_scale + by_scale.squaredNorm();
}

void InnovationMean::add(const Innovation& in, std::int64_t time_ns) {
  if (!in.ok) return;
  const auto kept = static_cast<float>(std::exp(-static_cast<double>(time_ns - last_ns) * kNanosecond_s / kMemory_s));
  last_ns = time_ns;
  rank = in.rank;
  sum = kept * sum + in.whitened.cwiseMax(-kMaxWhitened).cwiseMin(kMaxWhitened).cast<float>();
  weight = kept * kept * weight + 1.0F;
}

double ErrorSums::explained_by_time() const {
  return time_time > 0.0 && total > 0.0 ? time_residual * time_residual / (time_time * total) : 0.0;
}

double ErrorSums::explained_by_scale() const {
  return scale_scale > 0.0 && total > 0.0 ? scale_residual * scale_residual / (scale_scale * total) : 0.0;
}

bool SourceMonitor::repeats_pose(const SensorPose& pose) {
  const bool same = seen && pose.R == last_pose.R && pose.t == last_pose.t;
  repeats = same ? repeats + 1 : 0;
  last_pose = pose;
  return same;
}

void SourceMonitor::note_used(std::int64_t time_ns) {
  ever_used = true;
  contributed = true;
  last_used_ns = time_ns;
  last_gated = false;
  gated_run = 0;
  scattered = 0;
  outliers *= 1.0 - kOutlierWeight;
  ++judged;
}

void SourceMonitor::note_gated(std::int64_t time_ns, const Vector6& residual, double apart) {
  if (gated_run == 0) gated_since_ns = time_ns;
  if (gated_run > 0 && apart > kScattered_chi2) ++scattered;
  ++gated_run;
  gated_residual = residual;
  last_gated = true;
  outliers += kOutlierWeight * (1.0 - outliers);
  ++judged;
}

void SourceMonitor::exclude(FaultKind why) {
  excluded = true;
  contributed = false;
  reason = why;
  proof = Proof{};
  gated_run = 0;
  scattered = 0;
  outliers = 0.0;
  judged = 0;
  contradicts_ns = 0;
  confirmed = 0;
}

void SourceMonitor::note_agreement() {
  contradicts_ns = 0;
  confirmed = 0;
}

void SourceMonitor::note_contradiction(std::int64_t time_ns, bool agreed) {
  contradicts_ns = time_ns;
  if (!agreed) confirmed = 0;
  if (agreed && confirmed++ == 0) confirmed_since_ns = time_ns;
}

bool SourceMonitor::contradiction_confirmed(std::int64_t time_ns, const DetectionSettings& detection) const {
  return confirmed >= detection.proof_measurements &&
         static_cast<double>(time_ns - confirmed_since_ns) * kNanosecond_s >= detection.proof_s;
}

FaultKind SourceMonitor::classify(bool slow, const Vector6& residual) const {
  const double rotation = residual.head<3>().norm();
  const double position = residual.tail<3>().norm();
  if (rotation > kMirrored_rad && position < kOtherTarget_m) return FaultKind::kMirrored;
  if (position > kOtherTarget_m) return FaultKind::kWrongTarget;
  if (scattered > 0) return FaultKind::kOutliers;
  const double time = sums.explained_by_time();
  const double scale = sums.explained_by_scale();
  if (time > kExplained && time > scale) return FaultKind::kWrongTime;
  if (scale > kExplained) return FaultKind::kWrongScale;
  return slow ? FaultKind::kRamp : FaultKind::kStep;
}

}  // namespace pharos::fusion
