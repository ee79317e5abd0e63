// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include "pharos/base/units.hpp"
#include "tests/support/error_of.hpp"
#include "tests/unit/host/config/made_up.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kOneTarget = "[[target]]\nname = 'dock'\nport = '/dev/ttyUSB0'\ntarget_file = 'dock.csv'\n";

// One sensor with a calibrated position other than that of the table, and one station.
calibrate::CalibrationFile calibrated(const std::string& path) {
  calibrate::CalibrationFile file;
  file.name = path;
  file.model_form = 2;
  file.scale_sigma = 0.002;
  file.sensors.push_back({3, {0.0004, 0.0, 0.0}, Vector3::Zero()});
  file.nominal_m.push_back(Vector3::Zero());
  StationEntry station;
  station.id = 0xBEC08E38u;
  station.calibration.id = 0xBEC08E38u;
  station.calibration.rotor[0].phase_rad = 0.01;
  file.stations.push_back(station);
  return file;
}

TEST(DaemonConfig, TracksMotionUnlessConfiguredToTakeEachCycleAlone) {
  const auto method = [&](const std::string& more) {
    return parse_daemon_config(kOneTarget + more, "p.toml", "/etc/pharos", made_up()).targets.at(0).method;
  };
  EXPECT_EQ(method(""), TrackMethod::kMotion);
  EXPECT_EQ(method("method = 'motion'\n"), TrackMethod::kMotion);
  EXPECT_EQ(method("method = 'epoch'\n"), TrackMethod::kEpoch);
  EXPECT_THROW(method("method = 'cycle'\n"), InputError);
}

TEST(DaemonConfig, TakesTheStationsOfLighthouse2) {
  const auto read = [](const std::string& more, std::uint8_t generation, bool posed) {
    Environment environment = made_up();
    environment.read_stations = [generation, posed](const std::string&) {
      network::Station station;
      station.number = 6;
      station.generation = static_cast<network::Generation>(generation);
      if (posed) station.T_world_station = network::WorldFromStation{};
      network::Stations stations;
      stations.push_back(station);
      return stations;
    };
    return parse_daemon_config(kOneTarget + more, "p.toml", "/etc/pharos", environment);
  };
  const std::string kSecond = "generation = 2\nstations_file = 'room.toml'\n";
  const DaemonConfig config = read(kSecond, 2, true);
  EXPECT_EQ(config.targets.at(0).generation, 2);
  EXPECT_EQ(config.targets.at(0).stations_file, "/etc/pharos/room.toml");
  EXPECT_EQ(config.targets.at(0).stations.size(), 1U);
  EXPECT_THAT(describe(config), HasSubstr("1 of Lighthouse 2.0, from /etc/pharos/room.toml"));
  EXPECT_EQ(read("", 2, true).targets.at(0).generation, 1);
  const auto error = [&](const std::string& more, std::uint8_t generation, bool posed) {
    return test::error_of([&] { read(more, generation, posed); });
  };
  EXPECT_THAT(error("generation = 2\n", 2, true), HasSubstr("stations_file"));
  EXPECT_THAT(error("stations_file = 'room.toml'\n", 2, true), HasSubstr("is for generation = 2"));
  EXPECT_THAT(error("generation = 3\n", 2, true), HasSubstr("generation"));
  EXPECT_THAT(error(kSecond, 1, true), HasSubstr("is of generation 1"));
  EXPECT_THAT(error(kSecond, 2, false), HasSubstr("no position_m"));
  for (const char* other : {"method = 'epoch'\n", "calibration_file = 'c.toml'\n", "remember_calibrations = true\n"}) {
    EXPECT_THAT(error(kSecond + other, 2, true), HasSubstr("is for generation 1")) << other;
  }
}

