// SPDX-License-Identifier: Apache-2.0
// Rendered images: the four attitudes of paper 003's table 1, fifty more, ranges, passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pointing/pass.hpp"
#include "tools/sim/pointing/pointing_image.hpp"

namespace pharos::pointing {
namespace {

constexpr std::uint64_t kSeed = 1;

pointing::LineOfSight sight_of(const sim::PointingView& view) { return {view.azimuth_rad, view.elevation_rad}; }

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

struct Figures {
  int images = 0, answered = 0;
  std::vector<double> axis_deg, plane_deg, square_deg, plane_sigmas;
  double axis_square = 0.0, plane_square = 0.0;

  void add(const sim::PointingScenario& scenario, std::size_t index) {
    ++images;
    const auto panel = measure_panel(sim::pointing_image(scenario, index, kSeed).view(),
                                     sim::optics_as<PinholeCamera>(scenario.camera));
    if (!panel) return;
    ++answered;
    const PointingResult answer = answer_of(*panel, sight_of(scenario.views[index]), Tone::kLinear);
    const Vector3 truth = scenario.views[index].R_station_body.col(0);
    const double axis = angle_between(answer.axis.axis, truth);
    const double plane = std::abs(std::asin(answer.axis.plane.normal.dot(truth)));
    axis_deg.push_back(axis * kDegPerRad);
    plane_deg.push_back(plane * kDegPerRad);
    plane_sigmas.push_back(plane / answer.axis.sigma_plane_rad);
    axis_square += axis * axis / (answer.axis.sigma_rad() * answer.axis.sigma_rad());
    plane_square += plane_sigmas.back() * plane_sigmas.back();
    if (answer.square_rad) square_deg.push_back(90.0 - *answer.square_rad * kDegPerRad);
  }
  static double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
  }
  double axis_rms() const { return std::sqrt(axis_square / answered); }
  double plane_rms() const { return std::sqrt(plane_square / answered); }
  double maximum(const std::vector<double>& values) const { return *std::max_element(values.begin(), values.end()); }
  void print(const std::string& what) const {
    std::cout << what << ": " << answered << " of " << images << "; axis median " << median(axis_deg) << " deg, worst "
              << maximum(axis_deg) << "; plane median " << median(plane_deg) << " deg, worst " << maximum(plane_deg)
              << "; normalised RMS axis " << axis_rms() << ", plane " << plane_rms() << "; worst plane "
              << maximum(plane_sigmas) << " sigma; off square at most "
              << (square_deg.empty() ? 0.0 : maximum(square_deg)) << " deg\n";
  }
};

std::string scenario_file(const char* name) { return std::string(PHAROS_SCENARIOS) + "/" + name; }

TEST(PointingCampaign, AtAHundredMetresSingleImagesGiveTheAxis) {
  Figures figures;
  for (const char* name : {"line_table1.toml", "line_attitudes.toml"}) {
    const sim::PointingScenario scenario = sim::read_pointing_scenario(scenario_file(name), kSeed);
    for (std::size_t k = 0; k < scenario.views.size(); ++k) figures.add(scenario, k);
  }
  figures.print("100 m");
  EXPECT_GE(figures.answered, 0.95 * figures.images);
  EXPECT_LE(Figures::median(figures.axis_deg), 0.15);
  EXPECT_LE(Figures::median(figures.plane_deg), 0.02);
  EXPECT_GE(figures.axis_rms(), 0.8);
  EXPECT_LE(figures.axis_rms(), 1.2);
  // The plane's sigma is a quarter too large (0.77): profiles reach a panel's cells, whose steps shift opposite edges
  // in mirrored directions.
  EXPECT_GE(figures.plane_rms(), 0.7);
  EXPECT_LE(figures.plane_rms(), 1.2);
  EXPECT_LE(figures.maximum(figures.square_deg), 0.3);
}

class PointingCampaignAt : public ::testing::TestWithParam<double> {};

TEST_P(PointingCampaignAt, TheSigmaStatesWhatIsKnown) {
  const double range_m = GetParam();
  sim::PointingScenario scenario = sim::read_pointing_scenario(scenario_file("line_attitudes.toml"), kSeed);
  scenario.camera.fx_px *= range_m / 100.0;
  scenario.camera.fy_px *= range_m / 100.0;
  scenario.views.resize(12);
  Figures figures;
  for (std::size_t k = 0; k < scenario.views.size(); ++k) {
    scenario.views[k].range_m = range_m;
    figures.add(scenario, k);
  }
  figures.print(std::to_string(range_m) + " m");
  EXPECT_GE(figures.answered, 11);
  EXPECT_LE(figures.maximum(figures.plane_sigmas), 3.0);
  EXPECT_LE(figures.axis_rms(), 1.3);
}
INSTANTIATE_TEST_SUITE_P(OneFiveAndFiveHundredKm, PointingCampaignAt, ::testing::Values(1e3, 5e3, 5e5));

pointing::PassSolution solve(const sim::PointingScenario& scenario, pointing::AttitudeLaw law,
                             const std::vector<pointing::PassImage>& images) {
  const auto workspace = std::make_unique<pointing::PassWorkspace>();
  pointing::PassOptions options;
  options.station = {scenario.station.latitude_rad, scenario.station.longitude_rad, scenario.station.height_m};
  options.law = law;
  return pointing::estimate_pass(images, options, *workspace);
}

class PointingCampaignPass : public ::testing::TestWithParam<pointing::AttitudeLaw> {};

TEST_P(PointingCampaignPass, ReportsTheAxisUnderItsLawAndRejectsAnother) {
  using pointing::AttitudeLaw;
  const AttitudeLaw law = GetParam();
  const std::string name = std::string("line_pass_") + pointing::name_of(law) + ".toml";
  const sim::PointingScenario scenario = sim::read_pointing_scenario(scenario_file(name.c_str()), kSeed);
  std::vector<pointing::PassImage> images;
  for (std::size_t k = 0; k < scenario.views.size(); ++k) {
    const sim::PointingView& view = scenario.views[k];
    const auto panel =
        measure_panel(sim::pointing_image(scenario, k, kSeed).view(), sim::optics_as<PinholeCamera>(scenario.camera));
    if (!panel) continue;
    // No ranges, as at an optical station.
    images.push_back(
        {{view.time_s, sight_of(view), 0.0}, answer_of(*panel, sight_of(view), Tone::kLinear).planes_station});
  }
  const pointing::PassSolution answer = solve(scenario, law, images);
  ASSERT_FALSE(answer.failure) << name << " " << pointing::name_of(*answer.failure);
  // The middle of the pass is between two images.
  const std::size_t half = scenario.views.size() / 2;
  const Vector3 truth =
      (scenario.views[half - 1].R_station_body.col(0) + scenario.views[half].R_station_body.col(0)).normalized();
  const double error_deg = angle_between(answer.estimate.axis_station, truth) * kDegPerRad;
  std::cout << name << ": " << images.size() << " images, error " << error_deg << " deg, sigma "
            << answer.estimate.sigma_rad() * kDegPerRad << ", chi2 " << answer.estimate.chi2 << " of "
            << answer.estimate.degrees_of_freedom << "\n";
  EXPECT_LE(error_deg, 0.3);
  for (const AttitudeLaw wrong : {AttitudeLaw::kInertial, AttitudeLaw::kNadir}) {
    if (wrong == law) continue;
    EXPECT_EQ(solve(scenario, wrong, images).failure, pointing::PassFailure::kLawDoesNotFit) << name;
  }
  // A nadir-locked axis rotates once an orbit in inertial space; an inertial one does not.
  if (law == AttitudeLaw::kInertial) {
    EXPECT_EQ(solve(scenario, AttitudeLaw::kSpin, images).failure, pointing::PassFailure::kSpinNotSeen);
  }
}
std::string law_name(const ::testing::TestParamInfo<pointing::AttitudeLaw>& law) {
  constexpr std::array kNames{"Inertial", "Nadir", "Spin"};
  return kNames[static_cast<std::size_t>(law.param)];
}
INSTANTIATE_TEST_SUITE_P(Laws, PointingCampaignPass,
                         ::testing::Values(pointing::AttitudeLaw::kInertial, pointing::AttitudeLaw::kNadir,
                                           pointing::AttitudeLaw::kSpin),
                         law_name);

}  // namespace
}  // namespace pharos::pointing
