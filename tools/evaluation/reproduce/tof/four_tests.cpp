// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/four_tests.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/tof/connector_choice.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/evaluation/reproduce/tof/eight_bit.hpp"
#include "tools/evaluation/reproduce/tof/orb/orb_motion.hpp"
#include "tools/evaluation/reproduce/tof/paper_tests.hpp"
#include "tools/plot/curves.hpp"
#include "tools/support/progress.hpp"
#include "tools/tof/paper/paper_pictures.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kTests = kPaperTests;
constexpr std::array<const char*, 6> kNames = {"X", "Y", "Z", "alpha", "beta", "gamma"};
constexpr std::array<const char*, 6> kUnits = {"mm", "mm", "mm", "deg", "deg", "deg"};

// Table 2: means, then standard deviations.
constexpr std::array<std::array<const char*, 6>, kTests> kPublishedMean = {
    {{"-24.9450", "-17.7542", "4160.9610", "2.1898", "-1.1236", "-40.0284"},
     {"-24.7347", "-17.5638", "4161.6241", "2.3504", "-1.3453", "-50.1938"},
     {"-24.8963", "-17.6972", "3160.7328", "2.2107", "-1.0863", "-50.0215"},
     {"-25.0107", "-17.5758", "3161.4673", "-2.7394", "-1.3826", "-50.1332"}}};
constexpr std::array<std::array<const char*, 6>, kTests> kPublishedSigma = {
    {{"0.2714", "0.2437", "2.8402", "0.3269", "0.4944", "0.1210"},
     {"0.2615", "0.2739", "2.7273", "0.3097", "0.4273", "0.1508"},
     {"0.2243", "0.2357", "2.3254", "0.27874", "0.3743", "0.0987"},
     {"0.2386", "0.2466", "2.3649", "0.3672", "0.3581", "0.1264"}}};

// Table 3, less what was done to the target: -10 deg, 1000 mm, -5 deg.
constexpr std::array<std::array<const char*, 6>, kTests - 1> kPublishedError = {
    {{"0.2103", "0.1904", "0.7091", "0.1606", "0.2217", "0.1654"},
     {"0.1616", "0.1334", "0.7926", "0.1397", "0.2590", "0.1723"},
     {"0.1144", "0.1214", "0.7345", "0.0499", "0.2963", "0.1117"}}};
constexpr std::array<std::array<const char*, 6>, kTests - 1> kPublishedOrb = {
    {{"0.8430", "0.7595", "1.0391", "0.4108", "0.3364", "0.9608"},
     {"0.6414", "0.5487", "2.2569", "0.3361", "0.2927", "0.3260"},
     {"0.6837", "0.6268", "0.9582", "0.5835", "0.3681", "0.2732"}}};

// One value of each frame, in the order of the frames; without a pose not numbers.
using Series = std::vector<Values>;
const Values kNoPose = [] {
  Values values{};
  values.fill(std::numeric_limits<double>::quiet_NaN());
  return values;
}();

struct TestResult {
  Spread ours;
  Spread eight_bit;
  Spread paper;                           // its whole chain
  std::map<std::string, int> paper_ends;  // frames without a pose, by the step at which the chain ends
  Spread paper_from_ours;                 // its steps of 2.3 from our ellipses and regions
  Spread orb;                             // pose of this test by ORB from the last test's frames and truth
  Series ours_series, paper_series;
  Series orb_series;  // motion from the frame before: none in truth
};

class FourTests {
 public:
  explicit FourTests(const FourTestsOptions& options)
      : options_(options),
        simulator_(paper_scenario(options.frames), options.seed),
        camera_(depth_camera_of(simulator_.scenario())) {}

  void run() {
    Progress progress("paper 000's tests", "frames", static_cast<std::size_t>(simulator_.frames()));
    for (int frame = 0; frame < simulator_.frames(); ++frame) {
      const auto test = static_cast<std::size_t>(frame / options_.frames);
      const sim::TofPixels pixels = simulator_.pixels(frame);
      if (test == 0) measure_at_rest(pixels, results_[test]);
      measure(pixels, results_[test]);
      if (test > 0) measure_by_orb(frame, pixels, results_[test].orb);
      if (frame % options_.frames == 0) first_ = pixels;
      if (frame % options_.frames == options_.frames - 1) last_first_ = first_;
      progress.step();
    }
  }

  Values truth(std::size_t test) const {
    return values_of(simulator_.truth(static_cast<int>(test) * options_.frames).T_camera_target);
  }
  const TestResult& result(std::size_t test) const { return results_[test]; }
  /// Of the first frame.
  const std::optional<paper000::ChainStages>& stages() const { return stages_; }

