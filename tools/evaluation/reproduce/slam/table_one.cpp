// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/table_one.hpp"

#include <algorithm>
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
  const char* key;
  const char* name;
  bool good_light, enhanced, loops;
};
constexpr std::array<Variant, 5> kVariants{
    {{"good", "good light", true, false, true},
     {"good-no-loops", "good light, no loops", true, false, false},
     {"low-enhanced", "low light, enhanced", false, true, true},
     {"low-enhanced-no-loops", "low light, enhanced, no loops", false, true, false},
     {"low", "low light, not enhanced", false, false, true}}};

bool wanted(const Variant& variant, const TableOneOptions& options) {
  return std::find(options.runs.begin(), options.runs.end(), variant.key) != options.runs.end();
}

// Turns at which a variant is evaluated, shortest first.
std::vector<double> turns_of(const Variant& variant, const TableOneOptions& options) {
  std::vector<double> turns;
  for (const double turn : options.turns_deg) {
    if (variant.loops || turn >= kLoopFrom_deg) turns.push_back(turn);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

sim::TumblingScenario scenario_of(double turn_deg, bool good_light, const TableOneOptions& options) {
  sim::TumblingScenario scenario;
  scenario.turn_deg = turn_deg;
  scenario.good_light = good_light;
  scenario.povray = options.povray;
  return scenario;
}

int last_frame(double turn_deg) { return static_cast<int>(std::lround(turn_deg / sim::TumblingScenario{}.step_deg)); }

using EightBits = std::array<std::vector<std::uint8_t>, 2>;

// A pair as rendered and, where selected, enhanced.
class Pictures {
 public:
  explicit Pictures(bool enhanced) {
    enhance::EnhanceSettings settings;
    settings.denoiser = enhance::Denoiser::kFast;
    for (auto& enhancer : enhancers_) {
      if (enhanced) enhancer = std::make_unique<enhance::Enhancer>(settings);
    }
  }
  void take(sim::TumblingSequence& sequence, int frame) {
    for (std::size_t side = 0; side < 2; ++side) {
      const host::GreyImage image = sequence.image(frame, static_cast<int>(side));
      width_px_ = image.width_px;
      height_px_ = image.height_px;
      raw_[side].clear();
      for (const std::uint16_t value : image.pixels) raw_[side].push_back(static_cast<std::uint8_t>(value >> 8U));
      if (enhancers_[side] == nullptr) continue;
      bright_[side].resize(raw_[side].size());
      enhance::to_integers(enhancers_[side]->enhance(image.view()).result.view(),
                           ImageView<std::uint8_t>(bright_[side].data(), width_px_, height_px_));
    }
  }
  ImageView<const std::uint8_t> view(bool enhanced, std::size_t side) const {
    return {(enhanced ? bright_ : raw_)[side].data(), width_px_, height_px_};
  }

 private:
  std::array<std::unique_ptr<enhance::Enhancer>, 2> enhancers_;
  EightBits raw_, bright_;
  std::int32_t width_px_ = 0, height_px_ = 0;
};

// Errors are of frames with a pose.
struct Outcome {
  double rmse_deg = 0.0, last_deg = 0.0;
  double attitude_square = 0.0, position_square = 0.0;  // NEES per degree of freedom
  int loops = 0, placed = 0, without_pose = 0;
  bool last_placed = false;
};

double normalised_square(const Vector3& error, const Matrix3& covariance) {
  return error.dot(covariance.inverse() * error) / 3.0;
}

Outcome outcome_of(const slam::SlamSystem& system, const sim::TumblingSequence& sequence) {
  Outcome outcome;
  for (const slam::TrackedFrame& frame : system.optimised_trajectory()) {
    outcome.last_placed = frame.placed.has_value();
    if (!frame.placed) {
      ++outcome.without_pose;
      continue;
    }
    const auto truth = sequence.truth(static_cast<int>(frame.number));
    outcome.last_deg = kDegrees * rotation_angle_between(frame.placed->pose.R, truth.R);
    outcome.rmse_deg += outcome.last_deg * outcome.last_deg;
    // The first one with a pose defines the frame.
    if (outcome.placed++ == 0) continue;
    const Matrix6& covariance = frame.placed->covariance;
    outcome.attitude_square +=
        normalised_square(rotation_log(truth.R * frame.placed->pose.R.transpose()), covariance.topLeftCorner<3, 3>());
    outcome.position_square += normalised_square(truth.t - frame.placed->pose.t, covariance.bottomRightCorner<3, 3>());
  }
  if (outcome.placed > 0) outcome.rmse_deg = std::sqrt(outcome.rmse_deg / outcome.placed);
  const int tracked = std::max(1, outcome.placed - 1);
  outcome.attitude_square /= tracked;
  outcome.position_square /= tracked;
  outcome.loops = system.report().loops;
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
  if (outcome.placed > 0) {
    rows.push_back({item, "attitude RMSE", "deg", rmse, outcome.rmse_deg, ""});
    const char* remark = outcome.last_placed ? "" : "of the last frame with a pose; later ones have none";
    rows.push_back({item, "error of the last attitude", "deg", last, outcome.last_deg, remark});
  }
  if (outcome.placed > 1) {
    const char* remark = "1 where covariances are true";
    rows.push_back({item, "attitude errors over stated ones, squared", "", "", outcome.attitude_square, remark});
    rows.push_back({item, "position errors over stated ones, squared", "", "", outcome.position_square, remark});
  }
  rows.push_back({item, "frames without a pose", "", "", static_cast<double>(outcome.without_pose),
                  outcome.placed > 0 ? "" : "all of them"});
  if (turn_deg >= kLoopFrom_deg) {
    rows.push_back({item, "loops closed", "", "0", static_cast<double>(outcome.loops), ""});
  }
}

// One variant while it processes a sequence.
struct Run {
  const Variant* variant;
  std::vector<double> turns;
  std::unique_ptr<slam::SlamSystem> system;
  std::vector<ComparisonRow> rows;

  void push(const Pictures& pictures, sim::TumblingSequence& sequence, int frame) {
    if (turns.empty() || frame > last_frame(turns.back())) return;
    system->push(0.05 * frame, pictures.view(variant->enhanced, 0), pictures.view(variant->enhanced, 1));
    for (const double turn : turns) {
      if (last_frame(turn) == frame) add_rows(turn, *variant, outcome_of(*system, sequence), rows);
    }
  }
};

void run_light(bool good_light, const TableOneOptions& options, std::vector<ComparisonRow>& rows) {
  std::vector<Run> runs;
  double longest = 0.0;
  bool enhanced = false;
  for (const Variant& variant : kVariants) {
    const std::vector<double> turns = turns_of(variant, options);
    if (variant.good_light != good_light || !wanted(variant, options) || turns.empty()) continue;
    longest = std::max(longest, turns.back());
    enhanced = enhanced || variant.enhanced;
    runs.push_back({&variant, turns, nullptr, {}});
  }
  if (runs.empty()) return;
  sim::TumblingSequence sequence(scenario_of(longest, good_light, options), options.seed);
  for (Run& run : runs) {
    slam::SlamSettings settings;
    settings.features = options.features;
    settings.close_loops = run.variant->loops;
    run.system = slam::make_slam(sequence.rig(), "the simulated rig", settings);
  }
  Pictures pictures(enhanced);
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    pictures.take(sequence, frame);
    for (Run& run : runs) {
      run.push(pictures, sequence, frame);
      if (options.step && frame <= last_frame(run.turns.back())) options.step(1);
    }
  }
  for (const Run& run : runs) rows.insert(rows.end(), run.rows.begin(), run.rows.end());
}

}  // namespace

std::vector<std::string> table_one_runs() {
  std::vector<std::string> keys;
  for (const Variant& variant : kVariants) keys.emplace_back(variant.key);
  return keys;
}

std::size_t table_one_pairs(const TableOneOptions& options) {
  std::size_t pairs = 0;
  for (const Variant& variant : kVariants) {
    const std::vector<double> turns = turns_of(variant, options);
    if (wanted(variant, options) && !turns.empty()) pairs += static_cast<std::size_t>(last_frame(turns.back()) + 1);
  }
  return pairs;
}

std::vector<ComparisonRow> reproduce_table_one(const TableOneOptions& options) {
  std::vector<ComparisonRow> rows;
  for (const bool good_light : {true, false}) run_light(good_light, options, rows);
  return rows;
}

}  // namespace pharos::tools
