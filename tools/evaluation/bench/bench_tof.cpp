// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_tof.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "pharos/tof/tof_pose.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/sim/tof/tof_simulator.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kTofRepeats = 5;
constexpr std::uint64_t kTofSeed = 1;
constexpr double kTof_ms = 1e3;

using StageSeconds = std::array<double, tof::kTofStages>;

// Sums the time of each stage of one frame.
class StageWatch final : public tof::TofStageListener {
 public:
  void ended(tof::TofStage stage) override {
    const double now = thread_seconds();
    seconds[static_cast<std::size_t>(stage)] += now - last_;
    last_ = thread_seconds();
  }
  StageSeconds seconds{};

 private:
  double last_ = thread_seconds();
};

struct Class {
  double diameter_m;
  double min_range_m;
  double max_range_m;
  bool hidden_third;
};
constexpr std::array<Class, 4> kClasses = {
    {{1.1, 2.5, 6.0, false}, {1.1, 2.5, 6.0, true}, {0.6, 1.5, 4.0, false}, {0.6, 1.5, 4.0, true}}};

sim::TofSimulator simulator_of(const Class& one, int frames) {
  sim::TofScenario scenario;
  scenario.satellite = sim::satellite_of_ring(one.diameter_m);
  if (one.hidden_third) scenario.satellite.occluder = sim::Occluder{};
  scenario.occluder_wanders = true;
  sim::RandomPoses limits;
  limits.count = frames;
  limits.min_range_m = one.min_range_m;
  limits.max_range_m = one.max_range_m;
  scenario.poses = sim::random_poses(limits, scenario.satellite, sim::PixelRays(scenario.lens),
                                     sim::RandomStream(kTofSeed, "bench poses"));
  return {std::move(scenario), kTofSeed};
}

// Stretched so that one pixel of 200 is white: highlights are many times as bright as the ring.
std::vector<std::uint8_t> eight_bits(const std::vector<std::uint16_t>& image) {
  std::vector<std::uint16_t> sorted = image;
  const auto bright = sorted.end() - static_cast<std::ptrdiff_t>(sorted.size() / 200) - 1;
  std::nth_element(sorted.begin(), bright, sorted.end());
  const int white = std::max<int>(1, *bright);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.size());
  for (const std::uint16_t value : image)
    bytes.push_back(static_cast<std::uint8_t>(std::min(255, 255 * value / white)));
  return bytes;
}

struct Times {
  std::array<std::vector<double>, tof::kTofStages> stages;  // of the frames that reached each
  std::vector<double> ellipses, all, peer;
};

class TofTimer {
 public:
  explicit TofTimer(EdgeDrawingFunction peer) : peer_(peer) {}

  void add(const sim::TofPixels& pixels, const DepthCamera& camera) {
    StageSeconds minimum = seconds_of_stages(pixels, camera);
    for (int k = 1; k < kTofRepeats; ++k) {
      const StageSeconds again = seconds_of_stages(pixels, camera);
      for (std::size_t i = 0; i < minimum.size(); ++i) minimum[i] = std::min(minimum[i], again[i]);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < minimum.size(); ++i) {
      if (minimum[i] > 0.0) times_.stages[i].push_back(minimum[i]);
      sum += minimum[i];
    }
    times_.all.push_back(sum);
    times_.ellipses.push_back(minimum[static_cast<std::size_t>(tof::TofStage::kEdges)] +
                              minimum[static_cast<std::size_t>(tof::TofStage::kEllipses)]);
    if (peer_ != nullptr) times_.peer.push_back(peer_seconds(pixels));
  }
  const Times& times() const { return times_; }

 private:
  StageSeconds seconds_of_stages(const sim::TofPixels& pixels, const DepthCamera& camera) {
    StageWatch watch;
    static_cast<void>(tof::measure_tof_pose(frame_of(pixels), camera, {}, *workspace_, &watch));
    return watch.seconds;
  }
  double peer_seconds(const sim::TofPixels& pixels) const {
    const std::vector<std::uint8_t> bytes = eight_bits(pixels.intensity);
    constexpr int kMax = 256;
    std::array<double, 5 * kMax> found{};
    double minimum = 1e9;
    for (int k = 0; k < kTofRepeats; ++k) {
      double seconds = 0.0;
      peer_(bytes.data(), pixels.width_px, pixels.height_px, found.data(), kMax, &seconds);
      minimum = std::min(minimum, seconds);
    }
    return minimum;
  }

  EdgeDrawingFunction peer_;
  std::unique_ptr<tof::TofWorkspace> workspace_ = std::make_unique<tof::TofWorkspace>();
  Times times_;
};

double largest_but_five_percent(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[(values.size() - 1) * 95 / 100];
}

}  // namespace

std::vector<BenchRow> bench_tof(int frames, EdgeDrawingFunction peer) {
  TofTimer timer(peer);
  const int a_class = std::max(1, frames / static_cast<int>(kClasses.size()));
  Progress progress("bench tof", "frames", kClasses.size() * static_cast<std::size_t>(a_class));
  for (const Class& one : kClasses) {
    sim::TofSimulator simulator = simulator_of(one, a_class);
    const DepthCamera camera = depth_camera_of(simulator.scenario());
    for (int k = 0; k < simulator.frames(); ++k) {
      timer.add(simulator.pixels(k), camera);
      progress.step();
    }
  }
  const Times& times = timer.times();
  std::vector<BenchRow> rows;
  const auto add = [&](const std::string& what, double ours, std::optional<double> theirs = std::nullopt) {
    rows.push_back({"depth frame: " + what, kTof_ms * ours, theirs, "ms", true});
  };
  for (std::size_t k = 0; k < tof::kTofStages; ++k) {
    if (!times.stages[k].empty()) add(tof::name_of(static_cast<tof::TofStage>(k)), middle_of(times.stages[k]));
  }
  add("edges and ellipses", middle_of(times.ellipses),
      peer == nullptr ? std::nullopt : std::optional<double>(kTof_ms * middle_of(times.peer)));
  add("all stages, median", middle_of(times.all));
  add("all stages, 95 of 100 frames", largest_but_five_percent(times.all));
  return rows;
}

}  // namespace pharos::tools
