// SPDX-License-Identifier: Apache-2.0
#include "tools/watch/watch_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/status_t.hpp"

namespace pharos::tools {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::size_t kWide = 400;

pose_t pose_of(const std::string& target, std::int64_t sequence, bool valid = true) {
  pose_t pose{};
  pose.source = "lighthouse/chaser";
  pose.target = target;
  pose.station_or_camera = "C33B4DE1";
  pose.sequence = sequence;
  pose.status = valid ? "ok" : "refused_poor_fit";
  pose.valid = valid ? 1 : 0;
  pose.position_m[0] = 0.5;
  pose.position_m[1] = -0.25;
  pose.position_m[2] = 2.0;
  pose.orientation_wxyz[0] = 1.0;
  pose.sigma_pos_m = 0.001;
  return pose;
}

// 4 ms after its measurement.
void add(SourceTable& table, const pose_t& pose, std::int64_t now_ns) {
  table.add("PHAROS_LIGHTHOUSE_POSE", pose, 4'000'000, now_ns);
}

TEST(WatchTable, ARowTellsRateAgePoseAndWhatWasRefusedOrLost) {
  SourceTable table;
  for (std::int64_t k = 0; k < 60; ++k) add(table, pose_of("dock", k < 30 ? k : k + 2), kSecond_ns + k * 10'000'000);
  add(table, pose_of("dock", 62, false), kSecond_ns + 600'000'000);
  table.tick(0, kSecond_ns + 600'000'000);
  const auto lines = watch_lines(table, kSecond_ns + 600'000'000, kWide);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("lighthouse/chaser"), HasSubstr("dock"), HasSubstr("C33B4DE1"),
                                    HasSubstr("refused_poor_f"), HasSubstr("   60    14 ms      1     2"),
                                    HasSubstr("500.00   -250.00   2000.00 mm"), HasSubstr("1.00 mm"))));
}

TEST(WatchTable, PicturesAreCountedAndACameraWithoutIsNamed) {
  SourceTable table;
  for (const char* source : {"tof/helios", "line/dome"}) {
    preview_t preview{};
    preview.source = source;
    preview.width_px = preview.height_px = 8;
    preview.format = "jpeg";
    preview.data = {0xFF, 0xD8, 0xFF, 0xD9};
    for (std::int64_t k = 0; k < 3; ++k) {
      preview.sequence = k;
      table.add("PHAROS_PREVIEW", preview, 0, source[0] == 't' ? 5 * kSecond_ns : kSecond_ns);
      preview.data = {0xFF, 0xD8, 0xFF, 0xD9};
    }
  }
  EXPECT_THAT(watch_lines(table, 5 * kSecond_ns, kWide),
              Contains("pictures: 6 of 2 cameras, 0 lost; none from line/dome for 4.0 s"));
}

TEST(WatchTable, APoseThatStoppedIsLostAndItsValueIsGone) {
  SourceTable table;
  for (std::int64_t k = 0; k < 5; ++k) add(table, pose_of("dock", k), kSecond_ns + k * 8'000'000);
  const std::int64_t later_ns = 4 * kSecond_ns;
  table.tick(later_ns, later_ns);
  const auto lines = watch_lines(table, later_ns, kWide);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("LOST"), HasSubstr("dock"), HasSubstr("    0"))));
  EXPECT_THAT(lines, Contains(HasSubstr("LOST  no pose for")));
  EXPECT_THAT(lines, Each(Not(HasSubstr("2000.00"))));
  add(table, pose_of("dock", 5), later_ns + 1);
  EXPECT_THAT(watch_lines(table, later_ns + 2, kWide), Contains(HasSubstr("FOUND")));
}

TEST(WatchTable, AMessageCannotSteerTheTerminal) {
  SourceTable table;
  pose_t pose = pose_of("\x1b[2J\x9b", 0);
  pose.flags = "prior\r\n\x1b]0;title\x07";
  add(table, pose, kSecond_ns);
  for (const std::string& line : watch_lines(table, kSecond_ns, kWide)) {
    for (const char c : line) EXPECT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
  }
}

