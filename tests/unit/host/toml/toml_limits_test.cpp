// SPDX-License-Identifier: Apache-2.0
#include "host/toml/toml_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "host/toml/strict_toml.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Nesting that would overflow the stack: without the limits each of these inputs crashes the program.
constexpr std::size_t kTooDeep = 50'000;

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

std::string refusal(const std::string& text) {
  return pharos::test::error_of([&] { TomlTable::parse_text(text, "file.toml"); });
}

TEST(TomlLimits, RefuseWhatWouldOverflowTheStackWithTheLineItIsIn) {
  const auto key = AllOf(StartsWith("file.toml:2: "), HasSubstr("a key of more than 16 parts"));
  EXPECT_THAT(refusal("b = 1\n" + repeated("a.", kTooDeep) + "a = 1\n"), key);
  EXPECT_THAT(refusal("b = 1\n" + repeated("'a' . \"a\".", kTooDeep) + "a = 1\n"), key);
  EXPECT_THAT(refusal("\n[" + repeated("a.", kTooDeep) + "a]\n"), key);
  EXPECT_THAT(refusal("\n[[" + repeated("a.", kTooDeep) + "a]]\n"), key);
  EXPECT_THAT(refusal("\nb = {" + repeated("a.", kTooDeep) + "a = 1}\n"), key);
  const auto nesting = AllOf(StartsWith("file.toml:2: "), HasSubstr("arrays or tables in one another"));
  EXPECT_THAT(refusal("\na = " + repeated("[", kTooDeep) + repeated("]", kTooDeep)), nesting);
  EXPECT_THAT(refusal("\na = " + repeated("{a = ", kTooDeep) + "1" + repeated("}", kTooDeep)), nesting);
  EXPECT_THAT(refusal("\na = " + repeated("[{a = ", kTooDeep) + "1" + repeated("}]", kTooDeep)), nesting);
}

TEST(TomlLimits, CountNothingInStringsAndComments) {
  const std::string much = repeated("a.[{", 1000);
  for (const std::string& text :
       {"a = '" + much + "'\n", "a = \"\\\"" + much + "\\\\\"\n", "# " + much + "\na = 'b'\n",
        "a = '''\n" + much + "''\n'''''\n", "a = \"\"\"\n" + much + "\"\"\\\"\n\"\"\"\"\"\n"}) {
    EXPECT_EQ(refusal(text), "");
    EXPECT_EQ(TomlTable::parse_text(text, "file.toml").keys().size(), 1u);
  }
}

// An unclosed quote, or a quote inside a string, must not hide the text that follows.
TEST(TomlLimits, AreNotLedAstrayByQuotes) {
  const std::string deep = repeated("a.", kTooDeep) + "a = 1\n";
  for (const std::string start : {"b = ''\n", "b = \"\"\n", "b = ''''''\n", "b = \"\"\"\"\"\"\n", "b = '''''''\n",
                                  "b = '\\'\n", "b = \"\\\\\"\n", "b = '''\\'''\n", "# it's\n", "b = \"#\"\n"}) {
    EXPECT_THAT(refusal(start + deep), HasSubstr("16 parts")) << start;
  }
}

TEST(TomlLimits, LeaveRoomForWhatFilesHold) {
  EXPECT_EQ(refusal(repeated("a.", kMaxTomlKeyParts - 1) + "a = " + repeated("[", kMaxTomlNesting) +
                    repeated("]", kMaxTomlNesting) + "\n"),
            "");
  EXPECT_EQ(refusal(repeated("[[station]]\nphase_rad = [0.0, 0.0]\n", 10'000)), "");
}

TEST(TomlLimits, RefuseAFileWithoutEnd) {
  EXPECT_THAT(pharos::test::error_of([] { TomlTable::parse_file("/dev/zero"); }), HasSubstr("more than 4 MiB"));
}

}  // namespace
}  // namespace pharos::host
