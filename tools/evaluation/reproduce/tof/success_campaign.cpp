// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/success_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr double kWrong_mm = 10.0;
constexpr double kWrong_deg = 2.0;
constexpr double kWrongSigmas = 5.0;

sim::TofSimulator simulator_of(const CampaignOptions& options) {
  sim::TofScenario scenario;
  scenario.satellite = sim::satellite_of_ring(options.ring_outer_diameter_m);
  if (options.hidden_third) scenario.satellite.occluder = sim::Occluder{};
  scenario.occluder_wanders = true;
  sim::RandomPoses limits;
  limits.count = options.frames;
  limits.min_range_m = options.min_range_m;
  limits.max_range_m = options.max_range_m;
  scenario.poses = sim::random_poses(limits, scenario.satellite, sim::PixelRays(scenario.lens),
                                     sim::RandomStream(options.seed, "campaign poses"));
  return {std::move(scenario), options.seed};
}

CampaignFrame judge(const tof::TofPose& measured, const tof::CameraFromTarget& truth) {
  CampaignFrame frame;
  const Vector6 error = pose_difference(truth, measured.target.pose);
  const Matrix6& covariance = measured.target.covariance;
  frame.error_mm = error.tail<3>().norm() * kMmPerM;
  frame.error_deg = error.head<3>().norm() / kRadPerDeg;
  frame.nees = mahalanobis_squared<6>(error, covariance);
  if (!measured.has_turn()) {
    // The turn about Z' was not measured: only where Z' points can be wrong.
    const Vector3 cross = truth.R.col(2).cross(measured.target.pose.R.col(2));
    frame.error_deg = std::asin(std::min(1.0, cross.norm())) / kRadPerDeg;
  }
  const bool off = frame.error_mm > kWrong_mm || frame.error_deg > kWrong_deg;
  const bool beyond = frame.nees > kWrongSigmas * kWrongSigmas;
  frame.outcome = off && beyond          ? "wrong"
                  : off                  ? "off"
                  : measured.ambiguous() ? "ambiguous"
                  : measured.has_turn()  ? "ok"
                                         : "five_dof";
  if (off && measured.ambiguous()) frame.outcome = "ambiguous";  // it says that it may be the other one
  return frame;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string others(const CampaignResult& result) {
  std::string text;
  for (const auto& [outcome, count] : result.outcomes) {
    if (outcome != "ok") text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + outcome;
  }
  return "of " + std::to_string(result.frames) + (text.empty() ? "" : ": " + text);
}

}  // namespace

CampaignResult run_campaign(const CampaignOptions& options, const std::function<void(const CampaignFrame&)>& seen) {
  sim::TofSimulator simulator = simulator_of(options);
  const DepthCamera camera = depth_camera_of(simulator.scenario());
  const auto workspace = std::make_unique<tof::TofWorkspace>();
  CampaignResult result;
  std::vector<double> errors_mm;
  std::vector<double> errors_deg;
  for (int number = options.first; number < simulator.frames(); ++number) {
    const sim::TofPixels pixels = simulator.pixels(number);
    const auto measured = tof::measure_tof_pose(frame_of(pixels), camera, {}, *workspace);
    CampaignFrame frame;
    if (measured) {
      frame = judge(*measured, simulator.truth(number).T_camera_target);
    } else {
      frame.outcome = tof::name_of(measured.error());
    }
    frame.number = number;
    ++result.frames;
    ++result.outcomes[frame.outcome];
    if (frame.outcome == "wrong") ++result.wrong;
    if (frame.outcome == "ok") {
      ++result.good;
      result.mean_nees += frame.nees;
      errors_mm.push_back(frame.error_mm);
      errors_deg.push_back(frame.error_deg);
    }
    seen(frame);
  }
  if (result.good > 0) result.mean_nees /= result.good;
  result.median_mm = median(errors_mm);
  result.median_deg = median(errors_deg);
  return result;
}

std::vector<ComparisonRow> reproduce_success(int frames, std::uint64_t seed) {
  std::vector<ComparisonRow> rows;
  for (const auto& [diameter_m, min_m, max_m, name] : {std::tuple{1.1, 2.5, 6.0, "ring of 1.1 m, 2.5 to 6 m"},
                                                       std::tuple{0.6, 1.5, 4.0, "ring of 0.6 m, 1.5 to 4 m"}}) {
    Progress progress(name, "frames", static_cast<std::size_t>(frames));
    const CampaignOptions options{diameter_m, min_m, max_m, frames, seed, true};
    const CampaignResult result = run_campaign(options, [&progress](const CampaignFrame&) { progress.step(); });
    const std::string what = std::string(name) + ", a third hidden: ";
    rows.push_back(
        {"success", what + "frames with a pose", "%", ">= 99.5", 100.0 * result.good / result.frames, others(result)});
    rows.push_back({"success", what + "wrong poses called good", "", "<= 0", 1.0 * result.wrong,
                    "more than 5 sigma and 10 mm or 2 deg off"});
    rows.push_back({"success", what + "position error (median)", "mm", "", result.median_mm, ""});
    rows.push_back({"success", what + "attitude error (median)", "deg", "", result.median_deg, ""});
    rows.push_back({"success", what + "squared error over covariance (mean)", "", "6", result.mean_nees, ""});
  }
  return rows;
}

}  // namespace pharos::tools