TEST(WatchTable, MoreSourcesThanFitAreCounted) {
  SourceTable table;
  for (int k = 0; k < 1000; ++k) add(table, pose_of("t" + std::to_string(k), 0), kSecond_ns);
  const auto lines = watch_lines(table, kSecond_ns, kWide);
  EXPECT_LT(lines.size(), 150u);
  EXPECT_THAT(lines, Contains(HasSubstr("872 of more sources than fit")));
}

TEST(WatchTable, ADaemonTellsWhatIsWrongAndIsSilentAfterThreeSeconds) {
  SourceTable table;
  status_t status{};
  status.host = "chaser";
  status.state = "ok";
  table.add(status, kSecond_ns);
  source_status_t source{};
  source.source = "lighthouse/chaser";
  source.target = "dock";
  source.state = "error";
  source.message = "no frames: check the cable";
  status.state = "error";
  status.sources = {source};
  status.source_count = 1;
  table.add(status, 2 * kSecond_ns);
  auto lines = watch_lines(table, 2 * kSecond_ns, kWide);
  EXPECT_THAT(lines, Contains(HasSubstr("pharosd on chaser: error")));
  EXPECT_THAT(lines, Contains(HasSubstr("lighthouse/chaser dock: error: no frames: check the cable")));
  EXPECT_THAT(lines, Contains(HasSubstr("chaser is error")));
  lines = watch_lines(table, 6 * kSecond_ns, kWide);
  EXPECT_THAT(lines, Contains(HasSubstr("SILENT for 4.0 s")));
}

TEST(WatchTable, ADaemonTellsWhichCamerasFollowPtp) {
  SourceTable table;
  status_t status{};
  status.host = "chaser";
  status.state = "ok";
  const auto add_source = [&](const char* name, const std::vector<std::pair<const char*, int>>& counters) {
    source_status_t& source = status.sources.emplace_back();
    source.source = name;
    source.target = "dock";
    source.state = "ok";
    for (const auto& [counter, value] : counters) source.counters.push_back({counter, value});
    source.counter_count = static_cast<int>(source.counters.size());
    ++status.source_count;
  };
  add_source("tof/helios", {{"clock.ptp_state", 9}});
  add_source("ring2/rig", {{"left.clock.ptp_state", 9}, {"right.clock.ptp_state", 4}});
  add_source("tof/own", {{"clock.ptp_state", 0}});
  add_source("tof/other", {{"clock.ptp_state", 99}});
  table.add(status, kSecond_ns);
  const auto lines = watch_lines(table, kSecond_ns, kWide);
  EXPECT_THAT(lines, Contains("  tof/helios dock: PTP slave"));
  EXPECT_THAT(lines, Contains("  ring2/rig dock: left PTP slave, right PTP listening"));
  EXPECT_THAT(lines, Each(Not(HasSubstr("tof/o"))));
}

TEST(WatchTable, APointingIsARowToo) {
  SourceTable table;
  pointing_t pointing{};
  pointing.source = "line/telescope";
  pointing.target = "panel";
  pointing.status = "ok";
  pointing.valid = 1;
  pointing.pitch_rad = 0.5;
  pointing.sigma_axis_rad = 0.001;
  table.add("PHAROS_LINE_POINTING", pointing, kSecond_ns, kSecond_ns);
  EXPECT_THAT(watch_lines(table, kSecond_ns, kWide),
              Contains(AllOf(HasSubstr("axis pitch 28.6479"), HasSubstr("0.0573 deg"))));
}

TEST(WatchTable, LinesFitTheTerminal) {
  SourceTable table;
  add(table, pose_of("dock", 0), kSecond_ns);
  EXPECT_THAT(watch_lines(table, kSecond_ns, 80), Each(SizeIs(::testing::Le(80u))));
}

}  // namespace
}  // namespace pharos::tools