// Ports, folders and the log file are checked in the same run as the text, and have their line too.
TEST(DaemonConfig, PlacesThatCannotBeUsedHaveTheirLineAndAreToldWithEveryOtherError) {
  Environment environment = made_up();
  environment.check_places = [](const DaemonConfig& config) {
    std::vector<PlaceError> errors{{"", 0, "state_directory", "is read-only"}};
    for (std::size_t i = 0; i < config.targets.size(); ++i) errors.push_back({"target", i, "port", "is no device"});
    return errors;
  };
  const std::string good = "state_directory = 'state'\n" + std::string(kOneTarget);
  const DaemonConfig config = parse_daemon_config(good, "p.toml", "/etc/pharos", environment);
  ASSERT_EQ(config.place_errors.size(), 2u) << "no obstacle to a start";
  EXPECT_EQ(config.place_errors[0].message, "p.toml:1: state_directory: is read-only");
  EXPECT_EQ(config.place_errors[1].message, "p.toml:4: target[0].port: is no device");
  const std::string told = pharos::test::error_of(
      [&] { parse_daemon_config(good + "colour = 'red'\n", "p.toml", "/etc/pharos", environment); });
  EXPECT_THAT(told, AllOf(HasSubstr("p.toml:6: target[0].colour: unknown key"),
                          HasSubstr("p.toml:1: state_directory: is read-only"),
                          HasSubstr("p.toml:4: target[0].port: is no device")));
}

TEST(DaemonConfig, TakesWhoTheBoardMustBe) {
  const auto identity = [&](const std::string& more) {
    return parse_daemon_config(kOneTarget + more, "p.toml", "/etc/pharos", made_up()).targets.at(0).identity;
  };
  EXPECT_FALSE(identity("").any());
  const ExpectedIdentity told = identity("[target.identity]\nserial = '0A1b2C3D'\nsensors = 12\n");
  EXPECT_EQ(told.serial, 0x0A1B2C3Du);
  EXPECT_EQ(told.sensors, 12);
  for (const char* wrong :
       {"serial = '0A1B'", "serial = '00000000'", "serial = '0A1B2C3G'", "sensors = 0", "sensors = 33"}) {
    EXPECT_THROW(identity("[target.identity]\n" + std::string(wrong) + "\n"), InputError) << wrong;
  }
}

