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

constexpr const char* kHead = "[[stereo]]\nname = 'bow'\ntarget = 'client'\nrig_file = 'rig.toml'\n";
constexpr const char* kCameras = "[stereo.left]\nserial = 'L1'\n[stereo.right]\naddress = '169.254.1.3'\n";

std::string rig(const std::string& keys = "systems = ['ring2']\n", const std::string& cameras = kCameras) {
  return kHead + keys + cameras;
}

TEST(StereoConfig, OfOneRigSufficesForADaemon) {
  const DaemonConfig config = parse(rig());
  ASSERT_EQ(config.stereos.size(), 1u);
  const StereoConfig& stereo = config.stereos[0];
  EXPECT_EQ(stereo.name, "bow");
  EXPECT_EQ(stereo.rig_file, "/etc/pharos/rig.toml");
  EXPECT_EQ(stereo.devices[0].serial, "L1");
  EXPECT_EQ(stereo.devices[1].address, "169.254.1.3");
  EXPECT_EQ(stereo.devices[1].width_px, 640) << "of the rig file";
  EXPECT_EQ(stereo.devices[0].format, CameraFormat::kMono8);
  EXPECT_DOUBLE_EQ(stereo.pairing_window_s, 0.005);
  EXPECT_TRUE(stereo.ring2);
  EXPECT_FALSE(stereo.slam);
  EXPECT_FALSE(stereo.is_recorded());
}

TEST(StereoConfig, TakesEveryKey) {
  const StereoConfig stereo =
      parse(rig("systems = ['slam', 'ring2']\npixel_format = 'Mono16'\npacket_size = 9000\nframe_rate_hz = 10\n"
                "ptp = false\npairing_window_ms = 20\n[stereo.slam]\nscene = 'static'\nfeatures = 500\n"
                "max_keyframes = 20\nvocabulary = 'my.words'\nclose_loops = false\nenhance = 'fast'\n"))
          .stereos.at(0);
  EXPECT_EQ(stereo.devices[0].format, CameraFormat::kMono16);
  EXPECT_EQ(stereo.devices[1].packet_size, 9000);
  EXPECT_EQ(stereo.devices[1].frame_rate_hz, 10.0);
  EXPECT_FALSE(stereo.devices[0].ptp);
  EXPECT_DOUBLE_EQ(stereo.pairing_window_s, 0.02);
  EXPECT_TRUE(stereo.ring2);
  ASSERT_TRUE(stereo.slam);
  EXPECT_EQ(stereo.slam->settings.scene, slam::Scene::kStatic);
  EXPECT_EQ(stereo.slam->settings.features, 500);
  EXPECT_EQ(stereo.slam->settings.max_keyframes, 20u);
  EXPECT_EQ(stereo.slam->settings.vocabulary, "/etc/pharos/my.words");
  EXPECT_FALSE(stereo.slam->settings.close_loops);
  EXPECT_TRUE(stereo.slam->settings.threads) << "live";
  EXPECT_FALSE(stereo.slam->settings.keep_trajectory) << "without end";
  EXPECT_EQ(stereo.slam->enhance, LowLight::kFast);
}

TEST(StereoConfig, TakesRecordedPairsInPlaceOfCameras) {
  const StereoConfig stereo = parse(rig("systems = ['slam']\nframes = 'here'\n", "")).stereos.at(0);
  EXPECT_TRUE(stereo.is_recorded());
  EXPECT_EQ(stereo.frames, "/etc/pharos/here");
  EXPECT_EQ(stereo.slam->enhance, LowLight::kOff);
}

