// SPDX-License-Identifier: Apache-2.0
// All stages of the portable core, from the edges of a simulated station to a pose on the serial line, under the guard.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pharos {
namespace {

constexpr std::int64_t kSlot_ticks = 416'667;  // between flashes, 120 a second
constexpr std::int64_t kStart_ticks = 1'000'000;
constexpr int kFlashes = 240;  // two seconds
constexpr std::int64_t kHitWidth_ticks = 200;

Target cube_target() {
  Target target;
  std::uint8_t number = 0;
  for (const double x : {-0.06, 0.06}) {
    for (const double y : {-0.06, 0.06}) {
      for (const double z : {-0.06, 0.04}) target.push_back({number++, {x, y, z}, Vector3::Zero()});
    }
  }
  return target;
}

LighthouseFromBody some_pose() { return {rotation_exp({0.4, -0.8, 0.3}), {0.3, -0.2, 2.0}}; }

// Length codes a flash: 62.5 us, one step of 10.42 us for axis y, two for a data bit.
std::int64_t flash_length_ticks(Axis axis, bool data) {
  return std::lround(3125.0 + 520.83 * index_of(axis) + 1041.67 * (data ? 1 : 0));
}

// The light of one ideal station on the photodiodes, in order of time.
std::vector<lighthouse::Edge> edges_of_one_station(const Target& target) {
  std::vector<lighthouse::Edge> edges;
  const auto pulse = [&edges](std::uint8_t sensor, std::int64_t rise, std::int64_t length) {
    edges.push_back({rise, sensor, true});
    edges.push_back({rise + length, sensor, false});
  };
  for (int flash = 0; flash < kFlashes; ++flash) {
    const Axis axis = flash % 2 == 0 ? Axis::kX : Axis::kY;
    const std::int64_t start = kStart_ticks + flash * kSlot_ticks;
    for (const SensorPlacement& s : target) {
      pulse(s.sensor, start, flash_length_ticks(axis, flash % 5 == 0));
      const double theta = lighthouse::raw_theta({}, lighthouse::ModelForm::kForm1, axis, some_pose() * s.position_m);
      const std::int64_t centre = start + std::lround(theta / kTwoPi * 2.0 * static_cast<double>(kSlot_ticks));
      pulse(s.sensor, centre - kHitWidth_ticks / 2, kHitWidth_ticks);
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& one, const auto& other) { return one.stamp_ticks < other.stamp_ticks; });
  return edges;
}

struct Counts {
  int sweeps = 0;
  int sweeps_on_the_line = 0;
  int poses = 0;
  int poses_on_the_line = 0;
};

// Target and host in one program: edges -> sweeps -> bytes -> sweeps -> pose -> bytes -> pose.
class Chain {
 public:
  explicit Chain(const Target& target) : tracker_(target, {}) { tracker_.set_calibration(0, {}); }

  void push(const lighthouse::Edge& edge) {
    decoder_.push(edge);
    while (const auto sweep = decoder_.take_sweep()) {
      ++counts_.sweeps;
      for (const std::uint8_t byte : to_host_.report(*sweep)) receive(byte);
    }
  }
  const Counts& counts() const { return counts_; }

 private:
  void receive(std::uint8_t byte) {
    const auto event = at_host_.push(byte);
    if (!event || !std::holds_alternative<lighthouse::Sweep>(*event)) return;
    ++counts_.sweeps_on_the_line;
    const auto result = tracker_.push(*std::get_if<lighthouse::Sweep>(&*event));
    if (!result || !result->pose.ok()) return;
    ++counts_.poses;
    report::PoseReport pose;
    pose.pose = *result->pose;
    for (const std::uint8_t sent : pose_to_host_.report(pose)) {
      const auto received = pose_at_host_.push(sent);
      if (received && std::holds_alternative<report::PoseReport>(*received)) ++counts_.poses_on_the_line;
    }
  }

  lighthouse::Decoder decoder_;
  report::Reporter to_host_;
  report::LinkDecoder at_host_;
  report::Reporter pose_to_host_;
  report::LinkDecoder pose_at_host_;
  track::EpochTracker tracker_;
  Counts counts_;
};

TEST(NoHeap, FromEdgesToAPoseOnTheLine) {
  const Target target = cube_target();
  const std::vector<lighthouse::Edge> edges = edges_of_one_station(target);

  const test::AllocationGuard guard;
  Chain chain(target);
  for (const auto& edge : edges) chain.push(edge);
  const std::size_t allocations = guard.allocations();

  EXPECT_EQ(allocations, 0u);
  // The guard checks only code that ran.
  EXPECT_GT(chain.counts().sweeps, kFlashes * 9 / 10);
  EXPECT_EQ(chain.counts().sweeps_on_the_line, chain.counts().sweeps);
  EXPECT_GT(chain.counts().poses, kFlashes / 2 * 9 / 10);
  EXPECT_EQ(chain.counts().poses_on_the_line, chain.counts().poses);
}

}  // namespace
}  // namespace pharos
