// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/track_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::pointing {
namespace {

using ::testing::HasSubstr;

TrackFile read(const std::string& text, host::LastLine last_line = host::LastLine::kAccept) {
  const pharos::test::TemporaryFile file(text);
  return read_track(host::ByteSource(file.path()), last_line);
}

std::string error_of(const std::string& text) {
  return pharos::test::error_of([&] { read(text); });
}

TEST(TrackFile, ReadsTheContractsColumnsAndTheFurtherOnes) {
  const TrackFile bare = read("image,time_s,azimuth_deg,elevation_deg\na.png,1.5,90,45\n");
  ASSERT_EQ(bare.rows.size(), 1u);
  EXPECT_EQ(bare.rows[0].image, "a.png");
  EXPECT_DOUBLE_EQ(bare.rows[0].observation.sight.azimuth_rad, 0.5 * kPi);
  EXPECT_EQ(bare.rows[0].observation.range_m, 0.0);
  EXPECT_FALSE(bare.station);
  const TrackFile full = read(
      "image,range_m,time_s,azimuth_deg,elevation_deg,latitude_deg,longitude_deg,height_m\n"
      "a.png,5e5,1,90,45,34.27,108.95,400\nb.png,,2,91,46,,,\n");
  EXPECT_EQ(full.rows[0].observation.range_m, 5e5);
  ASSERT_TRUE(full.station);
  EXPECT_DOUBLE_EQ(full.station->latitude_rad, 34.27 * kRadPerDeg);
}

TEST(TrackFile, RowsWithGapsAndOutOfRangeKeepTheirPlaceAndAreNamed) {
  const TrackFile track = read(
      "image,time_s,azimuth_deg,elevation_deg\na.png,1,90,45\nb.png,2,,45\nc.png,,90,45\nd.png,4,400,45\ne.png,5,90,-"
      "3\nf.png,6,90,91\n");
  ASSERT_EQ(track.rows.size(), 6u);
  EXPECT_EQ(track.rows[0].refusal, "");
  EXPECT_EQ(track.rows[1].refusal, "track_gap");
  EXPECT_EQ(track.rows[2].refusal, "track_gap");
  EXPECT_EQ(track.rows[3].refusal, "azimuth_out_of_range");
  EXPECT_EQ(track.rows[4].refusal, "elevation_out_of_range");
  EXPECT_EQ(track.rows[5].refusal, "elevation_out_of_range");
}

TEST(TrackFile, NamesTheLineOfWhatCannotBeRead) {
  const std::string head = "image,time_s,azimuth_deg,elevation_deg\n";
  EXPECT_THAT(error_of(head + "a.png,1,90,45\nb.png,1,90,45\n"), HasSubstr("line 3"));
  EXPECT_THAT(error_of(head + "a.png,1,ninety,45\n"), HasSubstr("azimuth_deg"));
  EXPECT_THAT(error_of(head + "a.png,nan,90,45\n"), HasSubstr("time_s"));
  EXPECT_THAT(error_of(head + ",1,90,45\n"), HasSubstr("image"));
  EXPECT_THAT(error_of("image,time_s,azimuth_deg\n"), HasSubstr("elevation_deg"));
  EXPECT_THAT(error_of("image,time_s,azimuth_deg,elevation_deg,latitude_deg,longitude_deg\na,1,2,3,4,5\nb,2,2,3,4,6\n"),
              HasSubstr("another station"));
}

TEST(TrackFile, OfAGrowingFileTheUnfinishedLineIsLeftOut) {
  const std::string text = "image,time_s,azimuth_deg,elevation_deg\na.png,1,90,45\nb.png,2,91,4";
  EXPECT_EQ(read(text, host::LastLine::kDropUnfinished).rows.size(), 1u);
  EXPECT_EQ(read(text).rows.size(), 2u);
}

TEST(ImagePath, IsBesideTheTrack) {
  EXPECT_EQ(image_path("/data/pass/track.csv", "0001.png"), "/data/pass/0001.png");
  EXPECT_EQ(image_path("-", "0001.png"), "0001.png");
}

}  // namespace
}  // namespace pharos::pointing