 private:
  void measure(const sim::TofPixels& pixels, TestResult& result) {
    const auto pose = tof::measure_tof_pose(frame_of(pixels), camera_, {}, *workspace_);
    const bool answered = pose && pose->has_turn();
    result.ours_series.push_back(answered ? values_of(pose->target.pose) : kNoPose);
    if (answered) result.ours.add(result.ours_series.back());
    const sim::TofPixels coarse = eight_bit_frame(pixels, camera_);
    const auto seen = tof::measure_tof_pose(frame_of(coarse), camera_, {}, *workspace_);
    measure_by_paper(coarse, result);
    if (!seen || !seen->has_turn()) return;
    result.eight_bit.add(values_of(seen->target.pose));
    tof::find_connectors(frame_of(coarse), camera_, workspace_->rays, seen->ring.fit, tof::ConnectorSettings{},
                         workspace_->connector);
    const auto from_ours = paper_pose(coarse, camera_, *seen, *workspace_);
    if (from_ours) result.paper_from_ours.add(values_of(*from_ours));
  }

  void measure_by_paper(const sim::TofPixels& coarse, TestResult& result) {
    paper000::ChainSettings settings;
    settings.printed_threshold = options_.printed_threshold;
    paper000::ChainResult chain = paper000::measure(frame_of(coarse).depth, camera_, settings);
    result.paper_series.push_back(chain.pose ? values_of(*chain.pose) : kNoPose);
    if (chain.pose) {
      result.paper.add(result.paper_series.back());
    } else {
      ++result.paper_ends[std::string(name_of(*chain.failure))];
    }
    if (!stages_) stages_ = std::move(chain.stages);
  }

  // Figure 10: from the frame before, at rest.
  void measure_at_rest(const sim::TofPixels& pixels, TestResult& result) {
    if (!result.ours_series.empty() && previous_.width_px > 0) {
      const auto moved = orb_motion(previous_, pixels, camera_);
      result.orb_series.push_back(moved ? values_of({moved->R, moved->t}) : kNoPose);
    }
    previous_ = pixels;
  }

  // From the last test's first frame to this one, applied to the last test's true pose.
  void measure_by_orb(int frame, const sim::TofPixels& pixels, Spread& spread) const {
    const auto moved = orb_motion(last_first_, pixels, camera_);
    if (!moved) return;
    const sim::CameraFromTarget before = simulator_.truth(frame - options_.frames).T_camera_target;
    spread.add(values_of(*moved * before));
  }

  FourTestsOptions options_;
  sim::TofSimulator simulator_;
  DepthCamera camera_;
  std::unique_ptr<tof::TofWorkspace> workspace_ = std::make_unique<tof::TofWorkspace>();
  std::array<TestResult, kTests> results_;
  sim::TofPixels first_;       // of this test
  sim::TofPixels last_first_;  // of the last one
  sim::TofPixels previous_;    // the frame before, of test 1
  std::optional<paper000::ChainStages> stages_;
};

std::string count_text(const Spread& spread, int frames) {
  return spread.count() == frames ? "" : std::to_string(spread.count()) + " of " + std::to_string(frames) + " frames";
}

std::optional<double> of_count(const Spread& spread, double value) {
  return spread.count() > 0 ? std::optional(value) : std::nullopt;
}

// Why a value is missing, or of how many frames it is.
std::string remark_of(const char* way, const Spread& spread, int frames) {
  if (spread.count() == frames) return "";
  return std::string(way) + ": " + count_text(spread, frames) + (spread.count() == 0 ? " have an answer" : "");
}

std::string joined(const std::string& one, const std::string& other) {
  return one.empty() || other.empty() ? one + other : one + "; " + other;
}

void add_table_two(std::vector<ComparisonRow>& rows, std::size_t test, const TestResult& result, int frames) {
  const std::string name = "test " + std::to_string(test + 1);
  std::string theirs = remark_of("theirs", result.paper, frames);
  for (const auto& [why, count] : result.paper_ends) theirs += ", refused_" + why + " in " + std::to_string(count);
  const std::string remark = joined(theirs, remark_of("ours", result.ours, frames));
  for (std::size_t i = 0; i < 6; ++i) {
    // A coordinate has no ratio.
    ComparisonRow mean{"table 2",
                       name + ": mean of " + kNames[i],
                       kUnits[i],
                       kPublishedMean[test][i],
                       of_count(result.ours, result.ours.mean(i)),
                       remark};
    mean.theirs = of_count(result.paper, result.paper.mean(i));
    mean.comparable = false;
    rows.push_back(mean);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    ComparisonRow sigma{"table 2",
                        name + ": sigma of " + kNames[i],
                        kUnits[i],
                        kPublishedSigma[test][i],
                        of_count(result.ours, result.ours.sigma(i)),
                        remark};
    sigma.theirs = of_count(result.paper, result.paper.sigma(i));
    rows.push_back(sigma);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    rows.push_back({"ours on 8-bit depth", name + ": sigma of " + kNames[i], kUnits[i], kPublishedSigma[test][i],
                    of_count(result.eight_bit, result.eight_bit.sigma(i)),
                    remark_of("ours", result.eight_bit, frames)});
    ComparisonRow steps{"experiment: section 2.3 from our ellipses and regions",
                        name + ": sigma of " + kNames[i],
                        kUnits[i],
                        kPublishedSigma[test][i],
                        std::nullopt,
                        "what the paper's detection has to do with table 2"};
    steps.theirs = of_count(result.paper_from_ours, result.paper_from_ours.sigma(i));
    rows.push_back(steps);
  }
}

