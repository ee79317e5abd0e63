// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

std::string scenario(const Folder& folder) {
  return "duration_s = 0.5\ntarget = \"" + folder.write("solid.csv", solid_target_csv()) +
         "\"\n[[station]]\n[trajectory]\nkind = \"rest\"\nposes = [[0.05, 0.96, 0.25, -0.1, 0.3, -0.2, 1.8]]\n";
}

TEST(CliSim, TakesTheScenarioFromStandardInput) {
  const Folder folder;
  const std::string text = scenario(folder);
  const Outcome from_file =
      pharos("sim lighthouse " + folder.write("a.toml", text) + " --seed 3 --output " + folder.path("a"));
  EXPECT_EQ(from_file.exit_code, 0) << from_file.err;
  const Outcome from_pipe = pharos("sim lighthouse - --seed 3 --output " + folder.path("b"), text);
  EXPECT_EQ(from_pipe.exit_code, 0) << from_pipe.err;
  EXPECT_EQ(content_of(folder.path("a/edges.csv.gz")), content_of(folder.path("b/edges.csv.gz")));
  EXPECT_NE(content_of(folder.path("b/edges.csv.gz")), "");
}

TEST(CliSim, ACameraThatCannotBeServedIsNotAnnounced) {
  const Outcome run =
      pharos("sim camera " PHAROS_SCENARIOS "/tof_still.toml --frames 1 --duration 1 --address 192.0.2.1");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("192.0.2.1"));
}

TEST(CliSim, NamesStandardInputAndLineOfABadScenario) {
  const Folder folder;
  const Outcome run = pharos("sim lighthouse - --output " + folder.path("out"), "duration_s = 1\nduratoin_s = \"x");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("pharos sim lighthouse: standard input:2"));
}

}  // namespace
}  // namespace pharos::cli_test