TEST(StereoConfig, IsReported) {
  const std::string text = describe(parse(rig("systems = ['slam', 'ring2']\n[stereo.slam]\nenhance = 'none'\n")));
  for (const char* words : {"stereo bow (target client)", "left: serial number L1, right: at 169.254.1.3",
                            "frames within 5 ms", "640 x 480 pixels from /etc/pharos/rig.toml", "ring2: docking ring",
                            "slam: scene auto, features by the images' size", "enhanced, not denoised",
                            "PHAROS_RING2_POSE", "PHAROS_SLAM_POSE"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
  EXPECT_THAT(describe(parse(rig())), Not(HasSubstr("SLAM")));
}

TEST(StereoConfig, RefusesEachCameraBesideFrames) {
  const std::string error = error_of(rig("systems = ['ring2']\nframes = 'here'\n"));
  EXPECT_THAT(error, StartsWith("p.toml:7: stereo[0].left: is of a camera on the network"));
  EXPECT_THAT(error, HasSubstr("\np.toml:9: stereo[0].right: is of a camera on the network"));
}

struct BadStereo {
  const char* name;
  std::string text;
  const char* expected;
  friend void PrintTo(const BadStereo& bad, std::ostream* out) { *out << bad.name; }
};

class StereoConfigRefuses : public ::testing::TestWithParam<BadStereo> {};

TEST_P(StereoConfigRefuses, WithFileLineAndKey) {
  const std::string message = error_of(GetParam().text);
  EXPECT_THAT(message, StartsWith(GetParam().expected));
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
}

INSTANTIATE_TEST_SUITE_P(
    Each, StereoConfigRefuses,
    ::testing::Values(
        BadStereo{"NoSystem", rig(""), "p.toml:1: stereo[0].systems: is missing; give [\"ring2\"]"},
        BadStereo{"UnknownSystem", rig("systems = ['tof']\n"), "p.toml:5: stereo[0].systems: \"tof\" is none"},
        BadStereo{"SystemTwice", rig("systems = ['slam', 'slam']\n"), "p.toml:5: stereo[0].systems: names \"slam\" tw"},
        BadStereo{"SlamNotAsked", rig() + "[stereo.slam]\nfeatures = 500\n",
                  "p.toml:10: stereo[0].slam: is of a system that systems does not name"},
        BadStereo{"UnknownKey", rig("systems = ['ring2']\nwindow_ms = 5\n"),
                  "p.toml:6: stereo[0].window_ms: unknown key"},
        BadStereo{"UnknownSlamKey", rig("systems = ['slam']\n[stereo.slam]\nenhanced = 'fast'\n"),
                  "p.toml:7: stereo[0].slam.enhanced: unknown key; did you mean \"enhance\"?"},
        BadStereo{"UnknownCameraKey", rig() + "mode = 'x'\n", "p.toml:10: stereo[0].right.mode: unknown key"},
        BadStereo{"CamerasAlike",
                  rig("systems = ['ring2']\n", "[stereo.left]\nserial = 'L1'\n[stereo.right]\nserial = 'L1'\n"),
                  "p.toml:9: stereo[0].right.serial: \"L1\" is taken by another camera"},
        BadStereo{"CameraOfATofLine",
                  "[[camera]]\nname = 'h'\ntarget = 'b'\ncamera_file = 'c.toml'\nserial = 'L1'\n" + rig(),
                  "p.toml:12: stereo[0].left.serial: \"L1\" is taken"},
        BadStereo{"OneCamera", rig("systems = ['ring2']\n", "[stereo.left]\nserial = 'L1'\n"),
                  "p.toml:1: stereo[0].right.serial: is missing"},
        BadStereo{"WindowTooWide", rig("systems = ['ring2']\nframe_rate_hz = 20\npairing_window_ms = 25\n"),
                  "p.toml:7: stereo[0].pairing_window_ms: must be below half"},
        BadStereo{"WrongFormat", rig("systems = ['ring2']\npixel_format = 'Mono12'\n"),
                  "p.toml:6: stereo[0].pixel_format: "},
        BadStereo{
            "RigGone",
            std::string("[[stereo]]\nname = 'b'\ntarget = 'c'\nrig_file = 'gone'\nsystems = ['ring2']\n") + kCameras,
            "p.toml:4: stereo[0].rig_file: /etc/pharos/gone: cannot be opened"},
        BadStereo{"SameName", rig() + rig("systems = ['ring2']\n", "frames = 'x'\n"),
                  "p.toml:11: stereo[1].name: \"bow\" is taken by another rig"}),
    [](const auto& test) { return test.param.name; });

TEST(StereoConfig, PassesOnWhatARigAVocabularyOrPairsAreNoGoodFor) {
  Environment environment = made_up();
  const auto no = [](const char* what) { throw InputError(what); };
  environment.check_slam = [&](const RigFile&, const std::string& name) { no((name + ": no baseline").c_str()); };
  environment.check_vocabulary = [&](const std::string& path) {
    if (!path.empty()) no((path + ": cut short").c_str());
  };
  environment.check_pairs = [&](const std::filesystem::path&, const RigFile&, const std::string&) {
    no("0000_left.png: has 2 x 2");
    return false;
  };
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      parse_daemon_config(text, "p.toml", "/etc/pharos", environment);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal(rig()), "no error") << "slam was not asked for";
  EXPECT_EQ(refusal(rig("systems = ['slam']\n")), "p.toml:4: stereo[0].rig_file: /etc/pharos/rig.toml: no baseline");
  EXPECT_EQ(refusal(rig("systems = ['slam']\n[stereo.slam]\nvocabulary = 'v'\n")),
            "p.toml:7: stereo[0].slam.vocabulary: /etc/pharos/v: cut short\n"
            "p.toml:4: stereo[0].rig_file: /etc/pharos/rig.toml: no baseline");
  EXPECT_EQ(refusal(rig("systems = ['ring2']\nframes = 'd'\n", "")),
            "p.toml:6: stereo[0].frames: 0000_left.png: has 2 x 2");
}

}  // namespace
}  // namespace pharos::host
