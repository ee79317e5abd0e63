// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "tools/manual/completion.hpp"
#include "tools/manual/description.hpp"
#include "tools/manual/man_page.hpp"

namespace pharos::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A program with one of everything that a definition may have.
class Manual : public ::testing::Test {
 protected:
  Manual() {
    app_.set_version_flag("--version", "1.2.3");
    CLI::App* play = app_.add_subcommand("play", "Plays a recording");
    play->add_option("FILES", files_, "Recordings")->required();
    play->add_option("-s,--speed", speed_, "Times real speed")->check(CLI::Range(0, 9))->capture_default_str();
    play->add_option("--mode", mode_, "How")->check(CLI::IsMember({"once", "loop"}))->required();
    play->add_flag("--quiet", quiet_, "Says nothing");
    play->add_flag("--secret", quiet_, "For tests")->group("");
    play->footer("Example:\n  app play it's.\\file --mode once\nA sentence that goes on\nover a line.\n.hidden");
    app_.add_subcommand("internal", "For tests")->group("");
  }

  CommandDescription program() const { return describe(app_); }
  CommandDescription play() const { return program().commands.at(0); }
  std::string page() const { return man_page(play(), {1, "1.2.3", "0: good.", {"other(8)"}}); }

  CLI::App app_{"Does things", "app"};
  std::vector<std::string> files_;
  int speed_ = 1;
  std::string mode_;
  bool quiet_ = false;
};

TEST_F(Manual, DescribesOptionsAsDefined) {
  const CommandDescription command = play();
  EXPECT_THAT(command.words, ElementsAre("app", "play"));
  EXPECT_EQ(command.name('-'), "app-play");
  ASSERT_EQ(command.arguments.size(), 1U);
  EXPECT_THAT(command.arguments[0].names, ElementsAre("FILES"));
  EXPECT_TRUE(command.arguments[0].required);
  EXPECT_TRUE(command.arguments[0].repeated);
  ASSERT_EQ(command.options.size(), 4U);  // with --help
  const OptionDescription& speed = command.options[1];
  EXPECT_THAT(speed.names, ElementsAre("-s", "--speed"));
  EXPECT_EQ(speed.initial, "1");
  EXPECT_THAT(speed.limits, HasSubstr("[0 - 9]"));
  EXPECT_THAT(command.options[2].choices, ElementsAre("once", "loop"));
  EXPECT_TRUE(command.options[2].required);
  EXPECT_EQ(command.options[3].value, "");
}

TEST_F(Manual, LeavesOutWhatHelpHides) {
  EXPECT_EQ(program().commands.size(), 1U);
  EXPECT_THAT(page(), Not(HasSubstr("secret")));
}

TEST_F(Manual, PageHasEveryOptionWithItsLimits) {
  for (const char* text : {"\\fB\\-s\\fR, \\fB\\-\\-speed\\fR", "\\fB\\-\\-mode\\fR", "\\fB\\-\\-quiet\\fR",
                           "\\fIFILES\\fR...", "One of: once, loop.", "Default: 1.", "Required.",
                           "app\\-play \\- Plays a recording", "0: good.", "app(1), other(8)"}) {
    EXPECT_THAT(page(), HasSubstr(text));
  }
}

TEST_F(Manual, PageProtectsWhatRoffInterprets) {
  EXPECT_EQ(roff_text("it's.\\file -x"), "it\\(aqs.\\(rsfile \\-x");
  EXPECT_EQ(roff_text(".hidden\n'x"), "\\&.hidden\n\\&\\(aqx");
  EXPECT_EQ(roff_text("a,b, c,\nd"), "a,\\:b, c,\nd");  // a list of columns may be broken
  EXPECT_THAT(page(), HasSubstr("\n\\&.hidden\n"));
}

TEST_F(Manual, ExamplesKeepTheirLinesAndSentencesDoNot) {
  EXPECT_THAT(page(), HasSubstr(".nf\n  app play it\\(aqs.\\(rsfile \\-\\-mode once\n.fi"));
}

TEST_F(Manual, CompletionsKnowCommandsOptionsAndValues) {
  const std::string bash = bash_completion(program());
  EXPECT_THAT(bash, HasSubstr("\"app\") echo \"play\""));
  EXPECT_THAT(bash, HasSubstr("\"app play --mode\") echo \"once loop\""));
  EXPECT_THAT(bash, HasSubstr("\"app play -s\"|\"app play --speed\") echo \"\""));
  EXPECT_THAT(bash, Not(HasSubstr("\"app play --quiet\"")));
  const std::string zsh = zsh_completion(program());
  EXPECT_THAT(zsh, HasSubstr("--mode[How]:TEXT:(once loop)"));
  EXPECT_THAT(zsh, HasSubstr("*:FILES:_files"));
}

}  // namespace
}  // namespace pharos::tools
