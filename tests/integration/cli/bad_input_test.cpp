// SPDX-License-Identifier: Apache-2.0
// Wrong input of a user: one line that says what, where and what to do, exit code 2, no rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/record/stream_format.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

void expect_refusal(const Outcome& run, const std::string& words) {
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(count_lines(run.err), 1u) << run.err;
  EXPECT_THAT(run.err, ::testing::MatchesRegex("pharos [a-z]+: .+\n"));
  EXPECT_THAT(run.err, HasSubstr(words));
}

TEST(CliBadInput, UnknownFiles) {
  expect_refusal(pharos("decode /nowhere/edges.csv"), "/nowhere/edges.csv: cannot be opened");
  expect_refusal(pharos("track /nowhere/edges.csv --target " + recording().target()), "/nowhere/edges.csv");
  expect_refusal(pharos("track " + recording().edges() + " --target /nowhere/t.csv"), "/nowhere/t.csv");
  expect_refusal(pharos("solve /nowhere/p.csv --target " + recording().target()), "/nowhere/p.csv");
  expect_refusal(pharos("precision --poses /nowhere/p.csv --target " + recording().target()), "/nowhere/p.csv");
  expect_refusal(pharos("decode " + recording().edges() + " --output /nowhere/out.csv"), "/nowhere/out.csv");
}

TEST(CliBadInput, WhatCannotBeWrittenAtTheEndIsSaidAtTheStart) {
  const std::string track = "track " + recording().edges() + " --target " + recording().target();
  expect_refusal(pharos(track + " --sensors /nowhere/sensors.csv"), "/nowhere/sensors.csv: cannot be written");
  const Folder folder;
  const std::string same = folder.path("same.csv");
  expect_refusal(pharos(track + " --sensors " + same + " --output " + same), "is the same file or folder as --output");
}

TEST(CliBadInput, OneStandardInputCannotBeTwoTables) {
  expect_refusal(pharos("track - --target -"), "EDGES and --target cannot both be standard input");
  expect_refusal(pharos("track - --calibration - --target " + recording().target()), "EDGES and --calibration");
  expect_refusal(pharos("solve - --target -"), "PROBLEMS and --target");
  expect_refusal(pharos("precision --target - --poses -"), "--target and --poses");
}

TEST(CliBadInput, AFailedRunLeavesTheOldOutputAndNothingBesideIt) {
  const Folder folder;
  const std::string out = folder.write("out.csv", "old");
  const std::string broken = folder.write("a.csv", "sensor,rise_ticks,fall_ticks\n1,2,3\n1,2,x\n");
  EXPECT_EQ(pharos("decode " + broken + " --output " + out).exit_code, 2);
  EXPECT_EQ(content_of(out), "old");
  EXPECT_FALSE(std::filesystem::exists(out + ".new"));
}

TEST(CliBadInput, WrongColumns) {
  const Folder folder;
  expect_refusal(pharos("decode " + folder.write("a.csv", "sensor,rise,fall\n1,2,3\n")), "a.csv: line 1: no column");
  expect_refusal(pharos("decode " + folder.write("b.csv", "sensor,rise_ticks,fall_ticks\n1,2,x\n1,2,3\n")),
                 "b.csv: line 2: column 'fall_ticks': 'x'");
  expect_refusal(pharos("solve " + folder.write("c.csv", "problem,sensor,x,y\n") + " --target " + recording().target()),
                 "no column 'theta_x_rad'");
  expect_refusal(pharos("solve " + folder.write("d.csv", "problem,sensor,theta_x_rad,theta_y_rad\n1,0,nan,1\n") +
                        " --target " + recording().target()),
                 "line 2: column 'theta_x_rad': 'nan'");
}

TEST(CliBadInput, EmptyFilesAndGarbage) {
  const Folder folder;
  expect_refusal(pharos("decode " + folder.write("empty.csv", "")), "empty.csv: empty");
  expect_refusal(pharos("decode -", ""), "standard input: empty");
  const std::string garbage(
      "\x7f"
      "ELF\x02\x01\x01\0\0\0\0\n\n\0",
      14);
  expect_refusal(pharos("decode " + folder.write("program", garbage)), "neither a table");
  expect_refusal(pharos("track " + folder.write("program", garbage) + " --target " + recording().target()),
                 "neither a table");
  expect_refusal(
      pharos("decode " + folder.write("later.csv", std::string("sensor,rise_ticks,fall_ticks\n\0\1\2\n", 33))),
      "line 2: binary data");
  std::string broken = content_of(recording().edges());
  for (std::size_t i = 200; i < 300; ++i) broken[i] = '\x55';
  EXPECT_THAT(pharos("decode " + folder.write("broken.csv.gz", broken)).err, HasSubstr("broken"));
}

