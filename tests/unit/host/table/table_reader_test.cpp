// SPDX-License-Identifier: Apache-2.0
#include "host/table/table_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::error_of;
using pharos::test::TemporaryFile;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Reads all numbers of columns b and a (in this order) and returns the error message, if any.
std::string table_error(std::string_view content) {
  const TemporaryFile file(content);
  return error_of([&] {
    TableReader table(ByteSource(file.path()), {"b", "a"});
    while (table.next()) {
      table.number(0);
      table.integer(1, 0, 9);
    }
  });
}

TEST(TableReader, FindsColumnsByNameInAnyOrder) {
  const TemporaryFile file("a,x,b\n1,ignored,2.5\n3,,-1e-3\n");
  TableReader table(ByteSource(file.path()), {"b", "a"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(0), 2.5);
  EXPECT_EQ(table.integer(1, 0, 9), 1);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(0), -1e-3);
  EXPECT_FALSE(table.next());
}

TEST(TableReader, AcceptsWhatEditorsDo) {
  const TemporaryFile file(
      "\xEF\xBB\xBF"
      "b, a\r\n 1.5 ,\t2\r\n\r\n3,4");
  TableReader table(ByteSource(file.path()), {"b", "a"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(0), 1.5);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.line_number(), 4u);
  EXPECT_EQ(table.integer(1, 0, 9), 4);
  EXPECT_FALSE(table.ended_unfinished());
}

TEST(TableReader, DistinguishesEmptyFieldsFromNumbers) {
  const TemporaryFile file("a,b\n,1\n");
  TableReader table(ByteSource(file.path()), {"a", "b"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.optional_number(0), std::nullopt);
  EXPECT_EQ(table.optional_number(1), 1.0);
}

TEST(TableReader, FindsOptionalColumns) {
  const TemporaryFile file("a,b\n1,2\n");
  TableReader table(ByteSource(file.path()), {"b"});
  EXPECT_EQ(table.find_optional("c"), std::nullopt);
  const auto a = table.find_optional("a");
  ASSERT_TRUE(a);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(*a), 1.0);
}

TEST(TableReader, NamesTheMissingColumn) {
  EXPECT_THAT(table_error("a,c\n1,2\n"), AllOf(HasSubstr("line 1"), HasSubstr("no column 'b'"), HasSubstr("'a,c'")));
}

TEST(TableReader, RefusesAColumnTwice) { EXPECT_THAT(table_error("a,b,a\n1,2,3\n"), HasSubstr("'a' stands twice")); }

TEST(TableReader, RefusesAnEmptyFile) { EXPECT_THAT(table_error(""), HasSubstr("empty")); }

TEST(TableReader, NamesLineAndColumnOfWhatIsNoNumber) {
  EXPECT_THAT(table_error("a,b\n1,2\n1,2x\n"), AllOf(HasSubstr("line 3"), HasSubstr("column 'b'"), HasSubstr("'2x'")));
  for (const char* bad : {"", "nan", "inf", "1e999", "0x10", "1 2", "+1", "1,"}) {
    EXPECT_NE(table_error(std::string("a,b\n1,") + bad + "\n"), "") << bad;
  }
  for (const char* bad : {"", "1.0", "10", "-1", "99999999999999999999"}) {
    EXPECT_NE(table_error(std::string("a,b\n") + bad + ",1\n"), "") << bad;
  }
}

TEST(TableReader, RefusesRowsOfAnotherLength) {
  EXPECT_THAT(table_error("a,b\n1\n"), AllOf(HasSubstr("line 2"), HasSubstr("1 fields"), HasSubstr("has 2")));
}

TEST(TableReader, RefusesBinaryData) {
  EXPECT_THAT(table_error(std::string_view("a,b\n\0\1\2\n", 8)), HasSubstr("binary"));
  EXPECT_THAT(table_error(std::string(100'000, 'x')), HasSubstr("64 KiB"));
}

TEST(TableReader, DropsTheUnfinishedLineOfARecordingOnly) {
  const TemporaryFile file("a,b\n1,2\n1,23");
  TableReader recording(ByteSource(file.path()), {"a", "b"}, LastLine::kDropUnfinished);
  ASSERT_TRUE(recording.next());
  EXPECT_FALSE(recording.next());
  EXPECT_TRUE(recording.ended_unfinished());
}

}  // namespace
}  // namespace pharos::host