TEST(DaemonConfig, TakesWhatIsGoodEnough) {
  const auto limits = [&](const std::string& more) {
    return parse_daemon_config(kOneTarget + more, "p.toml", "/etc/pharos", made_up()).targets.at(0).limits;
  };
  EXPECT_EQ(limits("").position_m, motion::UncertaintyLimits{}.position_m);
  const motion::UncertaintyLimits told = limits("[target.solve]\nlargest_sigma_deg = 0.2\nlargest_sigma_mm = 2.5\n");
  EXPECT_NEAR(told.rotation_rad, 0.2 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(told.position_m, 2.5e-3, 1e-12);
  EXPECT_THROW(limits("[target.solve]\nlargest_sigma_mm = 0.0\n"), InputError);
}

TEST(DaemonConfig, TakesSensorsAndStationsFromACalibration) {
  Environment environment = made_up();
  environment.read_calibration = calibrated;
  std::uint8_t sensor = 3;
  environment.read_target = [&](const std::string&) {
    TargetFile file;
    file.target.push_back({sensor, Vector3::Zero(), Vector3::Zero()});
    return file;
  };
  const std::string with_file = std::string(kOneTarget) + "calibration_file = 'cal.toml'\n";
  const std::string second_form = "[target.solve]\nmodel_form = 2\n";
  const auto parsed = [&](const std::string& text) {
    return parse_daemon_config(text, "p.toml", "/etc/pharos", environment).targets.at(0);
  };
  const TargetConfig target = parsed(with_file + second_form);
  EXPECT_EQ(target.calibration_file, "/etc/pharos/cal.toml");
  EXPECT_EQ(target.target[0].position_m.x(), 0.0004);
  ASSERT_EQ(target.calibrated_stations.size(), 1u);
  EXPECT_EQ(target.calibrated_stations[0].calibration.rotor[0].phase_rad, 0.01);
  EXPECT_EQ(target.scale_sigma, 0.002);
  const auto refusal = [&](const std::string& text) -> std::string {
    return pharos::test::error_of([&] { parsed(text); });
  };
  EXPECT_THAT(refusal(with_file), AllOf(StartsWith("p.toml:5: "), HasSubstr("sign form 2")));
  sensor = 4;
  EXPECT_THAT(refusal(with_file + second_form), HasSubstr("another target: sensor 4"));
}

TEST(DaemonConfig, DefaultsSufficeForOneTarget) {
  const DaemonConfig config = parse(kOneTarget);
  ASSERT_EQ(config.targets.size(), 1u);
  EXPECT_EQ(config.targets[0].name, "dock");
  EXPECT_EQ(config.targets[0].baud, 460'800);
  EXPECT_EQ(config.targets[0].target_file, "/etc/pharos/dock.csv");
  EXPECT_EQ(config.targets[0].shape.sensors, 12u);
  EXPECT_THAT(config.lcm.url, EndsWith("ttl=0"));  // stays on this computer unless configured otherwise
  EXPECT_FALSE(config.recording.has_value());
  EXPECT_DOUBLE_EQ(config.publish.max_age_s, 0.2);
  EXPECT_DOUBLE_EQ(config.targets[0].track.solve.sigma_rad, kPaperSigma_rad);
}

TEST(DaemonConfig, UnderstandsEveryKeyOfTheShippedExample) {
  // The example holds each key with its default, commented out: without the comment signs it must still be valid.
  std::ifstream in(PHAROS_EXAMPLE_CONFIG);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    const bool key = line.size() > 1 && line[0] == '#' && (std::islower(line[1]) != 0 || line[1] == '[');
    text += (key ? line.substr(1) : line) + "\n";
  }
  const std::size_t sink = text.find("sink = \"stderr\"");
  ASSERT_NE(sink, std::string::npos);
  text.replace(sink, 15, "sink = \"file\"  ");
  const DaemonConfig config = parse(text);
  const DaemonConfig defaults = parse(kOneTarget);
  ASSERT_TRUE(config.recording.has_value());
  EXPECT_EQ(config.recording->rotate_bytes, RecordingConfig{}.rotate_bytes);
  EXPECT_EQ(config.recording->rotate_s, RecordingConfig{}.rotate_s);
  EXPECT_EQ(config.lcm.url, defaults.lcm.url);
  EXPECT_EQ(config.lcm.channel_prefix, defaults.lcm.channel_prefix);
  EXPECT_EQ(config.publish.max_age_s, defaults.publish.max_age_s);
  EXPECT_EQ(config.publish.status_period_s, defaults.publish.status_period_s);
  EXPECT_EQ(config.publish.bearings, defaults.publish.bearings);
  EXPECT_EQ(config.publish.previews, defaults.publish.previews);
  EXPECT_EQ(config.source, defaults.source);
  EXPECT_EQ(config.log.level, defaults.log.level);
  const TargetConfig& target = config.targets.at(0);
  EXPECT_EQ(target.baud, defaults.targets[0].baud);
  EXPECT_EQ(target.remember_calibrations, defaults.targets[0].remember_calibrations);
  EXPECT_NEAR(target.track.solve.sigma_rad, defaults.targets[0].track.solve.sigma_rad, 1e-15);
  EXPECT_EQ(target.track.solve.rho, defaults.targets[0].track.solve.rho);
  EXPECT_EQ(target.track.form, defaults.targets[0].track.form);
  EXPECT_EQ(target.track.smooth_flashes, defaults.targets[0].track.smooth_flashes);
  EXPECT_EQ(target.track.prior_max_age_s, defaults.targets[0].track.prior_max_age_s);
}

TEST(DaemonConfig, ReadsTheShippedExampleAsItStands) {
  std::ifstream in(PHAROS_EXAMPLE_CONFIG);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(parse(text).targets.size(), 1u);
}

TEST(DaemonConfig, NamesFileLineAndKeyOfAnUnknownKeyAndTheOneMeant) {
  EXPECT_THAT(error_of(std::string(kOneTarget) + "bauds = 9600\n"),
              AllOf(StartsWith("p.toml:5: target[0].bauds:"), HasSubstr("baud\"?")));
  EXPECT_THAT(error_of(std::string("[lcm]\ncolour = 1\n") + kOneTarget),
              StartsWith("p.toml:2: lcm.colour: unknown key"));
  EXPECT_THAT(error_of(std::string("[sonar]\n") + kOneTarget), StartsWith("p.toml:1: sonar: unknown key"));
}

TEST(DaemonConfig, ReportsWhatIsWrongWithEachPartInOneRun) {
  const std::string error = error_of(
      "source = 'a b'\n[lcm]\nurl = 'x'\n[publish]\nmax_age_s = 99\n[log]\nlevel = 'loud'\n[sonar]\n"
      "[[target]]\nname = 'a'\nport = '/dev/a'\ntarget_file = 'a.csv'\nbauds = 1\n"
      "[[target]]\nname = 'b'\nport = '/dev/b'\ntarget_file = 'b.csv'\nbaud = 1\n");
  for (const char* line :
       {"p.toml:1: source: ", "p.toml:3: lcm.url: ", "p.toml:5: publish.max_age_s: ", "p.toml:7: log.level: ",
        "p.toml:8: sonar: unknown key", "p.toml:13: target[0].bauds: unknown", "p.toml:18: target[1].baud: "}) {
    EXPECT_THAT(error, HasSubstr(line));
  }
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 6);
}

