// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/four_tests.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/evaluation/reproduce/tof/eight_bit.hpp"
#include "tools/evaluation/reproduce/tof/orb/orb_motion.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kTests = 4;
constexpr std::array<const char*, 6> kNames = {"X", "Y", "Z", "alpha", "beta", "gamma"};
constexpr std::array<const char*, 6> kUnits = {"mm", "mm", "mm", "deg", "deg", "deg"};

// Table 2: standard deviations.
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

using Values = std::array<double, 6>;  // X, Y, Z in mm; angles (8) in degrees

Values values_of(const tof::CameraFromTarget& pose) {
  const sim::PaperAngles angles = sim::angles_of(pose.R);
  return {pose.t.x() * kMmPerM, pose.t.y() * kMmPerM, pose.t.z() * kMmPerM,
          angles.alpha_deg,     angles.beta_deg,      angles.gamma_deg};
}

// Running mean and deviation.
class Spread {
 public:
  void add(const Values& values) {
    ++count_;
    for (std::size_t i = 0; i < 6; ++i) {
      const double step = values[i] - mean_[i];
      mean_[i] += step / count_;
      squares_[i] += step * (values[i] - mean_[i]);
    }
  }
  int count() const { return count_; }
  double mean(std::size_t i) const { return mean_[i]; }
  double sigma(std::size_t i) const { return count_ > 1 ? std::sqrt(squares_[i] / (count_ - 1)) : 0.0; }

 private:
  int count_ = 0;
  Values mean_{};
  Values squares_{};
};

struct TestResult {
  Spread ours;
  Spread eight_bit;
  Spread paper;
  Spread orb;  // pose of this test by ORB from the last test's frames and truth
};

sim::TofScenario paper_scenario(int frames) {
  constexpr std::array<Values, kTests> kPoses = {{{-24.9, -17.7, 4161.0, 2.2, -1.1, -40.0},
                                                  {-24.9, -17.7, 4161.0, 2.2, -1.1, -50.0},
                                                  {-24.9, -17.7, 3161.0, 2.2, -1.1, -50.0},
                                                  {-24.9, -17.7, 3161.0, -2.8, -1.1, -50.0}}};
  sim::TofScenario scenario;
  for (const Values& v : kPoses) {
    sim::CameraFromTarget pose;
    pose.t = Vector3(v[0], v[1], v[2]) / kMmPerM;
    pose.R = sim::attitude_of({v[3], v[4], v[5]});
    scenario.poses.insert(scenario.poses.end(), static_cast<std::size_t>(frames), pose);
  }
  return scenario;
}

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

 private:
  void measure(const sim::TofPixels& pixels, TestResult& result) {
    const auto pose = tof::measure_tof_pose(frame_of(pixels), camera_, {}, *workspace_);
    if (pose && pose->has_turn()) result.ours.add(values_of(pose->target.pose));
    const sim::TofPixels coarse = eight_bit_depth(pixels, simulator_.scenario().depth);
    const auto seen = tof::measure_tof_pose(frame_of(coarse), camera_, {}, *workspace_);
    if (!seen || !seen->has_turn()) return;
    result.eight_bit.add(values_of(seen->target.pose));
    tof::find_connectors(frame_of(coarse), camera_, workspace_->rays, seen->ring.fit, tof::ConnectorSettings{},
                         workspace_->connector);
    const auto published_way = paper_pose(coarse, camera_, *seen, *workspace_);
    if (published_way) result.paper.add(values_of(*published_way));
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
};

std::string count_text(const Spread& spread, int frames) {
  return spread.count() == frames ? "" : std::to_string(spread.count()) + " of " + std::to_string(frames) + " frames";
}

void add_sigmas(std::vector<ComparisonRow>& rows, std::size_t test, const char* way, const Spread& spread, int frames) {
  for (std::size_t i = 0; i < 6; ++i) {
    rows.push_back({"table 2", "test " + std::to_string(test + 1) + ", " + way + ": sigma of " + kNames[i], kUnits[i],
                    kPublishedSigma[test][i], spread.sigma(i), count_text(spread, frames)});
  }
}

void add_errors(std::vector<ComparisonRow>& rows, std::size_t pair, const char* way,
                const std::array<const char*, 6>& published, const Values& error, const std::string& remark) {
  for (std::size_t i = 0; i < 6; ++i) {
    rows.push_back({"table 3",
                    "tests " + std::to_string(pair + 1) + " and " + std::to_string(pair + 2) + ", " + way +
                        ": error of " + kNames[i],
                    kUnits[i], published[i], std::abs(error[i]), remark});
  }
}

}  // namespace

std::vector<ComparisonRow> reproduce_four_tests(const FourTestsOptions& options) {
  FourTests tests(options);
  tests.run();
  std::vector<ComparisonRow> rows;
  for (std::size_t test = 0; test < kTests; ++test) {
    const TestResult& result = tests.result(test);
    add_sigmas(rows, test, "ours", result.ours, options.frames);
    add_sigmas(rows, test, "ours on 8-bit depth", result.eight_bit, options.frames);
    add_sigmas(rows, test, "the paper's way", result.paper, options.frames);
  }
  for (std::size_t pair = 0; pair + 1 < kTests; ++pair) {
    const TestResult& from = tests.result(pair);
    const TestResult& to = tests.result(pair + 1);
    const Values truth_from = tests.truth(pair);
    const Values truth_to = tests.truth(pair + 1);
    Values ours{};
    Values orb{};
    for (std::size_t i = 0; i < 6; ++i) {
      ours[i] = (to.ours.mean(i) - from.ours.mean(i)) - (truth_to[i] - truth_from[i]);
      orb[i] = to.orb.mean(i) - truth_to[i];
    }
    add_errors(rows, pair, "ours", kPublishedError[pair], ours, count_text(to.ours, options.frames));
    if (to.orb.count() > 0) {
      add_errors(rows, pair, "ORB", kPublishedOrb[pair], orb, count_text(to.orb, options.frames));
    }
  }
  return rows;
}

}  // namespace pharos::tools
