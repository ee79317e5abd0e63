// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/slow_errors.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/mounting/noise_time.hpp"
#include "pharos/base/noise_correlation.hpp"

namespace pharos::calibrate {
namespace {

constexpr int kSteps = 6;
constexpr double kMinFreedom = 0.5;   // else the assumption stays: the rows say nothing of it
constexpr double kShownSigmas = 3.0;  // of the scatter of a mean square

// Root mean square of the sigma of one axis, of those that a pose measures, as the source states them.
struct StatedNoise {
  double rotation_rad = 0.0, position_m = 0.0;
  std::size_t rows = 0;
};

std::vector<StatedNoise> stated_noise(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows) {
  std::vector<StatedNoise> out(input.recordings.size());
  for (const UsedRow& used : rows) {
    const host::SourceRow& row = input.recordings[used.source].rows[used.row];
    const Matrix3 rotation = row.covariance.topLeftCorner<3, 3>();
    const Vector3 axis = row.pose.R.col(2);
    const double all = rotation.trace();
    StatedNoise& noise = out[used.source];
    noise.rotation_rad += row.has_turn ? all / 3.0 : (all - axis.dot(rotation * axis)) / 2.0;
    noise.position_m += row.covariance.bottomRightCorner<3, 3>().trace() / 3.0;
    ++noise.rows;
  }
  for (StatedNoise& noise : out) {
    const auto count = static_cast<double>(std::max<std::size_t>(noise.rows, 1));
    noise.rotation_rad = std::sqrt(noise.rotation_rad / count);
    noise.position_m = std::sqrt(noise.position_m / count);
  }
  return out;
}

// The part of a stated variance that residuals do not show: of one axis, less what the motion takes up (one freedom a
// control point) and the scatter of the mean of squares.
double unseen_fraction(double residual_rms, double stated_sigma, std::size_t rows, std::size_t control_points) {
  const double shown = residual_rms * residual_rms / (3.0 * stated_sigma * stated_sigma);
  const auto freedom = static_cast<double>(std::max<std::size_t>(rows, 1));
  const double taken_up = static_cast<double>(control_points) / freedom;
  return std::max(0.0, 1.0 - shown - taken_up - kShownSigmas * std::sqrt(2.0 / freedom));
}

// The same where noise that moves slowly explains what the motion took up: the scatter of a mean square of as many
// independent draws as the recording has.
double hidden_fraction(double span_s, double noise_time_s) {
  return std::min(1.0, std::sqrt(2.0 * 2.0 * noise_time_s / span_s));
}

}  // namespace

MountingCalibrationInput with_estimated_slow_errors(const MountingCalibrationInput& input,
                                                    const std::vector<UsedRow>& rows,
                                                    const std::vector<double>& enlarged,
                                                    const MountingUnknowns& unknowns) {
  MountingCalibrationInput assumed = input;
  MountingUnknowns present = unknowns;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<SlowEvidence> evidence = slow_evidence(assumed, rows, enlarged, present);
    for (std::size_t s = 0; s < evidence.size(); ++s) {
      const SlowEvidence& told = evidence[s];
      MountingRecording& recording = assumed.recordings[s];
      if (told.rotation_freedom > kMinFreedom) {
        recording.slow_rotation_rad = std::sqrt(told.rotation_rad2 / told.rotation_freedom);
      }
      if (told.position_freedom > kMinFreedom) {
        recording.slow_position_m = std::sqrt(told.position_m2 / told.position_freedom);
      }
    }
  }
  return assumed;
}

std::vector<SourceErrors> source_errors(const MountingCalibrationInput& estimated, const std::vector<UsedRow>& rows,
                                        const MountingUnknowns& unknowns, const std::vector<MountingFit>& fits) {
  const std::vector<StatedNoise> noise = stated_noise(estimated, rows);
  const double span_s = static_cast<double>(unknowns.segments()) * unknowns.knot_s;
  std::vector<SourceErrors> out(noise.size());
  for (std::size_t s = 0; s < out.size(); ++s) {
    const MountingRecording& recording = estimated.recordings[s];
    if (recording.kind == host::SourceKind::kSlam || !(noise[s].rotation_rad > 0.0 && noise[s].position_m > 0.0)) {
      continue;
    }
    const double noise_time = noise_time_s(fits[s], unknowns.knot_s);
    const auto rows_of_source = static_cast<double>(noise[s].rows);
    const double independent = rows_of_source / noise_correlation(noise_time, span_s / rows_of_source);
    const double min_ratio = 1.0 / std::sqrt(std::max(independent * estimated.slow_time_constant_s / span_s, 1.0));
    out[s].noise_time_s = noise_time;
    host::SlowError slow{std::max(recording.slow_rotation_rad / noise[s].rotation_rad, min_ratio),
                         std::max(recording.slow_position_m / noise[s].position_m, min_ratio),
                         estimated.slow_time_constant_s};
    if (s == estimated.given) {
      const auto unseen = [&](double residual_rms, double stated_sigma) {
        return noise_time > 0.0 ? hidden_fraction(span_s, noise_time)
                                : unseen_fraction(residual_rms, stated_sigma, noise[s].rows, unknowns.motion.size());
      };
      slow.rotation_ratio =
          std::max(slow.rotation_ratio, std::sqrt(unseen(fits[s].rms_rotation_rad, noise[s].rotation_rad)));
      slow.position_ratio =
          std::max(slow.position_ratio, std::sqrt(unseen(fits[s].rms_position_m, noise[s].position_m)));
    }
    out[s].slow = slow;
  }
  return out;
}

}  // namespace pharos::calibrate
