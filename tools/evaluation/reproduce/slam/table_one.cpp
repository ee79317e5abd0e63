// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/table_one.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>

#include "host/images/grey_image.hpp"
#include "host/support/exact_number.hpp"
#include "host/vision/enhance/enhancer.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/evaluation/reproduce/slam/board_rig.hpp"
#include "tools/evaluation/reproduce/slam/nees.hpp"
#include "tools/plot/curves.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::tools {
namespace {

constexpr double kLoopFrom_deg = 360.0;

// As printed: RMSE, absolute error and estimated value, deg.
struct Published {
  double turn_deg;
  std::array<double, 3> good, low;
};
constexpr std::array<Published, 6> kTable{{{30.0, {0.177, 0.12, 29.88}, {0.339, 0.57, 29.43}},
                                           {60.0, {0.162, 0.03, 60.03}, {0.455, 0.46, 59.54}},
                                           {90.0, {0.21, 0.03, 89.97}, {0.478, 0.42, 89.58}},
                                           {180.0, {0.181, 0.15, 179.85}, {0.33, 0.24, 179.76}},
                                           {360.0, {1.506, 0.6, 359.4}, {0.559, 3.22, 356.78}},
                                           {720.0, {0.221, 1.36, 718.64}, {0.625, 4.47, 715.53}}}};

// What is done to a picture: nothing, LIME with our fast denoiser, LIME with BM3D as the paper's.
enum class Treatment : std::uint8_t { kNone, kFast, kBm3d };
constexpr std::size_t kTreatments = 3;

struct Variant {
  const char* key;
  const char* name;
  bool good_light;
  Treatment treatment = Treatment::kNone;
  bool loops = true;
  std::size_t max_keyframes = 0;  // 0: no limit
  bool boards = false;            // cameras calibrated from 15 boards, else the true ones
};
constexpr std::array<Variant, 8> kVariants{
    {{"good", "good light", true},
     {"good-no-loops", "good light, no loops", true, Treatment::kNone, false},
     {"good-20-keyframes", "good light, 20 keyframes", true, Treatment::kNone, true, 20},
     {"good-15-boards", "good light, calibrated from 15 boards", true, Treatment::kNone, true, 0, true},
     {"low-enhanced", "low light, enhanced", false, Treatment::kFast},
     {"low-bm3d", "low light, enhanced with BM3D", false, Treatment::kBm3d},
     {"low-enhanced-no-loops", "low light, enhanced, no loops", false, Treatment::kFast, false},
     {"low", "low light, not enhanced", false}}};

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

// Rendered images, kept in a folder: of the same scenario and seed they are read instead of rendered again. 8 bits, as
// the sequence's own.
class RenderedFrames {
 public:
  explicit RenderedFrames(std::filesystem::path folder) : folder_(std::move(folder)) {}

  host::GreyImage image(sim::TumblingSequence& sequence, int frame, int side) const {
    if (folder_.empty()) return sequence.image(frame, side);
    const std::string file = (folder_ / (std::to_string(frame) + (side == 0 ? "_left.png" : "_right.png"))).string();
    if (std::filesystem::is_regular_file(file)) return host::read_grey_image(file);
    host::GreyImage image = sequence.image(frame, side);
    host::write_grey_png(file, image.view(), 8);
    return image;
  }

 private:
  std::filesystem::path folder_;
};

using EightBits = std::array<std::vector<std::uint8_t>, 2>;

// A pair as rendered and as treated in each way that is wanted.
class Pictures {
 public:
  Pictures(const std::set<Treatment>& wanted, bool video_bm3d) {
    for (const Treatment treatment : wanted) {
      if (treatment == Treatment::kNone) continue;
      enhance::EnhanceSettings settings;
      settings.denoiser = treatment == Treatment::kFast ? enhance::Denoiser::kFast : enhance::Denoiser::kBm3d;
      if (video_bm3d) settings.bm3d = enhance::kVideoBm3d;
      for (auto& enhancer : of(treatment).enhancers) enhancer = std::make_unique<enhance::Enhancer>(settings);
    }
  }
  void take(sim::TumblingSequence& sequence, const RenderedFrames& frames, int frame) {
    for (std::size_t side = 0; side < 2; ++side) {
      const host::GreyImage image = frames.image(sequence, frame, static_cast<int>(side));
      width_px_ = image.width_px;
      height_px_ = image.height_px;
      std::vector<std::uint8_t>& raw = of(Treatment::kNone).pixels[side];
      raw.clear();
      for (const std::uint16_t value : image.pixels) raw.push_back(static_cast<std::uint8_t>(value >> 8U));
      for (Treated& one : treated_) {
        if (one.enhancers[side] == nullptr) continue;
        one.pixels[side].resize(raw.size());
        enhance::to_integers(one.enhancers[side]->enhance(image.view()).result.view(),
                             ImageView<std::uint8_t>(one.pixels[side].data(), width_px_, height_px_));
      }
    }
  }
  ImageView<const std::uint8_t> view(Treatment treatment, std::size_t side) const {
    return {treated_[static_cast<std::size_t>(treatment)].pixels[side].data(), width_px_, height_px_};
  }
  bool has(Treatment treatment) const { return !treated_[static_cast<std::size_t>(treatment)].pixels[0].empty(); }

