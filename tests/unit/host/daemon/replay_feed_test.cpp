// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/replay_feed.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/host/daemon/manual_clock.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kUtc = 1'763'721'000'000'000'000;
constexpr std::int64_t kDay_ns = 86'400 * std::int64_t{1'000'000'000};

class ReplayFeedTest : public ::testing::Test {
 protected:
  // A recording with one byte at each of these monotonic times.
  std::string recording(const std::vector<std::int64_t>& times_ns) const {
    pharos::test::Bytes bytes = stream_format::encode_head({"dock", 460'800, kUtc, 0});
    const std::uint8_t byte = 0;
    for (const std::int64_t time_ns : times_ns) stream_format::append_chunk({kUtc, time_ns, 0, {&byte, 1}}, bytes);
    pharos::test::write_file(folder_.path() / "r.phraw", bytes);
    return (folder_.path() / "r.phraw").string();
  }
  ByteFeedEvents events() {
    return {
        [this](std::span<const std::uint8_t>, const Arrival& arrival) { arrivals_.push_back(arrival.monotonic_ns); },
        [] {}, [this] { finished_ = true; }};
  }
  static std::int64_t count(const ReplayFeed& feed, const std::string& name) {
    for (const NamedCount& count : feed.counters()) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  pharos::test::TemporaryFolder folder_;
  EventLoop loop_;
  test::ManualClock clock_;
  std::vector<std::int64_t> arrivals_;
  bool finished_ = false;
};

TEST_F(ReplayFeedTest, ASilenceOfDaysIsCutAtRealSpeed) {
  ReplayTimeline timeline(clock_, ReplaySpeed::kReal);
  ReplayFeed feed(loop_, timeline, "dock", {recording({0, 6 * kDay_ns})}, events());
  feed.attend(0);
  while (arrivals_.empty()) loop_.turn(1000);
  EXPECT_EQ(count(feed, "replay.silences_cut"), 1);
}

TEST_F(ReplayFeedTest, ImpossibleTimesAreCountedAndTheRestIsPlayed) {
  const std::string file = recording({0, 40'000 * kDay_ns, 10, 5, 20, std::numeric_limits<std::int64_t>::min(), 30});
  ReplayTimeline timeline(clock_, ReplaySpeed::kReal);
  ReplayFeed feed(loop_, timeline, "dock", {file}, events());
  clock_.step_at_readings(1000);
  feed.attend(0);
  while (!finished_) loop_.turn(1000);
  EXPECT_EQ(arrivals_, (std::vector<std::int64_t>{0, 10, 20, 30}));
  EXPECT_EQ(count(feed, "replay.chunks_bad_time"), 3);
  EXPECT_EQ(count(feed, "replay.silences_cut"), 0);
}

TEST_F(ReplayFeedTest, AtFullSpeedNothingIsWaitedFor) {
  ReplayTimeline timeline(clock_, ReplaySpeed::kFastest);
  ReplayFeed feed(loop_, timeline, "dock", {recording({0, 6 * kDay_ns, 9 * kDay_ns})}, events());
  feed.attend(0);
  while (!finished_) loop_.turn(1000);
  EXPECT_EQ(arrivals_.size(), 3u);
}

}  // namespace
}  // namespace pharos::host
