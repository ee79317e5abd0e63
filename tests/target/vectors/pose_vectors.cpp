// SPDX-License-Identifier: Apache-2.0
// Bearings of one cycle -> pose, covariance, precision factors, second solution, or a refusal.
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/pose/solve.hpp"
#include "pharos/pose/warm.hpp"
#include "tests/target/vectors/problem.hpp"
#include "tests/target/vectors/result_line.hpp"
#include "tests/target/vectors/vectors.hpp"

namespace pharos::test {
namespace {

void print(const char* key, const LighthouseFromBody& pose) {
  ResultLine line(key);
  for (int i = 0; i < 9; ++i) line << pose.R.data()[i];
  line << pose.t.x() << pose.t.y() << pose.t.z();
}

void print_covariance(const Matrix6& covariance) {
  ResultLine line("covariance");
  for (int i = 0; i < 36; ++i) line << covariance.data()[i];
}

void print(const LighthousePoseEstimate& estimate) {
  print("pose", estimate.pose);
  ResultLine("estimate") << estimate.observations << estimate.ambiguous();
  ResultLine("residual") << estimate.residual_rms;
  print_covariance(estimate.covariance);
  ResultLine("precision") << estimate.adop_deg_per_rad << estimate.pdop_m_per_rad;
  if (estimate.second) print("second", estimate.second->pose);
}

}  // namespace

void print_result(const Result<LighthousePoseEstimate, pose::Refusal>& result) {
  ResultLine("answer") << static_cast<int>(result.error()) << result.ok();
  if (result.ok()) print(*result);
}

namespace {

void print(const pose::Observations& observations) {
  ResultLine line("input");
  for (const auto& o : observations) line << o.sensor << index_of(o.axis) << std::llround(o.theta_rad / kGrid_rad);
}

void solve_vectors(const Target& target, double sigma_rad, std::uint64_t seed) {
  Draw draw(seed);
  const pose::SolveOptions options{.sigma_rad = sigma_rad};
  for (int k = 0; k < 24; ++k) {
    const LighthouseFromBody view = draw_view(target, draw);
    pose::Observations observations = observe(target, view, sigma_rad, draw);
    if (k % 4 == 3) {  // a reflection beside the true hit
      observations.push_back(observations[1]);
      observations.back().theta_rad += 0x1p-7;
    }
    print(observations);
    const auto solution = pose::solve(target, observations, options, k % 3 == 0 ? nullptr : &view);
    if (solution.ok()) {
      print_result(solution->estimate);
      ResultLine("used") << solution->used.count();
    } else {
      print_result(solution.error());
    }
    const auto warm = pose::solve_warm(target, observations, options, view);
    ResultLine("warm_answer") << warm.has_value();
    if (warm) print("warm", warm->estimate.pose);
  }
}

void precision_vectors() {
  const Target target = frustum_target();
  Draw draw(4);
  for (int k = 0; k < 50; ++k) {
    const LighthouseFromBody view = draw_view(target, draw);
    const auto seen = pose::visible_sensors(target, view);
    ResultLine("visible") << seen.to_ulong();
    const auto precision = pose::precision_of(target, view, seen, kPaperRho);
    ResultLine("precision_of") << precision.ok() << precision->adop_deg_per_rad << precision->pdop_m_per_rad;
  }
}

void station_vectors() {
  lighthouse::StationCalibration station;
  station.rotor[0] = {0.0156, 0.0003, -0.0018, -0.327, 0.00425};
  station.rotor[1] = {0.0382, 0.0022, -0.0017, -1.508, -0.00576};
  Draw draw(5);
  for (int k = 0; k < 100; ++k) {
    Vector3 p = Vector3::UnitZ();
    p.x() = draw.real();
    p.y() = draw.real();
    for (const auto form : {lighthouse::ModelForm::kForm1, lighthouse::ModelForm::kForm2}) {
      const double x = lighthouse::raw_theta(station, form, Axis::kX, p);
      const double y = lighthouse::raw_theta(station, form, Axis::kY, p);
      const auto ideal = lighthouse::ideal_from_raw(station, form, {x, y});
      ResultLine("station") << ideal.has_value() << x << y << ideal->x_rad << ideal->y_rad;
    }
  }
}

}  // namespace

void pose_vectors() {
  solve_vectors(frustum_target(), kPaperSigma_rad, 2);
  solve_vectors(top_plate_target(), 5.0 * kPaperSigma_rad, 3);  // coplanar: two poses may fit
  precision_vectors();
  station_vectors();
}

}  // namespace pharos::test