 private:
  struct Treated {
    std::array<std::unique_ptr<enhance::Enhancer>, 2> enhancers;
    EightBits pixels;
  };
  Treated& of(Treatment treatment) { return treated_[static_cast<std::size_t>(treatment)]; }

  std::array<Treated, kTreatments> treated_;
  std::int32_t width_px_ = 0, height_px_ = 0;
};

// Errors are of frames with a pose.
struct Outcome {
  double rmse_deg = 0.0, last_deg = 0.0;
  double attitude_square = 0.0, position_square = 0.0;  // NEES per degree of freedom
  int loops = 0, placed = 0, without_pose = 0;
  bool last_placed = false;
  // The whole turn about the target's axis: what of the true turn is left by the error about that axis.
  double turned_deg = 0.0;
  std::vector<PlotPoint> estimated, truth;  // turn over the frame's number, deg
};

Outcome outcome_of(const slam::SlamSystem& system, const sim::TumblingSequence& sequence) {
  Outcome outcome;
  // Of the turn in the camera's frame, from one step of it.
  const Vector3 axis = rotation_log(sequence.truth(1).R * sequence.truth(0).R.transpose()).normalized();
  for (const slam::TrackedFrame& frame : system.optimised_trajectory()) {
    outcome.last_placed = frame.placed.has_value();
    if (!frame.placed) {
      ++outcome.without_pose;
      continue;
    }
    const auto truth = sequence.truth(static_cast<int>(frame.number));
    outcome.last_deg = kDegreesPerRadian * rotation_angle_between(frame.placed->pose.R, truth.R);
    outcome.rmse_deg += outcome.last_deg * outcome.last_deg;
    const double true_deg = sim::TumblingScenario{}.step_deg * static_cast<double>(frame.number);
    const double error_deg = kDegreesPerRadian * rotation_log(frame.placed->pose.R * truth.R.transpose()).dot(axis);
    outcome.turned_deg = true_deg + error_deg;
    outcome.truth.push_back({static_cast<double>(frame.number), true_deg});
    outcome.estimated.push_back({static_cast<double>(frame.number), outcome.turned_deg});
    // The first one with a pose defines the frame.
    if (outcome.placed++ == 0) continue;
    const Matrix6& covariance = frame.placed->covariance;
    outcome.attitude_square +=
        nees_of(rotation_log(truth.R * frame.placed->pose.R.transpose()), covariance.topLeftCorner<3, 3>());
    outcome.position_square += nees_of(truth.t - frame.placed->pose.t, covariance.bottomRightCorner<3, 3>());
  }
  if (outcome.placed > 0) outcome.rmse_deg = std::sqrt(outcome.rmse_deg / outcome.placed);
  const int tracked = std::max(1, outcome.placed - 1);
  outcome.attitude_square /= tracked;
  outcome.position_square /= tracked;
  outcome.loops = system.report().loops;
  return outcome;
}

// In percent, with two digits.
std::string relative_error(double estimated_deg, double turn_deg) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2g", 100.0 * std::abs(estimated_deg / turn_deg - 1.0));
  return text.data();
}

