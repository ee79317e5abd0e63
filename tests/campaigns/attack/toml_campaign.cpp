// SPDX-License-Identifier: Apache-2.0
// TOML that overflows a stack or a memory, at every entry point; damaged files of remembered calibrations at a start.
#include <csignal>
#include <random>

#include "campaigns/attack/attacked_lighthouse.hpp"
#include "campaigns/attack/command.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

std::vector<std::string> bombs() {
  constexpr std::size_t kDeep = 50'000;
  return {repeated("a.", kDeep) + "a = 1\n",
          "[" + repeated("a.", kDeep) + "a]\n",
          "[[" + repeated("'a' . ", kDeep) + "a]]\n",
          "a = " + repeated("[", kDeep) + repeated("]", kDeep) + "\n",
          "a = " + repeated("{a = ", kDeep) + "1" + repeated("}", kDeep) + "\n",
          "a = " + repeated("[{a = ", kDeep) + "1" + repeated("}]", kDeep) + "\n",
          "a = " + repeated("[", 10 * kDeep),
          "# " + std::string(5'000'000, 'x') + "\na = 1\n",
          repeated("[[a]]\n", 1'000'000),
          "a = \"" + repeated("\\U0001F600", kDeep) + "\n",
          std::string(100'000, '\0')};
}

class AttackedFiles : public AttackedLighthouse {
 protected:
  /// Command lines of every program that reads TOML, with `file` as that file.
  std::vector<std::vector<std::string>> entry_points(const std::string& file) const {
    const std::string table = (daemon.folder() / "dock.csv").string(), out = (daemon.folder() / "out").string();
    const std::string edges = (daemon.folder() / "edges.csv").string(), images = (daemon.folder() / "images").string();
    const std::string image = images + "/0000_intensity.png";
    return {{DaemonUnderTest::program(), "--check", file},
            {DaemonUnderTest::program(), file},
            {DaemonUnderTest::program(), "--check", (daemon.folder() / "camera.toml").string()},
            {PHAROS, "track", edges, "--target", table, "--calibration", file},
            {PHAROS, "track", "--sweeps", edges, "--target", table, "--stations", file},
            {PHAROS, "tof", images, "--camera", file},
            {PHAROS, "tof", images, "--camera", file, "--target", file},
            {PHAROS, "circles", image, image, "--rig", file},
            {PHAROS, "circles", image, image, "--rig", file, "--target", file},
            {PHAROS, "slam", images, out, "--rig", file},
            {PHAROS, "line", image, "--camera", file, "--azimuth-deg", "0", "--elevation-deg", "10"},
            {PHAROS, "sim", "lighthouse", file, "--output", out},
            {PHAROS, "sim", "serial", file, "--link", out},
            {PHAROS, "sim", "capture", file},
            {PHAROS, "sim", "tof", file, "--output", out},
            {PHAROS, "sim", "camera", file, "--duration", "1"},
            {PHAROS, "sim", "stereo", file, "--output", out},
            {PHAROS, "sim", "line", file, "--output", out}};
  }
  void write(const fs::path& name, const std::string& text) const {
    std::ofstream(daemon.folder() / name, std::ios::binary) << text;
  }
};

TEST_F(AttackedFiles, BombsAtEveryEntryPoint) {
  daemon.write_config();
  write("edges.csv", "sensor,rise_ticks,fall_ticks\n0,100,300\n");
  fs::create_directories(daemon.folder() / "images");
  write("images/0000_intensity.png", "");
  write("camera.toml", "[[camera]]\nname = 'a'\ntarget = 'b'\naddress = '127.0.0.1'\ncamera_file = 'bomb.toml'\n");
  int runs = 0, crashes = 0, accepted = 0;
  double peak_mib = 0.0;
  const auto commands = entry_points((daemon.folder() / "bomb.toml").string());
  for (const std::string& bomb : bombs()) {
    write("bomb.toml", bomb);
    for (const std::vector<std::string>& command : commands) {
      const CommandResult result = run_command(command, 60.0);
      ++runs;
      crashes += result.crashed() ? 1 : 0;
      accepted += result.exit_code == 0 ? 1 : 0;
      peak_mib = std::max(peak_mib, result.peak_mib);
      EXPECT_FALSE(result.crashed()) << command[1] << ' ' << command[2] << ' ' << bomb.substr(0, 20) << '\n'
                                     << result.text.substr(0, 500);
      EXPECT_EQ(result.exit_code, 2) << command[1] << ' ' << command[2] << ' ' << bomb.substr(0, 20) << '\n'
                                     << result.text.substr(0, 500);
    }
  }
  add_row({"TOML bombs",
           std::to_string(runs) + " runs of " + std::to_string(commands.size()) + " entry points, " +
               std::to_string(crashes) + " crashes",
           accepted, std::nullopt, memory_text("largest process", peak_mib)});
}

TEST_F(AttackedFiles, DamagedRememberedCalibrations) {
  const auto random_files = static_cast<std::size_t>(campaign_size("PHAROS_ATTACK_STARTS", 12));
  start("", "state_directory = 'state'\n");
  for (int i = 0; i < 2; ++i) line.write(target.ootx(0, 0xBEC08E38));
  ASSERT_TRUE(daemon.process().wait_for("calibration of station 0 (BEC08E38) in use")) << daemon.process().text();
  EXPECT_EQ(stop(), 0);
  const fs::path file = daemon.folder() / "state" / "stations.toml";
  std::ifstream in(file, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  ASSERT_FALSE(good.empty());
  std::vector<std::string> damaged = bombs();
  std::mt19937 random(1);
  for (std::size_t i = 0; i < random_files; ++i) {
    std::string text = good.substr(0, i % 3 == 0 ? random() % good.size() : good.size());
    for (std::size_t changes = i % 3; changes > 0 && !text.empty(); --changes) {
      text[random() % text.size()] = static_cast<char>(random());
    }
    damaged.push_back(text);
  }
  int started = 0;
  std::string peak;
  for (const std::string& text : damaged) {
    fs::remove_all(file);
    std::ofstream(file, std::ios::binary) << text;
    daemon.start();
    const ::testing::AssertionResult come = poses_come(5);
    EXPECT_TRUE(come) << text.substr(0, 100);
    started += come ? 1 : 0;
    peak = memory();
    EXPECT_EQ(stop(), 0);
  }
  const int wrong = false_poses();
  const auto failed = static_cast<std::int64_t>(damaged.size()) - started;
  EXPECT_EQ(wrong, 0);
  add_row({"damaged remembered calibrations",
           std::to_string(damaged.size()) + " starts, " + std::to_string(failed) + " without poses", wrong, failed,
           peak});
}

}  // namespace
}  // namespace pharos::host
