// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

TEST(CliUsage, EverySubcommandHasHelpWithAnExample) {
  for (const char* command : {"decode", "track", "solve", "precision", "reproduce lighthouse", "sim lighthouse"}) {
    const Outcome run = pharos(std::string(command) + " --help");
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_THAT(run.out, HasSubstr("Example")) << command;
    EXPECT_THAT(run.out, HasSubstr(std::string("pharos ") + command)) << command;
  }
}

TEST(CliUsage, TellsItsVersion) {
  const Outcome run = pharos("--version");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CliUsage, WrongUsageEndsWith2AndPrintsNoRows) {
  for (const char* arguments :
       {"", "nonsense", "decode", "track edges.csv", "solve - --target", "decode a.csv --nonsense",
        "track a.csv --target b.csv --form 3", "track a.csv --target b.csv --method telepathy",
        "solve a.csv --target b.csv --start luck", "solve a.csv --target b.csv --rho 1.5",
        "solve a.csv --target b.csv --sigma-arcsec 0", "solve a.csv --target b.csv --time 0", "reproduce"}) {
    const Outcome run = pharos(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_NE(run.err, "") << arguments;
  }
}

}  // namespace
}  // namespace pharos::cli_test
