// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/unit/host/config/made_up.hpp"

namespace pharos::host {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kCamera =
    "[[camera]]\nname = 'helios'\ntarget = 'client'\ncamera_file = 'helios.toml'\nserial = '233300001'\n";

TEST(TofConfig, OfOneCameraSufficesForADaemon) {
  const DaemonConfig config = parse(kCamera);
  EXPECT_TRUE(config.targets.empty());
  ASSERT_EQ(config.cameras.size(), 1u);
  const TofConfig& camera = config.cameras[0];
  EXPECT_EQ(camera.name, "helios");
  EXPECT_EQ(camera.target, "client");
  EXPECT_EQ(camera.camera_file, "/etc/pharos/helios.toml");
  EXPECT_EQ(camera.device.serial, "233300001");
  EXPECT_EQ(camera.device.width_px, 640) << "of the camera file";
  EXPECT_EQ(camera.device.packet_size, 1400) << "passes every network";
  EXPECT_EQ(camera.average_frames, 1);
  EXPECT_FALSE(camera.is_recorded());
}

TEST(TofConfig, TakesEveryKey) {
  const TofConfig camera = parse(std::string(kCamera) +
                                 "address = '169.254.1.2'\nmode = 'Distance5000mmMultiFreq'\npacket_size = 9000\n"
                                 "frame_rate_hz = 15\nptp = false\naverage_frames = 100\n[camera.ring]\n"
                                 "least_outer_radius_m = 0.5\nmost_outer_radius_m = 0.6\n")
                               .cameras.at(0);
  EXPECT_EQ(camera.device.address, "169.254.1.2");
  EXPECT_EQ(camera.device.mode, "Distance5000mmMultiFreq");
  EXPECT_EQ(camera.device.packet_size, 9000);
  EXPECT_EQ(camera.device.frame_rate_hz, 15.0);
  EXPECT_FALSE(camera.device.ptp);
  EXPECT_EQ(camera.average_frames, 100);
  EXPECT_EQ(camera.tof.ring.min_outer_radius_m, 0.5);
  EXPECT_EQ(camera.tof.ring.max_outer_radius_m, 0.6);
}

TEST(TofConfig, TakesTheTargetsDescription) {
  const DaemonConfig config = parse(std::string(kCamera) + "target_file = 'ring.toml'\n");
  const TofConfig& camera = config.cameras.at(0);
  EXPECT_EQ(camera.target_file, "/etc/pharos/ring.toml");
  ASSERT_EQ(camera.tof.target.connectors.size(), 2u);
  EXPECT_EQ(camera.tof.target.connectors[1].place_m, Vector2(0.4, 0.0));
  // Another ring is none.
  EXPECT_GT(camera.tof.ring.min_outer_radius_m, 0.27);
  EXPECT_LT(camera.tof.ring.max_outer_radius_m, 0.29);
  EXPECT_THAT(describe(config), HasSubstr("connectors: 2 described, from /etc/pharos/ring.toml"));
}

TEST(TofConfig, TakesTheNumberOfConnectors) {
  EXPECT_EQ(parse(kCamera).cameras.at(0).tof.connector.expected, 2);
  const DaemonConfig config = parse(std::string(kCamera) + "connectors = 1\n");
  EXPECT_EQ(config.cameras.at(0).tof.connector.expected, 1);
  EXPECT_THAT(describe(config), HasSubstr("connectors: 1, the nearest gives the turn"));
}

TEST(TofConfig, TakesRecordedFramesInPlaceOfACamera) {
  const TofConfig camera =
      parse("[[camera]]\nname = 'a'\ntarget = 'b'\ncamera_file = 'c.toml'\nframes = 'here'\n").cameras.at(0);
  EXPECT_TRUE(camera.is_recorded());
  EXPECT_EQ(camera.frames, "/etc/pharos/here");
}

TEST(TofConfig, IsReported) {
  const std::string text = describe(parse(std::string(kCamera) + "average_frames = 100\n"));
  for (const char* words :
       {"camera helios (target client)", "serial number 233300001", "packets of 1400",
        "640 x 480 pixels from /etc/pharos/helios.toml", "means of 100 frames", "PHAROS_TOF_POSE"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
}

struct BadCamera {
  const char* name;
  const char* text;  // after kCamera
  const char* expected;
  friend void PrintTo(const BadCamera& bad, std::ostream* out) { *out << bad.name; }
};

class TofConfigRefuses : public ::testing::TestWithParam<BadCamera> {};

TEST_P(TofConfigRefuses, WithFileLineAndKey) {
  const std::string message = error_of(std::string(kCamera) + GetParam().text);
  EXPECT_THAT(message, StartsWith(GetParam().expected));
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(
    Each, TofConfigRefuses,
    ::testing::Values(
        BadCamera{"UnknownKey", "packets = 9000\n", "p.toml:6: camera[0].packets: unknown key"},
        BadCamera{"UnknownRingKey", "[camera.ring]\nradius_m = 1\n", "p.toml:7: camera[0].ring.radius_m: unknown key"},
        BadCamera{"PacketTooLarge", "packet_size = 70000\n", "p.toml:6: camera[0].packet_size: must lie in"},
        BadCamera{"NoAddress", "address = 'helios.local'\n",
                  "p.toml:6: camera[0].address: \"helios.local\" is no IPv4"},
        BadCamera{"ModeWithBlank", "mode = 'far away'\n", "p.toml:6: camera[0].mode: must be a word"},
        BadCamera{"NoAverage", "average_frames = 0\n", "p.toml:6: camera[0].average_frames: must lie in"},
        BadCamera{"NoRate", "frame_rate_hz = 0\n", "p.toml:6: camera[0].frame_rate_hz: must"},
        BadCamera{"RingUpsideDown", "[camera.ring]\nleast_outer_radius_m = 0.9\nmost_outer_radius_m = 0.4\n",
                  "p.toml:8: camera[0].ring.most_outer_radius_m: the most must be more"},
        BadCamera{"NoConnectors", "connectors = 0\n", "p.toml:6: camera[0].connectors: must lie in"},
        BadCamera{"TargetFileGone", "target_file = 'gone.toml'\n",
                  "p.toml:6: camera[0].target_file: /etc/pharos/gone.toml: cannot be opened"},
        BadCamera{"TooManyConnectors", "target_file = 'many.toml'\n",
                  "p.toml:6: camera[0].target_file: /etc/pharos/many.toml: more than 8 connectors"},
        BadCamera{"RadiusTwice", "target_file = 'ring.toml'\n[camera.ring]\nleast_outer_radius_m = 0.2\n",
                  "p.toml:7: camera[0].ring: is in /etc/pharos/ring.toml already"},
        BadCamera{"ConnectorsTwice", "target_file = 'ring.toml'\nconnectors = 2\n",
                  "p.toml:7: camera[0].connectors: are in /etc/pharos/ring.toml already"},
        BadCamera{"FramesAndSerial", "frames = 'here'\n", "p.toml:5: camera[0].serial: is of a camera on the network"},
        BadCamera{"SameName", "[[camera]]\nname = 'helios'\ntarget = 'x'\ncamera_file = 'h.toml'\nserial = '2'\n",
                  "p.toml:7: camera[1].name: \"helios\" is taken"},
        BadCamera{"SameSerial", "[[camera]]\nname = 'b'\ntarget = 'x'\ncamera_file = 'h.toml'\nserial = '233300001'\n",
                  "p.toml:10: camera[1].serial: \"233300001\" is taken"},
        BadCamera{"NothingToFind", "[[camera]]\nname = 'b'\ntarget = 'x'\ncamera_file = 'h.toml'\n",
                  "p.toml:6: camera[1].serial: is missing"},
        BadCamera{"CameraFileGone", "[[camera]]\nname = 'b'\ntarget = 'x'\ncamera_file = 'gone.toml'\nserial = '2'\n",
                  "p.toml:9: camera[1].camera_file: /etc/pharos/gone.toml: cannot be opened"},
        BadCamera{"CameraTooLarge", "[[camera]]\nname = 'b'\ntarget = 'x'\ncamera_file = 'large.toml'\nserial = '2'\n",
                  "p.toml:9: camera[1].camera_file: /etc/pharos/large.toml: 1280 x 480 pixels are more than"},
        BadCamera{"FramesGone", "[[camera]]\nname = 'b'\ntarget = 'x'\ncamera_file = 'h.toml'\nframes = 'gone'\n",
                  "p.toml:10: camera[1].frames: /etc/pharos/gone: holds no frames"}),
    [](const auto& test) { return test.param.name; });

TEST(TofConfig, NeitherTargetNorCameraIsAnError) {
  EXPECT_THAT(error_of("source = 'x'\n"), HasSubstr("or a [[camera]]"));
}

}  // namespace
}  // namespace pharos::host