void add_rows(double turn_deg, const Variant& variant, const Outcome& outcome, std::vector<ComparisonRow>& rows) {
  const std::string item = "table 1, " + std::to_string(static_cast<int>(turn_deg)) + " deg, " + variant.name;
  std::string rmse, last, estimated, relative;
  for (const Published& published : kTable) {
    if (published.turn_deg != turn_deg) continue;
    const std::array<double, 3>& values = variant.good_light ? published.good : published.low;
    rmse = host::exact_number(values[0]);
    last = host::exact_number(values[1]);
    estimated = host::exact_number(values[2]);
    relative = relative_error(values[2], turn_deg);
  }
  if (outcome.placed > 0) {
    const char* remark = outcome.last_placed ? "" : "of the last frame with a pose; later ones have none";
    rows.push_back({item, "estimated turn", "deg", estimated, outcome.turned_deg, remark});
    rows.push_back({item, "attitude RMSE", "deg", rmse, outcome.rmse_deg, ""});
    rows.push_back({item, "error of the last attitude", "deg", last, outcome.last_deg, remark});
    rows.push_back(
        {item, "relative error", "%", relative, 100.0 * std::abs(outcome.turned_deg / turn_deg - 1.0), remark});
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

const char* figure_of(bool good_light) { return good_light ? "figure 3" : "figure 5"; }

// Figures 3 and 5: the turn over the frames, and how far it is off.
void add_picture(double turn_deg, const Variant& variant, const Outcome& outcome, const std::filesystem::path& folder,
                 report::PartResult& result) {
  const std::string turn = std::to_string(static_cast<int>(turn_deg));
  const std::string file = std::string(variant.key) + "_" + turn + ".svg";
  std::vector<PlotPoint> error = outcome.estimated;
  double largest = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i].y -= outcome.truth[i].y;
    largest = std::max(largest, std::abs(error[i].y));
  }
  write_curves((folder / file).string(),
               {{"turn, deg", {{"truth", "#909090", outcome.truth}, {"ours", "#00a060", outcome.estimated, true}}},
                {"error of the turn, deg", {{"", "#00a060", error}}}},
               "frame");
  const std::string figure = figure_of(variant.good_light);
  result.pictures.push_back({figure, turn + " deg, " + variant.name, file});
  result.rows.push_back({figure, turn + " deg, " + variant.name + ": largest error of the turn", "deg", "",
                         error.empty() ? std::nullopt : std::optional(largest),
                         error.empty() ? "no frame has a pose" : ""});
}

// One variant while it processes a sequence.
struct Run {
  const Variant* variant;
  std::vector<double> turns;
  std::unique_ptr<slam::SlamSystem> system;
  report::PartResult result;
  std::filesystem::path folder;

  void push(const Pictures& pictures, sim::TumblingSequence& sequence, int frame) {
    if (turns.empty() || frame > last_frame(turns.back())) return;
    system->push(0.05 * frame, pictures.view(variant->treatment, 0), pictures.view(variant->treatment, 1));
    for (const double turn : turns) {
      if (last_frame(turn) != frame) continue;
      const Outcome outcome = outcome_of(*system, sequence);
      add_rows(turn, *variant, outcome, result.rows);
      if (!folder.empty()) add_picture(turn, *variant, outcome, folder, result);
    }
  }
};

void write_view(ImageView<const std::uint8_t> view, const std::filesystem::path& path) {
  std::vector<std::uint16_t> pixels;
  for (std::int32_t v = 0; v < view.height_px; ++v) {
    const std::uint8_t* row = view.row(v);
    for (std::int32_t u = 0; u < view.width_px; ++u) pixels.push_back(static_cast<std::uint16_t>(row[u] * 257));
  }
  host::write_grey_png(path.string(), {pixels.data(), view.width_px, view.height_px}, 8);
}

// Figure 2 in good light; in low light, beside figure 5, as it is and enhanced. As it is in the first run of each.
void add_first_views(const TableOneOptions& options, bool good_light, const Pictures& pictures,
                     report::PartResult& result) {
  const std::filesystem::path& folder = options.folder;
  const std::string name = good_light ? "good.png" : "dark.png", first_run = good_light ? "good" : "low-enhanced";
  const bool first = std::find(options.runs.begin(), options.runs.end(), first_run) != options.runs.end();
  if (first) {
    write_view(pictures.view(Treatment::kNone, 0), folder / name);
    result.pictures.push_back(
        {good_light ? "figure 2" : "figure 5",
         good_light ? "the rendered satellite, left camera, first frame" : "in low light as it is, first frame", name});
  }
  if (good_light) return;
  const auto add = [&](Treatment treatment, const char* caption, const char* file) {
    if (!pictures.has(treatment)) return;
    write_view(pictures.view(treatment, 0), folder / file);
    result.pictures.push_back({"figure 5", caption, file});
  };
  if (first) add(Treatment::kFast, "the same by LIME with our fast denoiser", "enhanced.png");
  add(Treatment::kBm3d, "the same by LIME with BM3D", "bm3d.png");
}

