// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/lh2_simulator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/lh2_model.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/sim/lh2_scene.hpp"

namespace pharos::sim {
namespace {

TEST(LaserPlane, LeansAndTurnsAsDescribed) {
  // Straight ahead, level: plane a at a third of a turn, b at two thirds.
  EXPECT_NEAR(turned_angle(0, {}, {0, 0, 2}), kTwoPi / 3, 1e-12);
  EXPECT_NEAR(turned_angle(1, {}, {0, 0, 2}), 2 * kTwoPi / 3, 1e-12);
  // To the left (x negative) later by the azimuth.
  EXPECT_NEAR(turned_angle(0, {}, {-1, 0, 1}) - kTwoPi / 3, kPi / 4, 1e-12);
  // A point above (y negative) straight ahead: a is there before b by its lean.
  const double lean = std::asin(std::tan(kPi / 6) * 0.5);
  EXPECT_NEAR(turned_angle(0, {}, {0, -1, 2}) - kTwoPi / 3, -lean, 1e-12);
  EXPECT_NEAR(turned_angle(1, {}, {0, -1, 2}) - 2 * kTwoPi / 3, lean, 1e-12);
}

// The model that the estimators use was written on its own from the same publication.
TEST(LaserPlane, AgreesWithTheEstimatorsModel) {
  std::mt19937 random(2);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t plane = trial % 2 == 0 ? 0 : 1;
    const PlaneErrors e{in(-0.01, 0.01), in(-0.05, 0.05), in(-0.4, 0.4), in(-3, 3),
                        in(-0.01, 0.01), in(-3, 3),       in(-0.4, 0.4)};
    const lighthouse::PlaneCalibration c{
        e.phase_rad,      e.tilt_rad,      e.curve, e.gibbous_phase_rad, e.gibbous_magnitude_rad,
        e.ogee_phase_rad, e.ogee_magnitude};
    const Vector3 p(in(-1.5, 1.5), in(-1, 1), in(1.5, 4));
    const double ahead = (plane == 0 ? 1 : 2) * kTwoPi / 3;
    EXPECT_NEAR(turned_angle(plane, e, p) - ahead, lighthouse::lh2_angle(c, plane, p), 1e-10);
  }
}

TEST(LightCode, ChangesAtEachBitsBeginningAndInTheMiddleOfOnes) {
  const std::vector<bool> bits = light_bits(channel_code(6).taps[0], 100);
  EXPECT_EQ(level_changes({false, true, true, false}, 0.0, 4.0), (std::vector<double>{0, 1, 1.5, 2, 2.5, 3}));
  EXPECT_EQ(level_changes({false, true, true, false}, 0.6, 2.2), (std::vector<double>{1, 1.5, 2}));
  for (std::size_t i = 0; i < 17; ++i) EXPECT_EQ(bits[i], i == 16);
}

TEST(Lh2Simulator, GivesTheSameLightForTheSameSeed) {
  Lh2Simulator one(lh2_scene(0.3), 4), two(lh2_scene(0.3), 4), other(lh2_scene(0.3), 5);
  bool differs = false;
  for (;;) {
    const auto a = one.next(), b = two.next(), c = other.next();
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) break;
    EXPECT_TRUE(a->time_ticks == b->time_ticks && a->sensor == b->sensor && a->data == b->data);
    differs = differs || !c || c->time_ticks != a->time_ticks;
  }
  EXPECT_TRUE(differs);
  EXPECT_GT(one.passes().size(), 200U);  // 2 planes, 15 turns, 8 sensors, less those turned away
}

TEST(Lh2Simulator, ChangesComeInTheOrderOfTime) {
  LighthouseScenario scenario = lh2_scene(0.5, 2);
  scenario.faults.glitches_per_s = 500;
  Lh2Simulator simulator(scenario, 4);
  std::array<std::int64_t, 32> last{};
  while (const auto change = simulator.next()) {
    EXPECT_GE(change->time_ticks, last[change->sensor]);
    last[change->sensor] = change->time_ticks;
  }
}

TEST(Lh2Scenario, NamesWhatIsNotOfItsGeneration) {
  const test::TemporaryFolder folder;
  const auto error = [&](const std::string& head, const std::string& tail) {
    const std::string path = folder.path("s.toml");
    std::ofstream(folder.path("t.csv")) << "sensor,x_m,y_m,z_m\n0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0,0,0.1\n";
    std::ofstream(path) << "duration_s = 1\ntarget = 't.csv'\n"
                        << head << "\n[trajectory]\nkind = 'rest'\nposes = [[1,0,0,0,0,0,2]]\n"
                        << tail;
    return test::error_of([&] { read_scenario(path, 1); });
  };
  EXPECT_EQ(error("generation = 2\n[[station]]\nchannel = 3\n", ""), "");
  EXPECT_NE(error("generation = 2\n", "").find("channel"), std::string::npos);
  EXPECT_NE(error("generation = 2\n[[station]]\n", "").find("channel"), std::string::npos);
  EXPECT_NE(error("generation = 2\n[[station]]\nchannel = 16\n", "").find("channel"), std::string::npos);
  EXPECT_NE(
      error("generation = 2\n[[station]]\nchannel = 3\n[[station]]\nid='01020304'\nchannel = 3\n", "").find("another"),
      std::string::npos);
  EXPECT_NE(error("generation = 2\n[[station]]\nchannel = 3\n", "[faults]\nstale_pulses = 2\n").find("generation 1"),
            std::string::npos);
  EXPECT_NE(error("[[station]]\nchannel = 3\n", "").find("channel"), std::string::npos);
}

}  // namespace
}  // namespace pharos::sim