TEST(CliBadInput, ARecordingWithoutLightHasNoAnswer) {
  const Outcome run = pharos("decode -", "sensor,rise_ticks,fall_ticks\n");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "time_s,station,station_id,axis,sensor,theta_rad,width_ticks,flags\n");
  EXPECT_THAT(run.err, HasSubstr("no bearing"));
}

TEST(CliBadInput, ARecordingThatEndsInTheMiddleOfALineIsUsedUpToThere) {
  const std::string whole = recording().edges_text();
  // Cut inside a number: the remainder is still a number.
  const Folder folder;
  const std::string cut = folder.write("cut.csv", whole.substr(0, whole.size() - 3));
  const Outcome run = pharos("decode " + cut + " --stats");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("cut.csv: ends in the middle of line"));
  EXPECT_THAT(run.err, ::testing::ContainsRegex("lines_unfinished +1 "));
  EXPECT_GT(count_lines(run.out), 1000u);

  const std::string packed = content_of(recording().edges());
  const std::string half = folder.write("cut.csv.gz", packed.substr(0, packed.size() / 2));
  const Outcome packed_run = pharos("decode " + half);
  EXPECT_EQ(packed_run.exit_code, 0);
  EXPECT_THAT(packed_run.err, HasSubstr("unfinished"));
}

TEST(CliBadInput, ImpossibleTargets) {
  const Folder folder;
  const auto track_with = [&](const std::string& target) {
    return pharos("track " + recording().edges() + " --target " + folder.write("target.csv", target));
  };
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n1,0,0,0\n2,0.1,0,0\n1,0,0.1,0\n3,0,0,0.1\n"),
                 "target.csv: line 4: sensor 1 stands already in line 2");
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n1,0,0,0\n2,0.1,0,0\n"), "fewer than three sensors");
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n1,0,0,0\n2,0.1,0,0\n3,0.2,0,0\n4,0.3,0,0\n"), "on one line");
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n1,0,0,0\n2,0.1,0,0\n3,0.1,0,0\n4,0,0.3,0\n"), "2 and 3");
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n99,0,0,0\n"), "0 to 31");
  expect_refusal(track_with("sensor,x_m,y_m,z_m\n0,25,25,62.5\n1,25,-25,62.5\n2,-25,25,62.5\n"),
                 "target.csv: line 2: column 'x_m': 25 m is more than 12 m");
}

TEST(CliBadInput, ACoplanarTargetIsAllowedWithANote) {
  const Folder folder;
  const Outcome run =
      pharos("track " + recording().edges() + " --target " + folder.write("plane.csv", plane_target_csv()));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("plane.csv: all sensors lie in one plane"));
}

TEST(CliBadInput, SensorsThatTheTargetHasNotAreLeftOut) {
  const Folder folder;
  std::string target = recording().target();
  std::string text = content_of(target);
  text.resize(text.find("\n7,") + 1);  // sensors 0 to 6 only
  const Outcome run = pharos("track " + recording().edges() + " --target " + folder.write("part.csv", text));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(rows_of(run.out).back().at("status"), "ok");
}

TEST(CliBadInput, AStreamOfNothingHasNoAnswer) {
  host::StreamHeader header;
  header.target = "demo";
  const auto head = host::stream_format::encode_head(header);
  const Folder folder;
  const std::string file = folder.write("stream.phraw", {reinterpret_cast<const char*>(head.data()), head.size()});
  EXPECT_EQ(pharos("decode " + file).exit_code, 1);
  // With a damaged head it is not readable.
  const std::string damaged =
      folder.write("damaged.phraw", {reinterpret_cast<const char*>(head.data()), head.size() / 2});
  expect_refusal(pharos("decode " + damaged), "damaged.phraw");
}

}  // namespace
}  // namespace pharos::cli_test