// The true cameras, or those of a calibration as the paper's; its figures join `result`.
host::RigFile rig_of(const Variant& variant, const sim::TumblingSequence& sequence, const TableOneOptions& options,
                     report::PartResult& result) {
  if (!variant.boards) return sequence.rig();
  const BoardRig calibrated = rig_from_boards(sequence.rig(), options.seed);
  result.rows.insert(result.rows.end(), calibrated.rows.begin(), calibrated.rows.end());
  return calibrated.rig;
}

void run_light(bool good_light, const TableOneOptions& options, report::PartResult& result) {
  std::vector<Run> runs;
  double longest = 0.0;
  std::set<Treatment> treatments;
  for (const Variant& variant : kVariants) {
    const std::vector<double> turns = turns_of(variant, options);
    if (variant.good_light != good_light || !wanted(variant, options) || turns.empty()) continue;
    longest = std::max(longest, turns.back());
    treatments.insert(variant.treatment);
    runs.push_back({&variant, turns, nullptr, {}, options.folder});
  }
  if (runs.empty()) return;
  sim::TumblingSequence sequence(scenario_of(longest, good_light, options), options.seed);
  for (Run& run : runs) {
    slam::SlamSettings settings;
    settings.features = options.features;
    settings.close_loops = run.variant->loops;
    settings.max_keyframes = run.variant->max_keyframes;
    run.system = slam::make_slam(rig_of(*run.variant, sequence, options, result), "the simulated rig", settings);
  }
  Pictures pictures(treatments, options.video_bm3d);
  const RenderedFrames frames(options.frames);
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    pictures.take(sequence, frames, frame);
    if (frame == 0 && !options.folder.empty()) add_first_views(options, good_light, pictures, result);
    for (Run& run : runs) {
      run.push(pictures, sequence, frame);
      if (options.step && frame <= last_frame(run.turns.back())) options.step(1);
    }
  }
  for (const Run& run : runs) {
    const report::PartResult& one = run.result;
    result.rows.insert(result.rows.end(), one.rows.begin(), one.rows.end());
    result.pictures.insert(result.pictures.end(), one.pictures.begin(), one.pictures.end());
  }
}

}  // namespace

std::vector<std::string> table_one_runs() {
  std::vector<std::string> keys;
  for (const Variant& variant : kVariants) keys.emplace_back(variant.key);
  return keys;
}

std::vector<ComparisonRow> table_one_left_out(bool good_light, const std::vector<double>& turns_deg) {
  std::vector<ComparisonRow> rows;
  for (const Published& published : kTable) {
    if (std::find(turns_deg.begin(), turns_deg.end(), published.turn_deg) != turns_deg.end()) continue;
    const std::string turn = std::to_string(static_cast<int>(published.turn_deg));
    const std::string light = good_light ? "good light" : "low light, enhanced";
    const std::string item = "table 1, " + turn + " deg, " + light;
    const std::array<double, 3>& values = good_light ? published.good : published.low;
    constexpr const char* kRemark = "left out by --quick";
    rows.push_back({figure_of(good_light), turn + " deg, " + light + ": largest error of the turn", "deg", "",
                    std::nullopt, kRemark});
    rows.push_back({item, "estimated turn", "deg", host::exact_number(values[2]), std::nullopt, kRemark});
    rows.push_back({item, "attitude RMSE", "deg", host::exact_number(values[0]), std::nullopt, kRemark});
    rows.push_back({item, "error of the last attitude", "deg", host::exact_number(values[1]), std::nullopt, kRemark});
    rows.push_back({item, "relative error", "%", relative_error(values[2], published.turn_deg), std::nullopt, kRemark});
  }
  return rows;
}

std::size_t table_one_pairs(const TableOneOptions& options) {
  std::size_t pairs = 0;
  for (const Variant& variant : kVariants) {
    const std::vector<double> turns = turns_of(variant, options);
    if (wanted(variant, options) && !turns.empty()) pairs += static_cast<std::size_t>(last_frame(turns.back()) + 1);
  }
  return pairs;
}

report::PartResult reproduce_table_one(const TableOneOptions& options) {
  report::PartResult result;
  for (const bool good_light : {true, false}) run_light(good_light, options, result);
  return result;
}

}  // namespace pharos::tools
