// SPDX-License-Identifier: Apache-2.0
// Images of two cameras that are exchanged, or the same twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "campaigns/attack/campaign_table.hpp"
#include "campaigns/attack/command.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

class AttackedImages : public ::testing::Test {
 protected:
  static std::vector<std::string> files_in(const std::string& place) {
    std::vector<std::string> files;
    for (const auto& file : fs::directory_iterator(place)) files.push_back(file.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  /// Counts the run as false if it gave an answer.
  void wrong(const std::vector<std::string>& arguments) {
    const CommandResult result = run_command(arguments, 300.0);
    ++runs;
    EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2) << arguments[1] << ": " << result.text;
    answers += result.exit_code == 0 ? 1 : 0;
    peak_mib = std::max(peak_mib, result.peak_mib);
  }

  test::TemporaryFolder folder;
  int runs = 0, answers = 0;
  double peak_mib = 0.0;
};

TEST_F(AttackedImages, ExchangedOrEqual) {
  const std::string pairs = folder.path("pairs"), rig = pairs + "/rig.toml", boards = folder.path("boards");
  const std::string scenario = PHAROS_SCENARIOS "/stereo_pairs.toml";
  ASSERT_EQ(run_command({PHAROS, "sim", "stereo", scenario, "--output", pairs}, 600.0).exit_code, 0);
  ASSERT_EQ(
      run_command({PHAROS, "sim", "stereo", "--scene", "boards", "--pairs", "6", "--output", boards}, 600.0).exit_code,
      0);
  for (const std::string& left : files_in(pairs)) {
    const std::size_t side = left.find("_left.png");
    if (side == std::string::npos) continue;
    const std::string right = left.substr(0, side) + "_right.png";
    ASSERT_EQ(run_command({PHAROS, "circles", left, right, "--rig", rig}).exit_code, 0) << left;
    wrong({PHAROS, "circles", right, left, "--rig", rig});
    wrong({PHAROS, "circles", left, left, "--rig", rig});
    wrong({PHAROS, "circles", right, right, "--rig", rig});
  }
  const auto calibrate = [&](const char* first, const char* second) {
    std::vector<std::string> arguments{
        PHAROS,  "calibrate", "stereo", "--pitch-mm", "80", "--radius-mm", "20", "-o", folder.path("rig.toml"),
        "--left"};
    for (const std::string& file : files_in(boards + '/' + first)) arguments.push_back(file);
    arguments.push_back("--right");
    for (const std::string& file : files_in(boards + '/' + second)) arguments.push_back(file);
    return arguments;
  };
  ASSERT_EQ(run_command(calibrate("left", "right"), 300.0).exit_code, 0);
  wrong(calibrate("right", "left"));
  wrong(calibrate("left", "left"));
  wrong(calibrate("right", "right"));
  for (const char* sides : {"right left", "left left"}) {
    const std::string first = std::string(sides).substr(0, std::string(sides).find(' ')),
                      second = std::string(sides).substr(first.size() + 1);
    wrong({PHAROS, "slam", boards + '/' + first, boards + '/' + second, "--rig", boards + "/rig.toml"});
  }
  add_row({"images exchanged or equal", std::to_string(runs) + " runs of circles, calibrate stereo, slam", answers,
           std::nullopt, memory_text("largest process", peak_mib)});
}

}  // namespace
}  // namespace pharos::host
