// SPDX-License-Identifier: Apache-2.0
#include "host/table/edges_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::error_of;
using pharos::test::TemporaryFile;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Reading {
  std::vector<std::int64_t> rises;
  std::vector<std::int64_t> widths;
  std::vector<int> sensors;
  bool unfinished = false;
};

Reading read_edges(std::string_view content) {
  const TemporaryFile file(content);
  EdgesReader reader{ByteSource(file.path())};
  Reading out;
  while (const auto pulse = reader.next()) {
    out.sensors.push_back(pulse->sensor);
    out.rises.push_back(pulse->rise_ticks);
    out.widths.push_back(pulse->fall_ticks - pulse->rise_ticks);
  }
  out.unfinished = reader.ended_unfinished();
  return out;
}

std::string edges_error(std::string_view content) {
  return error_of([&] { read_edges(content); });
}

TEST(EdgesReader, ReadsPulses) {
  const Reading r = read_edges("sensor,rise_ticks,fall_ticks\n2,0,121\n14,26,139\n");
  EXPECT_THAT(r.sensors, ElementsAre(2, 14));
  EXPECT_THAT(r.rises, ElementsAre(0, 26));
  EXPECT_THAT(r.widths, ElementsAre(121, 113));
}

TEST(EdgesReader, PassesOverOtherColumnsInAnyOrder) {
  const Reading r = read_edges("note,fall_ticks,rise_ticks,x,sensor,y\na,200,100,,5,?\n");
  EXPECT_THAT(r.sensors, ElementsAre(5));
  EXPECT_THAT(r.rises, ElementsAre(100));
}

TEST(EdgesReader, UnwrapsThe32BitCounter) {
  const Reading r = read_edges("sensor,rise_ticks,fall_ticks\n0,4294967290,4\n0,10,20\n");
  EXPECT_THAT(r.rises, ElementsAre(4294967290, 4294967296 + 10));
  EXPECT_THAT(r.widths, ElementsAre(10, 10));
}

TEST(EdgesReader, TakesUnwrappedTimesAsWritten) {
  const Reading r = read_edges(
      "sensor,rise_ticks,fall_ticks\n0,4294967290,4294967300\n0,4294967400,4294967410\n0,99999999999,99999999999\n");
  EXPECT_THAT(r.rises, ElementsAre(4294967290, 4294967400, 99999999999));
  EXPECT_THAT(r.widths, ElementsAre(10, 10, 0));
}

TEST(EdgesReader, IgnoresAStaleStart) {
  // As in a real recording: first rows 14.2 s ahead of the others, which begin at zero.
  const Reading r = read_edges("sensor,rise_ticks,fall_ticks\n12,711021111,711089377\n2,0,121\n14,26,139\n");
  EXPECT_THAT(r.rises, ElementsAre(711021111, 0, 26));
}

TEST(EdgesReader, HandsOddPulsesOnToTheDecoder) {
  const Reading r = read_edges("sensor,rise_ticks,fall_ticks\n40,100,90\n999999,100,110\n");
  EXPECT_THAT(r.sensors, ElementsAre(40, 255));
  EXPECT_THAT(r.widths, ElementsAre(-10, 10));
}

TEST(EdgesReader, DropsALineCutOffInWritingAndSaysSo) {
  const Reading r = read_edges("sensor,rise_ticks,fall_ticks\n0,100,200\n0,1000,11");
  EXPECT_THAT(r.rises, ElementsAre(100));
  EXPECT_TRUE(r.unfinished);
  EXPECT_FALSE(read_edges("sensor,rise_ticks,fall_ticks\r\n0,100,200\r\n").unfinished);
}

TEST(EdgesReader, NamesLineAndColumnOfADefect) {
  const std::string head = "sensor,rise_ticks,fall_ticks\n0,1,2\n";
  EXPECT_THAT(edges_error(head + "0,1x,2\n"), AllOf(HasSubstr("line 3"), HasSubstr("'rise_ticks'"), HasSubstr("'1x'")));
  EXPECT_THAT(edges_error(head + "-1,1,2\n"), HasSubstr("'sensor'"));
  EXPECT_THAT(edges_error(head + "0,1\n"), HasSubstr("2 fields"));
  EXPECT_THAT(edges_error(head + "0,1,2,3\n"), HasSubstr("4 fields"));
  EXPECT_THAT(edges_error(head + "0,1,9223372036854775807\n"), HasSubstr("'fall_ticks'"));
}

TEST(EdgesReader, NamesTheMissingColumn) {
  EXPECT_THAT(edges_error("sensor,rise,fall\n"),
              AllOf(HasSubstr("no column 'rise_ticks'"), HasSubstr("'sensor,rise,fall'")));
  EXPECT_THAT(edges_error("sensor,rise_ticks,fall_ticks,sensor\n"), HasSubstr("more than one column 'sensor'"));
  EXPECT_THAT(edges_error(""), HasSubstr("empty"));
}

TEST(EdgesReader, KnowsATableFromAStream) {
  EXPECT_TRUE(EdgesReader::looks_like("sensor,rise_ticks,fall_ticks\n0,1,2"));
  EXPECT_FALSE(EdgesReader::looks_like(std::string_view("\xA5\x00\x17", 3)));
  EXPECT_FALSE(EdgesReader::looks_like("sensor,x_m,y_m,z_m\n"));
}

}  // namespace
}  // namespace pharos::host
