// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/stations/network_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "support/memory_file.hpp"
#include "support/real_data.hpp"
#include "tools/convert/crazyflie_log.hpp"
#include "tools/convert/crazyflie_sweeps.hpp"
#include "tools/convert/libsurvive_config.hpp"
#include "tools/convert/libsurvive_record.hpp"
#include "tools/convert/system_config.hpp"
#include "written_log.hpp"

namespace pharos::convert {
namespace {

using test::WrittenLog;
using ::testing::HasSubstr;
using ::testing::Not;

template <class Action>
std::string message(Action&& action) {
  try {
    action();
  } catch (const host::InputError& error) {
    return error.what();
  }
  return "";
}

std::string log_error(const std::vector<std::uint8_t>& bytes) {
  return message([&] { read_crazyflie_log(bytes, "log"); });
}

TEST(CrazyflieLog, GivesWhatWasWritten) {
  WrittenLog log;
  log.marker(0.5, 1);
  log.angle(1.0, 2, 1, 0, 0.25F);
  log.beam(1.5, 1.0F, -2.0F, 0.5F, 0.01F);
  const CrazyflieLog read = read_crazyflie_log(log.bytes(), "log");
  ASSERT_EQ(read.angles.size(), 1U);
  EXPECT_EQ(read.angles[0].sensor, 2);
  EXPECT_EQ(read.angles[0].station, 1);
  EXPECT_EQ(read.angles[0].angle_rad, 0.25);
  EXPECT_EQ(read.angles[0].time_s, 1.0);
  ASSERT_EQ(read.crossing_beams.size(), 1U);
  EXPECT_EQ(read.crossing_beams[0].position_m.y(), -2.0);
  ASSERT_EQ(read.events.size(), 1U);
  EXPECT_STREQ(read.events[0].what, "markers_on");
}

TEST(CrazyflieLog, RefusesForeignBrokenAndCutFilesInOneLine) {
  WrittenLog log;
  log.angle(1.0, 2, 1, 0, 0.25F);
  std::vector<std::uint8_t> bytes = log.bytes();
  EXPECT_THAT(log_error({}), HasSubstr("empty"));
  EXPECT_THAT(log_error({'P', 'K'}), HasSubstr("not a log of a Crazyflie"));
  std::vector<std::uint8_t> broken = bytes;
  broken[bytes.size() / 2] ^= 1U;
  EXPECT_THAT(log_error(broken), HasSubstr("checksum"));
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    const std::string error = log_error({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_FALSE(error.empty()) << size;
    EXPECT_THAT(error, Not(HasSubstr("\n")));
  }
  WrittenLog undeclared;
  undeclared.event(77, 1.0);
  EXPECT_THAT(log_error(undeclared.bytes()), HasSubstr("does not declare"));
}

TEST(CrazyflieLog, LeavesOutAnglesThatAreNone) {
  WrittenLog log;
  log.angle(1.0, 2, 1, 0, NAN);
  log.angle(1.0, 200, 1, 0, 0.1F);
  log.angle(1.0, 0, 0, 7, 0.1F);
  const CrazyflieLog read = read_crazyflie_log(log.bytes(), "log");
  EXPECT_TRUE(read.angles.empty());
  EXPECT_EQ(read.unusable, 3U);
}

// Turns of two LH1 stations as the firmware logs them: a group after the station's second slot, late by up to some
// milliseconds, with the other station's last angles again; a clock that runs slow by one percent.
TEST(CrazyflieSweeps, FindsWhenHitsWereInSpiteOfDelays) {
  constexpr double kRate = 0.99;
  constexpr double kTurn_s = 1.0 / 60.0;
  CrazyflieLog log;
  std::map<int, float> last[2];
  std::vector<double> truth;
  for (int k = 0; k < 400; ++k) {
    const int station = k % 2;
    const double begin_s = 2.0 + k * kTurn_s * kRate;
    const double delay_s = 0.0002 + 0.003 * std::abs(std::sin(1.7 * k)) * (k % 3 == 0 ? 0.0 : 1.0);
    const double logged_s = begin_s + kTurn_s * kRate + delay_s;
    for (int key = 0; key < 8; ++key) last[station][key] = static_cast<float>(0.1 * std::sin(0.01 * k + key));
    double at_s = logged_s;
    for (int sensor = 0; sensor < 4; ++sensor) {
      for (int b = 0; b < 2; ++b) {
        for (int sweep = 0; sweep < 2; ++sweep) {
          const auto found = last[b].find(2 * sensor + sweep);
          if (found == last[b].end()) continue;
          log.angles.push_back({at_s, static_cast<std::uint8_t>(sensor), static_cast<std::uint8_t>(b),
                                static_cast<std::uint8_t>(sweep), static_cast<double>(found->second)});
          at_s += 10e-6;
        }
      }
    }
    for (int key = 0; key < 8; ++key) {
      truth.push_back(begin_s + (0.5 * (key % 2) + (static_cast<double>(last[station][key]) + kPi / 2) / kTwoPi) *
                                    kTurn_s * kRate);
    }
  }
  const CrazyflieSweeps sweeps = sweeps_of(log, 1);
  EXPECT_NEAR(sweeps.clock_rate, kRate, 1e-3);
  std::sort(truth.begin(), truth.end());
  ASSERT_EQ(sweeps.hits.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(sweeps.hits[i].time_s, truth[i], 0.7e-3) << i;
  EXPECT_NEAR(sweeps.hits[0].theta_rad, kPi / 2, 0.2);
}

// A group of station 0 is lost: its angles come first with the next group, which is station 1's, a turn late.
TEST(CrazyflieSweeps, TakesAnglesThatCameWithTheOtherStationsGroupForLateOnes) {
  constexpr double kTurn_s = 1.0 / 60.0;
  CrazyflieLog log;
  double angle_rad[2] = {0.0, 0.0};
  for (int k = 0; k < 200; ++k) {
    const int station = k % 2;
    angle_rad[station] = 0.001 * k;
    if (k == 100) continue;
    const double logged_s = 2.0 + (k + 1) * kTurn_s + 0.0003;
    for (std::uint8_t sensor = 0; sensor < 4; ++sensor) {
      for (std::uint8_t b = 0; b < 2; ++b) {
        for (std::uint8_t plane = 0; plane < 2; ++plane) {
          log.angles.push_back({logged_s + 1e-5 * (4 * sensor + 2 * b + plane), sensor, b, plane, angle_rad[b]});
        }
      }
    }
  }
  const CrazyflieSweeps sweeps = sweeps_of(log, 1);
  for (const LightHit& hit : sweeps.hits) {
    const double angle = hit.theta_rad - kPi / 2;
    const double turn = std::round(1000.0 * angle);
    if (turn < 2.0) continue;  // both stations' first angles are told at once
    const double truth_s = 2.0 + (turn + 0.5 * hit.plane + (angle + kPi / 2) / kTwoPi) * kTurn_s;
    EXPECT_NEAR(hit.time_s, truth_s, 1e-3) << turn;
  }
}

// Two LH2 stations, the second logged up to 10 ms later than it might be; every light has a frame of the decoder board.
// In the second half the target stands still, so that its angles repeat.
TEST(CrazyflieSweeps, TakesTimesOfLighthouse2FromTheDecoderBoard) {
  constexpr double kBoard_s = 1.0 / 24e6, kRate = 0.99;
  CrazyflieLog log;
  std::vector<std::pair<double, LightFrame>> frames;  // by the board's time
  std::vector<double> truth_s;
  struct Group {
    double logged_s;
    std::uint8_t station;
    std::array<double, 8> angle_rad;
  };
  std::vector<Group> groups;
  for (std::uint8_t station = 0; station < 2; ++station) {
    const double period_s = rotor_period_s(2, station);
    for (int k = 0; k < 300; ++k) {
      const double begin_s = 0.3 + 0.004 * station + k * period_s;
      Group group{0.0, station, {}};
      double last_s = 0.0;
      for (std::uint8_t key = 0; key < 8; ++key) {
        const std::uint8_t sensor = key / 2, plane = key % 2;
        const double angle =
            0.1 * std::sin(0.03 * std::min(k, 150) + station) + 0.003 * sensor - 0.002 * plane * sensor;
        group.angle_rad[key] = angle;
        const double light_s = begin_s + (angle + kPi + (plane == 0 ? -kPi / 3 : kPi / 3)) / kTwoPi * period_s;
        last_s = std::max(last_s, light_s);
        truth_s.push_back(kRate * light_s);
        const auto ticks = static_cast<std::uint32_t>(std::llround(light_s / kBoard_s) + 4'294'000'000LL);
        frames.push_back({light_s, {kRate * light_s, sensor, ticks}});
      }
      group.logged_s = kRate * (last_s + 0.001 + station * 0.009);
      groups.push_back(group);
    }
  }
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& frame : frames) log.frames.push_back(frame.second);
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.logged_s < b.logged_s; });
  for (const Group& group : groups) {
    for (std::uint8_t key = 0; key < 8; ++key) {
      log.angles.push_back({group.logged_s + 1e-5 * key, static_cast<std::uint8_t>(key / 2), group.station,
                            static_cast<std::uint8_t>(key % 2), group.angle_rad[key]});
    }
  }
  const CrazyflieSweeps sweeps = sweeps_of(log, 2);
  ASSERT_GT(sweeps.hits.size(), 8U * 300U);
  EXPECT_NEAR(sweeps.clock_rate, kRate, 1e-4);
  std::sort(truth_s.begin(), truth_s.end());
  for (const LightHit& hit : sweeps.hits) {
    const auto near = std::lower_bound(truth_s.begin(), truth_s.end(), hit.time_s - 20e-6);
    ASSERT_NE(near, truth_s.end());
    EXPECT_NEAR(hit.time_s, *near, 20e-6);
  }
}

TEST(CrazyflieSweeps, LeavesOutWhatASensorDidNotSeeAgain) {
  CrazyflieLog log;
  for (int k = 0; k < 10; ++k) {
    for (std::uint8_t sensor = 0; sensor < 4; ++sensor) {
      for (std::uint8_t plane = 0; plane < 2; ++plane) {
        // Sensor 3 is in shadow from the third turn on.
        const double angle_rad = 0.01 * (sensor == 3 ? std::min(k, 2) : k);
        log.angles.push_back({1.0 + k / 60.0 + 1e-5 * (2 * sensor + plane), sensor, 0, plane, angle_rad});
      }
    }
  }
  const CrazyflieSweeps sweeps = sweeps_of(log, 1);
  EXPECT_EQ(sweeps.hits.size(), 80U - 14U);
  EXPECT_EQ(sweeps.repeated, 14U);
}

constexpr const char* kConfig =
    "calibs:\n  1:\n    sweeps:\n"
    "    - {curve: 0.1, gibmag: 0.001, gibphase: 2.5, ogeemag: -0.2, ogeephase: 1.0, phase: 0.0, tilt: -0.05}\n"
    "    - {curve: 0.2, gibmag: 0.002, gibphase: 1.0, ogeemag: -0.3, ogeephase: 2.0, phase: 0.003, tilt: 0.05}\n"
    "    uid: 3428821765\n"
    "geos:\n  1:\n    origin: [-2.5, 0.5, 3.0]\n    rotation:\n    - [1, 0, 0]\n    - [0, 1, 0]\n    - [0, 0, 1]\n"
    "systemType: 2\n";

TEST(SystemConfig, TurnsTheStationsFrameIntoOurs) {
  const network::Stations stations = read_system_config(kConfig, "config");
  ASSERT_EQ(stations.size(), 1U);
  EXPECT_EQ(stations[0].number, 1);
  EXPECT_EQ(stations[0].id, 3428821765U);
  EXPECT_EQ(stations[0].generation, network::Generation::kLighthouse2);
  EXPECT_EQ(stations[0].plane[1].ogee_magnitude, -0.3);
  ASSERT_TRUE(stations[0].T_world_station);
  // A metre ahead of it is along its x, which is the world's x here; right is -y, down is -z.
  EXPECT_TRUE((*stations[0].T_world_station * Vector3(0, 0, 1)).isApprox(Vector3(-1.5, 0.5, 3.0)));
  EXPECT_TRUE((*stations[0].T_world_station * Vector3(1, 0, 0)).isApprox(Vector3(-2.5, -0.5, 3.0)));
}

TEST(SystemConfig, SaysWhatIsWrong) {
  const auto error = [](const std::string& from, const std::string& to) {
    std::string text = kConfig;
    text.replace(text.find(from), from.size(), to);
    return message([&] { read_system_config(text, "config"); });
  };
  EXPECT_THAT(error("systemType: 2", "systemType: 3"), HasSubstr("systemType"));
  EXPECT_THAT(error("[1, 0, 0]", "[2, 0, 0]"), HasSubstr("rotation"));
  EXPECT_THAT(error("tilt: 0.05", "tild: 0.05"), HasSubstr("calibs.1.sweeps.1.tilt"));
  EXPECT_THAT(error("origin: [-2.5", "origin: [x"), HasSubstr("origin"));
  EXPECT_THAT(message([] { read_system_config("a: [", "config"); }), HasSubstr("config"));
  EXPECT_THAT(message([] { read_system_config(std::string(100000, '['), "config"); }), HasSubstr("deep"));
}

TEST(NetworkFile, ReadsBackWhatItWrote) {
  network::Stations stations = read_system_config(kConfig, "config");
  stations[0].sigmas = network::StationSigmas{0.01, 0.02, 0.0003};
  stations[0].modes.push_back((Vector6() << 1e-3, -2e-3, 0.0, 0.1, 1.0 / 3.0, -4.0).finished());
  stations[0].modes.push_back(Vector6::Constant(0.5));
  const std::string text = host::network_text(stations);
  const test::MemoryFile file(text.data(), text.size());
  const network::Stations again = host::read_network_file(file.path());
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].plane, stations[0].plane);
  EXPECT_EQ(again[0].id, stations[0].id);
  EXPECT_TRUE(again[0].T_world_station->R.isApprox(stations[0].T_world_station->R, 1e-14));
  EXPECT_EQ(again[0].T_world_station->t, stations[0].T_world_station->t);
  EXPECT_NEAR(again[0].sigmas->rotation_rad, 0.01, 1e-15);
  ASSERT_EQ(again[0].modes.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(again[0].modes[k], stations[0].modes[k]);
}

constexpr const char* kLibsurvive =
    "\"v\":\"0\",\n\"poser\":\"MPFIT\"\n\"lighthouse0\":{\n\"index\":\"0\",\n\"id\":\"17\",\n\"mode\":\"8\",\n"
    "\"pose\":[\"1.0\",\"2.0\",\"3.0\",\"1.0\",\"0.0\",\"0.0\",\"0.0\"],\n\"fcalphase\":[\"0.0\",\"-0.006\"],\n"
    "\"fcaltilt\":[\"-0.049\",\"0.045\"],\n\"fcalcurve\":[\"0.3\",\"0.1\"],\n\"fcalgibpha\":[\"1.9\",\"2.2\"],\n"
    "\"fcalgibmag\":[\"-0.004\",\"-0.005\"],\n\"fcalogeephase\":[\"3.0\",\"0.3\"],\n\"fcalogeemag\":[\"0.1\",\"-0.2\"],"
    "\n"
    "\"PositionSet\":\"1\"\n}\n";

TEST(LibsurviveConfig, ReadsItsOwnKindOfText) {
  const network::Stations stations = read_libsurvive_config(kLibsurvive, "config");
  ASSERT_EQ(stations.size(), 1U);
  EXPECT_EQ(stations[0].number, 8);
  EXPECT_EQ(stations[0].plane[0].curve, 0.3);
  // It looks along -Z with Y up: ahead is -z, down is -y of its own.
  EXPECT_TRUE((*stations[0].T_world_station * Vector3(0, 0, 1)).isApprox(Vector3(1, 2, 2)));
  EXPECT_TRUE((*stations[0].T_world_station * Vector3(0, 1, 0)).isApprox(Vector3(1, 1, 3)));
  std::string text = kLibsurvive;
  for (std::size_t size = 20; size < text.size() - 2; size += 7) {
    EXPECT_FALSE(message([&] { read_libsurvive_config(text.substr(0, size), "config"); }).find('\n') !=
                 std::string::npos);
  }
  EXPECT_THAT(message([] { read_libsurvive_config("<html>", "config"); }), HasSubstr("not a configuration"));
}

TEST(LibsurviveRecord, TakesAnglesFromTimesSinceSync) {
  // Channel 8: 937,000 ticks a turn. A hit a third of a turn and 1000 ticks after the sync is 1000 ticks past straight
  // ahead of plane a; one two thirds on, of plane b.
  std::string text = "0.1 D CONFIG {\"lighthouse_config\": {\"modelPoints\": [[0,0,0],[0.1,0,0],[0,0.1,0]]}}\n";
  text += "1.000 D Y 8 4294900000 1 1\n";
  text += "1.010 D W 8 2 " + std::to_string((4294900000ULL + 312333 + 1000) % (1ULL << 32U)) + " 0\n";
  text += "1.017 D W 8 1 " + std::to_string((4294900000ULL + 624667) % (1ULL << 32U)) + " 0\n";
  text += "1.020 D W 3 1 5 0\n";
  const test::MemoryFile file(text.data(), text.size());
  const LibsurviveRecord record = read_libsurvive_record(host::ByteSource(file.path()));
  const RecordedDevice& device = record.devices.at("D");
  EXPECT_EQ(device.target.size(), 3U);
  EXPECT_EQ(device.without_sync, 1U);
  ASSERT_EQ(device.hits.size(), 2U);
  EXPECT_EQ(device.hits[0].plane, 0);
  EXPECT_NEAR(device.hits[0].theta_rad, kTwoPi * 1000 / 937000, 1e-5);
  EXPECT_EQ(device.hits[1].plane, 1);
  EXPECT_NEAR(device.hits[1].theta_rad, 0.0, 1e-5);
  EXPECT_NEAR(device.hits[1].time_s - device.hits[0].time_s, (624667 - 313333) / 48e6, 1e-9);
  const test::MemoryFile foreign("a,b\n1,2\n", 8);
  EXPECT_THAT(message([&] { read_libsurvive_record(host::ByteSource(foreign.path())); }), HasSubstr("not a record"));
}

// The record's own angles, for comparison (B lines of the file; of one device).
TEST(LibsurviveRecord, AgreesWithTheAnglesOfARealRecord) {
  PHAROS_NEEDS_DATA("open/libsurvive");
  const auto path = test::real_data("open/libsurvive") / "haagh-tracking.rec.gz";
  const LibsurviveRecord record = read_libsurvive_record(host::ByteSource(path));
  ASSERT_EQ(record.devices.size(), 3U);
  const RecordedDevice& headset = record.devices.at("T20");
  EXPECT_EQ(headset.target.size(), 32U);
  EXPECT_GT(headset.hits.size(), 19000U);
  EXPECT_GT(record.external.size(), 12000U);
  double gravity = 0.0;
  for (const ImuSample& sample : headset.imu) gravity += sample.acceleration_m_s2.norm();
  EXPECT_NEAR(gravity / static_cast<double>(headset.imu.size()), 9.81, 0.3);
}

}  // namespace
}  // namespace pharos::convert
