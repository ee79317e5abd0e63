// SPDX-License-Identifier: Apache-2.0
#include "host/toml/strict_toml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const std::string& text, const std::function<void(const TomlTable&)>& read) {
  return pharos::test::error_of([&] {
    const TomlTable root = TomlTable::parse_text(text, "file.toml");
    read(root);
    root.reject_unknown();
  });
}

TEST(StrictToml, ReadsEveryKindOfValue) {
  const TomlTable root = TomlTable::parse_text(
      "a = 1.5\nb = 7\nc = true\nd = 'word'\ne = [1, 2.5]\nf = [[1, 2], [3, 4]]\n[g]\nh = 2\n[[i]]\nj = 1\n[[i]]\nj = "
      "2\n",
      "file.toml");
  EXPECT_EQ(root.number("a"), 1.5);
  EXPECT_EQ(root.number("b"), 7.0);
  EXPECT_EQ(root.integer("b", 0, 10), 7);
  EXPECT_TRUE(root.boolean_or("c", false));
  EXPECT_EQ(root.text("d"), "word");
  EXPECT_EQ((root.vector<2>("e")), (std::array<double, 2>{1.0, 2.5}));
  EXPECT_EQ(root.rows("f", 2).at(1).at(0), 3.0);
  EXPECT_EQ(root.table("g").number("h"), 2.0);
  EXPECT_EQ(root.tables("i").at(1).integer("j", 0, 9), 2);
  EXPECT_EQ(root.tables("i").at(0).integer("j", 0, 9), 1);
  EXPECT_EQ(root.number_or("absent", 4.0), 4.0);
  EXPECT_NO_THROW(root.reject_unknown());
}

TEST(StrictToml, NamesFileLineAndKeyOfAnUnknownKeyAndGuessesWhatWasMeant) {
  const auto read = [](const TomlTable& root) { root.table_or_empty("noise").number_or("sigma_arcsec", 8.8); };
  EXPECT_THAT(message_of("[noise]\n\nsigma_arcsecs = 3\n", read),
              AllOf(HasSubstr("file.toml:3:"), HasSubstr("noise.sigma_arcsecs"), HasSubstr("sigma_arcsec\"?")));
  EXPECT_THAT(message_of("[noize]\n", read), AllOf(HasSubstr("file.toml:1:"), HasSubstr("noize: unknown key")));
}

TEST(StrictToml, FindsUnknownKeysInEveryElementOfAnArrayOfTables) {
  const auto read = [](const TomlTable& root) {
    for (const TomlTable& station : root.tables("station")) station.text_or("id", "");
  };
  EXPECT_THAT(message_of("[[station]]\nid = 'a'\n[[station]]\nname = 'b'\n", read),
              AllOf(HasSubstr("file.toml:4:"), HasSubstr("station[1].name")));
}

TEST(StrictToml, RefusesWrongTypesAndValuesOutOfRange) {
  const auto number = [](const TomlTable& root) { root.number("rate", kFraction); };
  EXPECT_THAT(message_of("rate = 'x'", number), AllOf(HasSubstr("file.toml:1: rate:"), HasSubstr("not a string")));
  EXPECT_THAT(message_of("\nrate = 1.5", number), AllOf(HasSubstr("file.toml:2: rate:"), HasSubstr("0 to 1")));
  EXPECT_THAT(message_of("rate = nan", number), HasSubstr("finite"));
  EXPECT_THAT(message_of("", number), HasSubstr("rate: is missing"));
  EXPECT_THAT(message_of("n = 1.0", [](const TomlTable& root) { root.integer("n", 0, 5); }), HasSubstr("an integer"));
  EXPECT_THAT(message_of("n = 6", [](const TomlTable& root) { root.integer("n", 0, 5); }), HasSubstr("0 to 5"));
  EXPECT_THAT(message_of("v = [1]", [](const TomlTable& root) { root.vector<3>("v"); }), HasSubstr("3 numbers, not 1"));
  EXPECT_THAT(message_of("m = 'D'",
                         [](const TomlTable& root) {
                           root.choice("m", {"A", "B"});
                         }),
              HasSubstr("one of A, B"));
  EXPECT_THAT(message_of("t = 1", [](const TomlTable& root) { root.table("t"); }), HasSubstr("must be a table"));
}

TEST(StrictToml, SaysWhereTheTextIsNotToml) {
  EXPECT_THAT(message_of("a = 1\nb = = 2\n", [](const TomlTable&) {}), HasSubstr("file.toml:2: not valid TOML"));
  EXPECT_THROW(TomlTable::parse_file("/nonexistent/file.toml"), InputError);
  EXPECT_THROW(TomlTable::parse_file("/"), InputError);
}

}  // namespace
}  // namespace pharos::host