// What the means of two tests differ by, less the truth.
Values difference_of(const Spread& from, const Spread& to, const Values& truth_from, const Values& truth_to) {
  Values error{};
  for (std::size_t i = 0; i < 6; ++i) {
    error[i] = std::abs((to.mean(i) - from.mean(i)) - (truth_to[i] - truth_from[i]));
  }
  return error;
}

void add_table_three(std::vector<ComparisonRow>& rows, std::size_t pair, const FourTests& tests, int frames) {
  const TestResult &from = tests.result(pair), &to = tests.result(pair + 1);
  const Values truth_from = tests.truth(pair), truth_to = tests.truth(pair + 1);
  const Values ours = difference_of(from.ours, to.ours, truth_from, truth_to);
  const Values theirs = difference_of(from.paper, to.paper, truth_from, truth_to);
  const bool both = from.paper.count() > 0 && to.paper.count() > 0;
  const std::string name = "tests " + std::to_string(pair + 1) + " and " + std::to_string(pair + 2);
  for (std::size_t i = 0; i < 6; ++i) {
    ComparisonRow row{"table 3",
                      name + ": error of " + kNames[i],
                      kUnits[i],
                      kPublishedError[pair][i],
                      of_count(to.ours, ours[i]),
                      joined(remark_of("theirs", to.paper, frames), remark_of("ours", to.ours, frames))};
    if (both) row.theirs = theirs[i];
    rows.push_back(row);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    ComparisonRow row{"table 3",
                      name + ", ORB: error of " + kNames[i],
                      kUnits[i],
                      kPublishedOrb[pair][i],
                      of_count(to.ours, ours[i]),
                      remark_of("ORB", to.orb, frames)};
    if (to.orb.count() > 0) row.theirs = std::abs(to.orb.mean(i) - truth_to[i]);
    rows.push_back(row);
  }
}

Curve curve_of(const char* name, const char* colour, const Series& series, std::size_t i) {
  Curve curve{name, colour, {}};
  for (std::size_t k = 0; k < series.size(); ++k) curve.points.push_back({static_cast<double>(k) + 1.0, series[k][i]});
  return curve;
}

void add_pictures(const TestResult& rest, const std::filesystem::path& folder, report::PartResult& result) {
  std::vector<CurvePanel> nine, ten;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string title = std::string(kNames[i]) + ", " + kUnits[i];
    nine.push_back(
        {title,
         {curve_of("theirs", "#e1501e", rest.paper_series, i), curve_of("ours", "#00a060", rest.ours_series, i)}});
    ten.push_back({title + ", from the frame before", {curve_of("ORB", "#e1501e", rest.orb_series, i)}});
  }
  write_curves((folder / "figure9.svg").string(), nine, "frame");
  write_curves((folder / "figure10.svg").string(), ten, "frame");
  result.pictures.push_back({"figure 9", "test 1, pose of each frame: theirs on 8-bit depth, ours", "figure9.svg"});
  result.pictures.push_back(
      {"figure 10", "test 1, motion by ORB from frame to frame; gaps: no answer", "figure10.svg"});
}

void add_stages(const paper000::ChainStages& stages, const std::filesystem::path& folder, report::PartResult& result) {
  for (const paper000::StagePicture& picture : paper000::write_stage_pictures((folder / "").string(), stages)) {
    result.pictures.push_back(
        {picture.figure, picture.caption, std::filesystem::path(picture.path).filename().string()});
  }
}

}  // namespace

report::PartResult reproduce_four_tests(const FourTestsOptions& options, const std::filesystem::path& folder) {
  FourTests tests(options);
  tests.run();
  report::PartResult result;
  for (std::size_t test = 0; test < kTests; ++test) {
    add_table_two(result.rows, test, tests.result(test), options.frames);
  }
  for (std::size_t pair = 0; pair + 1 < kTests; ++pair) add_table_three(result.rows, pair, tests, options.frames);
  for (const ComparisonRow& row : reproduce_connector_choice(options.frames, options.seed, options.printed_threshold)) {
    result.rows.push_back(row);
  }
  if (folder.empty()) return result;
  add_pictures(tests.result(0), folder, result);
  if (tests.stages()) add_stages(*tests.stages(), folder, result);
  return result;
}

}  // namespace pharos::tools