// The message has one line for each of `starts`, which begins with it; the order is free.
void expect_lines(const std::string& text, const std::vector<std::string>& starts) {
  const std::string error = error_of(text);
  for (const std::string& start : starts) EXPECT_THAT('\n' + error, HasSubstr("\n" + start));
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n') + 1, static_cast<std::ptrdiff_t>(starts.size())) << error;
}

TEST(DaemonConfig, ReportsEveryWrongKeyOfOneTarget) {
  expect_lines(
      "[[target]]\nname = 'a b'\nport = ''\ntarget_file = 'a.csv'\nbaud = 1\nbauds = 2\nmethod = 'x'\n"
      "[target.solve]\nrho = 2\nsigma_arcsec = 0\n[target.identity]\nserial = 'x'\nsensors = 0\n",
      {"p.toml:2: target[0].name: ", "p.toml:3: target[0].port: ", "p.toml:5: target[0].baud: ",
       "p.toml:6: target[0].bauds: unknown",
       "p.toml:7: target[0].method: ", "p.toml:9: target[0].solve.rho: ", "p.toml:10: target[0].solve.sigma_arcsec: ",
       "p.toml:12: target[0].identity.serial: ", "p.toml:13: target[0].identity.sensors: "});
}

TEST(DaemonConfig, ReportsEveryWrongTableOfEachKind) {
  expect_lines(
      "[[camera]]\nname = 'a'\ntarget = 't'\ncamera_file = 'gone'\npacket_size = 1\nserial = 'S'\n"
      "[[camera]]\nname = 'a'\ntarget = 't'\ncamera_file = 'c'\nframes = 'f'\nptp = true\n",
      {"p.toml:4: camera[0].camera_file: ", "p.toml:5: camera[0].packet_size: ", "p.toml:12: camera[1].ptp: ",
       "p.toml:8: camera[1].name: "});
  expect_lines(
      "[[telescope]]\nname = 'a'\ntarget = 't'\ncamera_file = 'gone'\ndirectory = 'd'\nlatitude_deg = 91\n"
      "longitude_deg = 0\n[[telescope]]\nname = 'b'\ntarget = 't'\ncamera_file = 'c'\ndirectory = 'd'\n"
      "latitude_deg = 0\nlongitude_deg = 0\nlaw = 'x'\n",
      {"p.toml:4: telescope[0].camera_file: ", "p.toml:6: telescope[0].latitude_deg: ", "p.toml:15: telescope[1].law: ",
       "p.toml:12: telescope[1].directory: "});
  expect_lines(
      "[[stereo]]\nname = 'a'\ntarget = 't'\nrig_file = 'gone'\nsystems = ['x']\npixel_format = 'RGB'\n"
      "left.serial = 'L'\nright.address = 'x'\n[[stereo]]\nname = 'b'\ntarget = 't'\nrig_file = 'r'\n"
      "systems = ['ring2']\nframes = 'f'\npixel_format = 'Mono8'\n",
      {"p.toml:4: stereo[0].rig_file: ", "p.toml:5: stereo[0].systems: ", "p.toml:6: stereo[0].pixel_format: ",
       "p.toml:8: stereo[0].right.address: ", "p.toml:15: stereo[1].pixel_format: "});
}

