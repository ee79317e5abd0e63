// SPDX-License-Identifier: Apache-2.0
#include "tools/support/output_place.hpp"

#include <gtest/gtest.h>

#include <string>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::tools {
namespace {

/// The refusal of a command with a file, a word, a number and an output.
std::string refusal(const std::string& arguments) {
  CLI::App command;
  std::string file, word, output;
  int number = 0;
  command.add_option("--file", file);
  command.add_option("--scene", word)->check(CLI::IsMember({"room", "street"}));
  command.add_option("--pairs", number)->check(CLI::Range(1, 1000));
  command.add_option("--output", output)->check(output_place());
  command.parse(arguments);
  return pharos::test::error_of([&] { refuse_output_onto_input(command); });
}

TEST(OutputPlace, OntoAnInputIsRefused) {
  EXPECT_EQ(refusal("--file room --output ./room"),
            "--output ./room: is the same file or folder as --file room, which would be lost; give another");
}

TEST(OutputPlace, MayHaveTheNameOfAWordOrANumber) {
  EXPECT_EQ(refusal("--scene room --output room"), "");
  EXPECT_EQ(refusal("--pairs 6 --output 6"), "");
}

}  // namespace
}  // namespace pharos::tools
