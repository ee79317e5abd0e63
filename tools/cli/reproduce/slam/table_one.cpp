// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/reproduce/slam/table_one.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "host/support/exact_number.hpp"
#include "host/vision/enhance/enhancer.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::tools {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLoopFrom_deg = 360.0;

// As printed: RMSE and absolute error, deg.
struct Published {
  double turn_deg;
  std::array<double, 2> good, low;
};
constexpr std::array<Published, 6> kTable{{{30.0, {0.177, 0.12}, {0.339, 0.57}},
                                           {60.0, {0.162, 0.03}, {0.455, 0.46}},
                                           {90.0, {0.21, 0.03}, {0.478, 0.42}},
                                           {180.0, {0.181, 0.15}, {0.33, 0.24}},
                                           {360.0, {1.506, 0.6}, {0.559, 3.22}},
                                           {720.0, {0.221, 1.36}, {0.625, 4.47}}}};

struct Variant {
  std::string name;
  bool good_light = true, loops = true;
  std::optional<enhance::Denoiser> enhanced;
};

std::vector<Variant> variants_of(double turn_deg) {
  std::vector<Variant> variants{{"good light", true, true, {}},
                                {"low light, enhanced", false, true, enhance::Denoiser::kFast},
                                {"low light, not enhanced", false, true, {}}};
  if (turn_deg >= kLoopFrom_deg) {
    variants.push_back({"good light, no loops", true, false, {}});
    variants.push_back({"low light, enhanced, no loops", false, false, enhance::Denoiser::kFast});
  }
  return variants;
}

std::vector<std::uint8_t> pixels_of(const host::GreyImage& image, enhance::Enhancer* enhancer) {
  std::vector<std::uint8_t> out(image.pixels.size());
  if (enhancer != nullptr) {
    enhance::to_integers(enhancer->enhance(image.view()).result.view(),
                         ImageView<std::uint8_t>(out.data(), image.width_px, image.height_px));
    return out;
  }
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<std::uint8_t>(image.pixels[k] >> 8U);
  return out;
}

struct Outcome {
  double rmse_deg = 0.0, last_deg = 0.0;
  int loops = 0, without_pose = 0;
};

Outcome run_variant(sim::TumblingSequence& sequence, const Variant& variant, const TableOneOptions& options) {
  slam::SlamSettings settings;
  settings.features = options.features;
  settings.close_loops = variant.loops;
  const auto system = slam::make_slam(sequence.rig(), "the simulated rig", settings);
  std::array<std::unique_ptr<enhance::Enhancer>, 2> enhancers;
  if (variant.enhanced) {
    enhance::EnhanceSettings enhance;
    enhance.denoiser = *variant.enhanced;
    for (auto& enhancer : enhancers) enhancer = std::make_unique<enhance::Enhancer>(enhance);
  }
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    std::array<std::vector<std::uint8_t>, 2> pair;
    host::GreyImage image;
    for (std::size_t side = 0; side < 2; ++side) {
      image = sequence.image(frame, static_cast<int>(side));
      pair[side] = pixels_of(image, enhancers[side].get());
    }
    system->push(0.05 * frame, {pair[0].data(), image.width_px, image.height_px},
                 {pair[1].data(), image.width_px, image.height_px});
    if (options.step) options.step(1);
  }
  system->finish();
  Outcome outcome;
  int placed = 0;
  for (const slam::TrackedFrame& frame : system->trajectory()) {
    if (!frame.placed) {
      ++outcome.without_pose;
      continue;
    }
    const Matrix3 truth = sequence.truth(static_cast<int>(frame.number)).R;
    outcome.last_deg = kDegrees * rotation_angle_between(frame.placed->pose.R, truth);
    outcome.rmse_deg += outcome.last_deg * outcome.last_deg;
    ++placed;
  }
  outcome.rmse_deg = placed > 0 ? std::sqrt(outcome.rmse_deg / placed) : 0.0;
  outcome.loops = system->report().loops;
  return outcome;
}

void add_rows(double turn_deg, const Variant& variant, const Outcome& outcome, std::vector<ComparisonRow>& rows) {
  const std::string item = "table 1, " + std::to_string(static_cast<int>(turn_deg)) + " deg, " + variant.name;
  std::string rmse, last;
  for (const Published& published : kTable) {
    if (published.turn_deg != turn_deg) continue;
    const std::array<double, 2>& values = variant.good_light ? published.good : published.low;
    rmse = host::exact_number(values[0]);
    last = host::exact_number(values[1]);
  }
  rows.push_back({item, "attitude RMSE", "deg", rmse, outcome.rmse_deg, ""});
  rows.push_back({item, "error of the last attitude", "deg", last, outcome.last_deg, ""});
  rows.push_back({item, "frames without a pose", "", "", static_cast<double>(outcome.without_pose), ""});
  if (turn_deg >= kLoopFrom_deg) {
    rows.push_back({item, "loops closed", "", "0", static_cast<double>(outcome.loops), ""});
  }
}

sim::TumblingScenario scenario_of(double turn_deg, const Variant& variant, const TableOneOptions& options) {
  sim::TumblingScenario scenario;
  scenario.turn_deg = turn_deg;
  scenario.good_light = variant.good_light;
  scenario.povray = options.povray;
  return scenario;
}

}  // namespace

std::size_t table_one_pairs(const TableOneOptions& options) {
  std::size_t pairs = 0;
  for (const double turn_deg : options.turns_deg) {
    pairs += variants_of(turn_deg).size() * static_cast<std::size_t>(std::lround(2.0 * turn_deg) + 1);
  }
  return pairs;
}

std::vector<ComparisonRow> reproduce_table_one(const TableOneOptions& options) {
  std::vector<ComparisonRow> rows;
  for (const double turn_deg : options.turns_deg) {
    for (const Variant& variant : variants_of(turn_deg)) {
      sim::TumblingSequence sequence(scenario_of(turn_deg, variant, options), options.seed);
      add_rows(turn_deg, variant, run_variant(sequence, variant, options), rows);
    }
  }
  return rows;
}

}  // namespace pharos::tools
