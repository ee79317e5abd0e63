// SPDX-License-Identifier: Apache-2.0
// Outputs onto inputs, onto links, and under names that an attacker prepares while the command runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "campaigns/attack/campaign_table.hpp"
#include "campaigns/attack/command.hpp"
#include "integration/stationary_target.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoses = "pose,qw,qx,qy,qz,tx_m,ty_m,tz_m\n1,0.05,0.96,0.25,-0.1,0.3,-0.2,1.8\n";
constexpr const char* kVictim = "a file of somebody else\n";

class AttackedOutput : public ::testing::Test {
 protected:
  AttackedOutput() {
    folder.write("target.csv", StationaryTarget::target_table(12));
    folder.write("poses.csv", kPoses);
    folder.write("victim", kVictim);
    fs::create_directories(folder.path("images"));
  }
  std::string text(const std::string& name) const {
    std::ifstream in(folder.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  CommandResult precision(const std::string& poses, const std::string& output) const {
    return run_command({PHAROS, "precision", "--target", folder.path("target.csv"), "--poses", poses, "-o", output});
  }
  bool inputs_are_whole() const {
    return text("target.csv") == StationaryTarget::target_table(12) && text("poses.csv") == kPoses &&
           text("victim") == kVictim;
  }

  test::TemporaryFolder folder;
};

TEST_F(AttackedOutput, OntoItsInput) {
  fs::create_symlink("poses.csv", folder.path("soft"));
  fs::create_hard_link(folder.path("poses.csv"), folder.path("hard"));
  fs::create_directory_symlink(".", folder.path("here"));
  int runs = 0, destroyed = 0;
  double peak_mib = 0.0;
  const auto refused = [&](const std::vector<std::string>& arguments) {
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[1] << ": " << result.text;
    ++runs;
    destroyed += inputs_are_whole() ? 0 : 1;
    peak_mib = std::max(peak_mib, result.peak_mib);
  };
  const std::string poses = folder.path("poses.csv"), target = folder.path("target.csv"),
                    images = folder.path("images");
  for (const char* name : {"poses.csv", "soft", "hard", "here/poses.csv", "images/../poses.csv", "target.csv"}) {
    refused({PHAROS, "precision", "--target", target, "--poses", poses, "-o", folder.path(name)});
    refused({PHAROS, "track", poses, "--target", target, "-o", folder.path(name)});
    refused({PHAROS, "solve", poses, "--target", target, "-o", folder.path(name)});
    refused({PHAROS, "calibrate", "lighthouse", poses, "--target", target, "-o", folder.path(name)});
  }
  for (const char* name : {"poses.csv", "soft", "hard", "here/poses.csv"}) {
    refused({PHAROS, "evaluate", poses, target, "-o", folder.path(name)});
    refused({PHAROS, "decode", poses, "-o", folder.path(name)});
    refused({PHAROS, "enhance", poses, folder.path(name)});
    refused({PHAROS, "ellipses", poses, "-o", folder.path(name)});
    refused({PHAROS, "ellipses", poses, "--overlay", folder.path(name)});
    refused({PHAROS, "track", poses, "--target", target, "--sensors", folder.path(name)});
  }
  for (const char* name : {"images", "here/images", "images/."})
    refused({PHAROS, "enhance", images, folder.path(name)});
  EXPECT_EQ(destroyed, 0);
  add_row({"output onto its input", std::to_string(runs) + " runs of 9 commands, through links and other spellings",
           destroyed, std::nullopt, memory_text("largest process", peak_mib)});
}

// Links to somebody's file appear and vanish under the output's name and every predictable name beside it.
TEST_F(AttackedOutput, RacedByLinks) {
  const auto runs = static_cast<int>(campaign_size("PHAROS_ATTACK_OUTPUTS", 500));
  std::atomic<bool> ended = false;
  std::int64_t tries = 0;
  std::atomic<std::int64_t> placed = 0;
  std::thread attacker([&] {
    while (!ended) {
      for (const char* name :
           {"out.csv", "out.csv.new", "out.csv.tmp", "out.csv~", ".out.csv.new", ".out.csv.tmp", "out.csv.part"}) {
        const std::string path = folder.path(name);
        ::unlink(path.c_str());
        const int failed = tries % 2 == 0 ? ::symlink(folder.path("victim").c_str(), path.c_str())
                                          : ::link(folder.path("victim").c_str(), path.c_str());
        ++tries;
        if (failed == 0) ++placed;  // else the output is there
      }
    }
  });
  int destroyed = 0, answered = 0, crashes = 0;
  double peak_mib = 0.0;
  for (int i = 0; i < runs; ++i) {
    const CommandResult result = precision(folder.path("poses.csv"), folder.path("out.csv"));
    answered += result.exit_code == 0 ? 1 : 0;
    crashes += result.crashed() ? 1 : 0;
    if (!inputs_are_whole()) {
      ++destroyed;
      folder.write("victim", kVictim);
    }
    peak_mib = std::max(peak_mib, result.peak_mib);
  }
  ended = true;
  attacker.join();
  EXPECT_EQ(destroyed, 0);
  EXPECT_EQ(crashes, 0);
  EXPECT_EQ(answered, runs);
  add_row({"output raced by links", std::to_string(runs) + " runs, " + std::to_string(placed.load()) + " links placed",
           destroyed, std::nullopt, memory_text("largest process", peak_mib)});
}

}  // namespace
}  // namespace pharos::host
