// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CliUsage, EverySubcommandHasHelpWithAnExample) {
  for (const char* command :
       {"decode", "track", "solve", "precision", "reproduce lighthouse", "reproduce stations", "calibrate stations",
        "calibrate mounting", "sim lighthouse", "sim serial", "sim approach", "listen", "export", "devices", "init",
        "plot poses", "plot precision", "plot calibration"}) {
    const Outcome run = pharos(std::string(command) + " --help");
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_THAT(run.out, HasSubstr("Example")) << command;
    EXPECT_THAT(run.out, HasSubstr(std::string("pharos ") + command)) << command;
  }
}

TEST(CliUsage, ReportsItsVersion) {
  const Outcome run = pharos("--version");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CliUsage, WrongUsageIsOneLineOfTheCommandThatEndsWith2) {
  for (const char* arguments :
       {"decode", "track edges.csv", "solve - --target", "decode a.csv b.csv", "decode a.csv --nonsense",
        "track a.csv --target b.csv --form 3", "track a.csv --target b.csv --method telepathy",
        "solve a.csv --target b.csv --start luck", "solve a.csv --target b.csv --rho 1.5",
        "solve a.csv --target b.csv --rho nan", "solve a.csv --target b.csv --sigma-arcsec 0",
        "solve a.csv --target b.csv --time 0", "listen --duration -1", "listen --count -1", "listen --csv --json"}) {
    const Outcome run = pharos(arguments);
    const std::string words = arguments;
    EXPECT_EQ(run.exit_code, 2) << words;
    EXPECT_EQ(run.out, "") << words;
    EXPECT_EQ(count_lines(run.err), 1u) << run.err;
    EXPECT_THAT(run.err, StartsWith("pharos " + words.substr(0, words.find(' ')) + ": ")) << words;
    EXPECT_LT(run.err.size(), 200u) << run.err;
  }
}

// Whatever links lead to it: the input would be gone before or after it was read.
TEST(CliUsage, RefusesToWriteOntoWhatItReads) {
  const Folder folder;
  const std::string file = folder.write("own.csv", "mine");
  std::filesystem::create_symlink("own.csv", folder.path("link.csv"));
  std::filesystem::create_hard_link(file, folder.path("hard.csv"));
  std::filesystem::create_directory(folder.path("images"));
  folder.write("images/one.png", "mine");
  const std::string at = folder.path().string() + "/";
  const std::string images = at + "images";
  for (const std::string& arguments : {"track " + file + " --target t.csv -o " + file,
                                       "track a.csv --target " + file + " -o " + at + "./link.csv",
                                       "track a.csv --target " + file + " --sensors " + file,
                                       "decode " + file + " -o " + at + "hard.csv",
                                       "solve " + file + " --target t.csv --output=" + file,
                                       "precision --target " + file + " --poses p.csv -o " + file,
                                       "enhance " + file + " " + file,
                                       "enhance " + images + " " + images + "/../images",
                                       "enhance " + images + " out --report " + images,
                                       "ellipses " + file + " --overlay " + file,
                                       "circles a.png " + file + " --rig r.toml --overlay " + file,
                                       "line " + file + " --camera c.toml --overlay " + file,
                                       "slam " + images + " r --rig r.toml --overlay " + images,
                                       "slam l r --rig " + file + " --report " + file,
                                       "tof " + images + " --camera c.toml --overlay " + images,
                                       "evaluate " + file + " t.csv --plot " + file,
                                       "evaluate e.csv " + file + " -o " + file,
                                       "vocabulary a.png " + file + " --output " + file,
                                       "layout --body " + file + " --sensors 4 --poses p.csv -o " + file,
                                       "calibrate lighthouse " + file + " --target t.csv -o " + file,
                                       "calibrate camera " + file + " -o " + file,
                                       "calibrate stereo --left " + file + " --right r.png -o " + file,
                                       "sim lighthouse " + file + " --output " + file,
                                       "sim capture " + file + " --output " + file}) {
    const Outcome run = pharos(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr("is the same file or folder as")) << arguments;
    EXPECT_EQ(count_lines(run.err), 1u) << run.err;
  }
  EXPECT_EQ(content_of(file), "mine");
  EXPECT_EQ(content_of(folder.path("images/one.png")), "mine");
}

TEST(CliUsage, APictureOfAKindThatIsNotWrittenIsRefused) {
  for (const auto& [arguments, kind] :
       {std::pair<std::string, std::string>{"evaluate e.csv t.csv --plot a.png", ".svg"},
        {"layout --body b.off --sensors 4 --poses p.csv -o t.csv --plot a.PNG", ".svg"},
        {"ellipses a.png --overlay b.svg", ".png"},
        {"enhance a.png b.jpg", ".png"}}) {
    const Outcome run = pharos(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr("pictures are written as " + kind + " only")) << arguments;
  }
}

TEST(CliUsage, HelpNamesTheWordsOfAChoiceAndNotTheirNumbers) {
  EXPECT_THAT(pharos("evaluate --help").out, HasSubstr("{hand-eye,none,se3}"));
  EXPECT_THAT(pharos("enhance --help").out, HasSubstr("{I,II,III}"));
  for (const char* command : {"evaluate", "enhance"}) {
    EXPECT_THAT(pharos(std::string(command) + " --help").out, testing::Not(HasSubstr("->")));
  }
}

TEST(CliUsage, TwoOutputsInOneFileAreRefused) {
  const Folder folder;
  const Outcome run =
      pharos("track a.csv --target t.csv -o " + folder.path("new") + " --sensors " + folder.path("new"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("is the same file or folder as"));
}

TEST(CliUsage, NamesAnUnknownCommandAndThoseThatThereAre) {
  const auto expect = [](const char* arguments, const std::string& start, const std::string& words) {
    const Outcome run = pharos(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(count_lines(run.err), 1u) << run.err;
    EXPECT_THAT(run.err, StartsWith(start));
    EXPECT_THAT(run.err, HasSubstr(words));
  };
  expect("bogus", "pharos: unknown command 'bogus'; the commands are decode, convert, track, solve", "`pharos --help`");
  expect("trakc", "pharos: unknown command 'trakc', did you mean 'track'?", "decode, convert");
  expect("trakc --help", "pharos: unknown command 'trakc', did you mean 'track'?", "decode, convert");
  expect("sim lightouse --help", "pharos sim: unknown command 'lightouse', did you mean 'lighthouse'?", "tof, line");
  expect("--bogus", "pharos: unknown option '--bogus'", "`pharos --help`");
  expect("", "pharos: no command given", "decode, convert, track, solve");
  expect("sim bogus", "pharos sim: unknown command 'bogus'", "lighthouse, tof, line, stereo, serial");
  expect("reproduce", "pharos reproduce: no command given", "lighthouse");
}

TEST(CliUsage, ASeedIsAWholeNumber) {
  for (const char* command : {"reproduce lighthouse", "sim lighthouse a.toml --output out", "sim serial a.toml"}) {
    for (const char* seed : {"-1", "1.5", "x", "99999999999999999999"}) {
      const Outcome run = pharos(std::string(command) + " --seed " + seed);
      EXPECT_EQ(run.exit_code, 2) << command << seed;
      EXPECT_THAT(run.err, HasSubstr(std::string("--seed: ") + seed + " is not a whole number")) << command;
    }
  }
}

}  // namespace
}  // namespace pharos::cli_test