TEST(DaemonConfig, ReportsEveryWrongKeyOfOneTable) {
  expect_lines(std::string("[lcm]\nurl = 'x'\nchannel_prefix = 'A B'\n[publish]\nmax_age_s = 99\nstatus_rate_hz = 99\n"
                           "[log]\nlevel = 'loud'\nfile = 'x'\nlevels = 1\n[recording]\nrotate_mib = 0\nrotate = 1\n") +
                   kOneTarget,
               {"p.toml:2: lcm.url: ", "p.toml:3: lcm.channel_prefix: ", "p.toml:5: publish.max_age_s: ",
                "p.toml:6: publish.status_rate_hz: ", "p.toml:8: log.level: ", "p.toml:9: log.file: ",
                "p.toml:10: log.levels: unknown", "p.toml:11: recording.directory: ",
                "p.toml:12: recording.rotate_mib: ", "p.toml:13: recording.rotate: unknown"});
  expect_lines(
      "[[stereo]]\nname = 'a'\ntarget = 't'\nrig_file = 'r'\nsystems = ['slam']\nleft.serial = '?'\n"
      "left.address = 'x'\nright.serial = 'R'\nfeatures = 1\n[stereo.slam]\nscene = 'x'\nfeatures = 1\nloops = 1\n",
      {"p.toml:6: stereo[0].left.serial: ", "p.toml:7: stereo[0].left.address: ",
       "p.toml:9: stereo[0].features: unknown", "p.toml:11: stereo[0].slam.scene: ",
       "p.toml:12: stereo[0].slam.features: ", "p.toml:13: stereo[0].slam.loops: unknown"});
  expect_lines(
      "[[camera]]\nname = 'a'\ntarget = 't'\ncamera_file = 'c'\nframes = 'f'\nptp = true\nserial = 'S'\n"
      "[camera.ring]\nleast_outer_radius_m = 0\nmost_outer_radius_m = 99\n",
      {"p.toml:6: camera[0].ptp: ", "p.toml:7: camera[0].serial: ", "p.toml:9: camera[0].ring.least_outer_radius_m: ",
       "p.toml:10: camera[0].ring.most_outer_radius_m: "});
}

struct BadConfig {
  const char* name;
  const char* text;      // before the target
  const char* extra;     // inside the target
  const char* expected;  // start of the message
  friend void PrintTo(const BadConfig& bad, std::ostream* out) { *out << bad.name; }
};

class DaemonConfigRefuses : public ::testing::TestWithParam<BadConfig> {};

TEST_P(DaemonConfigRefuses, WithFileLineAndKey) {
  const BadConfig& bad = GetParam();
  const std::string message = error_of(std::string(bad.text) + kOneTarget + bad.extra);
  EXPECT_THAT(message, StartsWith(bad.expected));
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(
    Each, DaemonConfigRefuses,
    ::testing::Values(
        BadConfig{"WrongType", "", "baud = 'fast'\n", "p.toml:5: target[0].baud: must be an integer"},
        BadConfig{"FractionForInteger", "", "baud = 9600.5\n", "p.toml:5: target[0].baud: must be an integer"},
        BadConfig{"BaudOutOfRange", "", "baud = 0\n", "p.toml:5: target[0].baud: must lie in"},
        BadConfig{"SigmaOutOfRange", "", "[target.solve]\nsigma_arcsec = -1\n",
                  "p.toml:6: target[0].solve.sigma_arcsec"},
        BadConfig{"RhoOne", "", "[target.solve]\nrho = 1.0\n", "p.toml:6: target[0].solve.rho"},
        BadConfig{"ModelForm3", "", "[target.solve]\nmodel_form = 3\n", "p.toml:6: target[0].solve.model_form"},
        BadConfig{"NotANumber", "[publish]\nmax_age_s = nan\n", "", "p.toml:2: publish.max_age_s: must be a finite"},
        BadConfig{"AgeZero", "[publish]\nmax_age_s = 0\n", "", "p.toml:2: publish.max_age_s"},
        BadConfig{"NoProvider", "[lcm]\nurl = '239.255.76.67'\n", "", "p.toml:2: lcm.url: must begin with"},
        BadConfig{"PrefixWithBlank", "[lcm]\nchannel_prefix = 'A B'\n", "", "p.toml:2: lcm.channel_prefix"},
        BadConfig{"LogLevel", "[log]\nlevel = 'loud'\n", "", "p.toml:2: log.level: must be one of"},
        BadConfig{"FileWithoutSink", "[log]\nfile = 'x'\n", "", "p.toml:2: log.file: is used only"},
        BadConfig{"SinkWithoutFile", "[log]\nsink = 'file'\n", "", "p.toml:1: log.file: is missing"},
        BadConfig{"RecordingNowhere", "[recording]\nrotate_mib = 1\n", "", "p.toml:1: recording.directory: is missing"},
        BadConfig{"NotToml", "[lcm\n", "", "p.toml:1: not valid TOML"},
        BadConfig{"KeyTwice", "source = 'a'\nsource = 'b'\n", "", "p.toml:2: not valid TOML"},
        BadConfig{"SameName", "", "[[target]]\nname = 'dock'\nport = '/dev/b'\ntarget_file = 'b.csv'\n",
                  "p.toml:6: target[1].name: \"dock\" is taken"},
        BadConfig{"SamePort", "", "[[target]]\nname = 'b'\nport = '/dev/ttyUSB0'\ntarget_file = 'b.csv'\n",
                  "p.toml:7: target[1].port: \"/dev/ttyUSB0\" is taken"},
        BadConfig{"SamePortOtherSpelling", "[[target]]\nname = 'a'\nport = '/dev/left'\ntarget_file = 'a.csv'\n",
                  "[[target]]\nname = 'b'\nport = '/dev/right'\ntarget_file = 'b.csv'\n",
                  "p.toml:11: target[2].port: \"/dev/right\" is taken by another target, as \"/dev/left\""},
        BadConfig{"SameReplay", "[[target]]\nname = 'a'\nport = 'replay:r'\ntarget_file = 'a.csv'\n",
                  "[[target]]\nname = 'b'\nport = 'replay:r'\ntarget_file = 'b.csv'\n",
                  "p.toml:11: target[2].port: \"replay:/etc/pharos/r\" is taken"},
        BadConfig{"NotMulticast", "[lcm]\nurl = 'udpm://192.168.1.7:7667'\n", "",
                  "p.toml:2: lcm.url: \"192.168.1.7\" is no multicast address"},
        BadConfig{"NoReplayFile", "", "[[target]]\nname = 'b'\nport = 'replay:gone'\ntarget_file = 'b.csv'\n",
                  "p.toml:7: target[1].port: /etc/pharos/gone: cannot be opened"}),
    [](const auto& entry) { return entry.param.name; });

TEST(DaemonConfig, RefusesAFileWithoutATarget) {
  EXPECT_THAT(error_of("source = 'x'\n"), HasSubstr("add a [[target]]"));
  EXPECT_THAT(error_of(""), HasSubstr("target: is missing"));
}

class TargetFileIn : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "p.toml") << kOneTarget;
  }
  std::string load_with(const std::string& target_rows) const {
    std::ofstream(folder_ / "dock.csv") << "sensor,x_m,y_m,z_m\n" << target_rows;
    try {
      return describe(load_daemon_config(folder_ / "p.toml"));
    } catch (const InputError& error) {
      return error.what();
    }
  }
  std::filesystem::path folder_;
};

TEST_F(TargetFileIn, ASensorTwiceIsReportedWithBothFilesAndLines) {
  EXPECT_THAT(load_with("0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n1,0,0,0.1\n"),
              AllOf(HasSubstr("p.toml:4: target[0].target_file:"), HasSubstr("dock.csv: line 5")));
}

TEST_F(TargetFileIn, AMissingFileIsReported) {
  const std::string message = [&] {
    try {
      return describe(load_daemon_config(folder_ / "p.toml"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  }();
  EXPECT_THAT(message, AllOf(HasSubstr("p.toml:4: target[0].target_file:"), HasSubstr("dock.csv")));
}

TEST_F(TargetFileIn, SensorsInOnePlaneAreTakenAndRemarked) {
  EXPECT_THAT(load_with("0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0.1,0.1,0\n"), HasSubstr("all in one plane"));
}

TEST_F(TargetFileIn, TooFewSensorsAreRefused) {
  EXPECT_THAT(load_with("0,0,0,0\n1,0.1,0,0\n"), HasSubstr("target[0].target_file:"));
}

TEST(DaemonConfig, AMissingConfigurationIsReported) { EXPECT_THROW(load_daemon_config("/nowhere/p.toml"), InputError); }

}  // namespace
}  // namespace pharos::host
