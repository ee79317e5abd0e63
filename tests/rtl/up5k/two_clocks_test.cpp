// SPDX-License-Identifier: Apache-2.0
// The capture block on two clocks of any relation: every edge stamped by its own clock, in order, or counted as lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "firmware/rtl/capture_registers.h"
#include "rtl/up5k/two_clock_device.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kInputs = 4;

struct Record {
  std::uint32_t stamp = 0;
  std::uint32_t changed = 0;
  std::uint32_t levels = 0;
  bool gap = false;
};

/// The block between two clocks and a reader on its bus. Times in ns.
class Bench {
 public:
  Bench(std::uint64_t seed, double core_period_ns) : random_(seed), core_period_ns_(core_period_ns) {
    next_core_ns_ = core_period_ns * static_cast<double>(random_() % 1000) / 1000;
    for (int i = 0; i < 16; ++i) advance({}, true);
    idle(4);  // the reset ends a little later at the other clock
    write(PHAROS_CAPTURE_CONTROL_OFFSET, PHAROS_CAPTURE_CONTROL_ENABLE);
  }

  TwoClockDevice& device() { return *device_; }
  /// Probability that pins change in a tick of the capture clock.
  void set_activity(double probability) { activity_ = probability; }

  void write(std::uint8_t offset, std::uint32_t value) { advance({BusRequest::Kind::kWrite, offset, value}, false); }
  std::uint32_t read(std::uint8_t offset) {
    const BusRequest request{BusRequest::Kind::kRead, offset, 0};
    waited_ = 0;
    while (!advance(request, false)) ++waited_;
    return device_->read_data();
  }
  void idle(int core_ticks) {
    for (int i = 0; i < core_ticks; ++i) advance({}, false);
  }
  std::uint64_t read_time() {
    const std::uint64_t low = read(PHAROS_CAPTURE_TIME_LOW_OFFSET);
    worst_wait_ = std::max(worst_wait_, waited_);
    return std::uint64_t{read(PHAROS_CAPTURE_TIME_HIGH_OFFSET)} << 32 | low;
  }
  /// The oldest record; false when there is none.
  bool read_record(Record& record) {
    const std::uint32_t status = read(PHAROS_CAPTURE_STATUS_OFFSET);
    if ((status & PHAROS_CAPTURE_STATUS_COUNT_MASK) == 0) return false;
    record.gap = (status & PHAROS_CAPTURE_STATUS_GAP) != 0;
    record.stamp = read(PHAROS_CAPTURE_FIFO_TIME_OFFSET);
    record.changed = read(PHAROS_CAPTURE_FIFO_CHANGED_OFFSET);
    record.levels = read(PHAROS_CAPTURE_FIFO_LEVELS_OFFSET);
    return true;
  }
  /// What the block had to stamp, oldest first; the caller takes them off.
  std::deque<Record>& expected() { return expected_; }
  int worst_wait() const { return worst_wait_; }
  std::uint64_t edges() const { return edges_; }

 private:
  // Until the next edge of the core's clock, with this request before it. Whether it was taken.
  bool advance(const BusRequest& request, bool reset) {
    while (next_capture_ns_ < next_core_ns_) {
      next_capture_ns_ += 1e9 / 48e6;
      rise_capture(reset);
    }
    next_core_ns_ += core_period_ns_;
    const bool taken = request.kind == BusRequest::Kind::kNone || !device_->waits(request);
    device_->rise_clock(request, reset);
    return taken;
  }
  // What was sampled two edges ago has changed now, and the counter is its stamp.
  void rise_capture(bool reset) {
    const std::uint32_t before = pins_;
    if (!reset && std::uniform_real_distribution<>()(random_) < activity_) {
      pins_ ^= static_cast<std::uint32_t>(1 + random_() % ((1U << kInputs) - 1));
    }
    device_->rise_capture_clock(pins_);
    pipeline_.push_back({0, before ^ pins_, pins_, false});
    if (pipeline_.size() < 3) return;
    Record record = pipeline_.front();
    pipeline_.pop_front();
    if (record.changed == 0) return;
    record.stamp = static_cast<std::uint32_t>(device_->ticks());
    edges_ += static_cast<std::uint64_t>(std::popcount(record.changed));
    expected_.push_back(record);
  }

  std::unique_ptr<TwoClockDevice> device_ = make_two_clock_device();
  std::mt19937_64 random_;
  double core_period_ns_;
  double next_core_ns_ = 0.0;
  double next_capture_ns_ = 0.0;
  double activity_ = 0.0;
  std::uint32_t pins_ = 0;
  std::deque<Record> pipeline_;
  std::deque<Record> expected_;
  std::uint64_t edges_ = 0;
  int waited_ = 0;
  int worst_wait_ = 0;
};

constexpr double kCorePeriods_ns[] = {62.5, 61.7, 20.9, 47.3, 100.3};

TEST(TwoClocks, CountTwentyNanoseconds) {
  Bench bench(1, 62.5);
  const std::uint64_t begin = bench.device().ticks();
  bench.idle(16'000);  // a millisecond
  EXPECT_NEAR(static_cast<double>(bench.device().ticks() - begin), 50'000.0, 2.0);
}

TEST(TwoClocks, EveryEdgeComesOnceInOrderWithItsStamp) {
  for (const double period_ns : kCorePeriods_ns) {
    SCOPED_TRACE(period_ns);
    Bench bench(2, period_ns);
    bench.set_activity(0.01);  // a record in 2 us; a pass of the reader takes less
    int records = 0;
    while (records < 3000) {
      Record record;
      if (!bench.read_record(record)) continue;
      ASSERT_FALSE(bench.expected().empty());
      EXPECT_EQ(record.gap, records == 0);  // capturing was off before
      ++records;
      const Record wanted = bench.expected().front();
      bench.expected().pop_front();
      ASSERT_EQ(record.stamp, wanted.stamp) << records;
      ASSERT_EQ(record.changed, wanted.changed);
      ASSERT_EQ(record.levels, wanted.levels);
    }
    EXPECT_EQ(bench.read(PHAROS_CAPTURE_LOST_OFFSET), 0u);
  }
}

// What hal::EdgeCapture promises: records stamped 8 ticks before a time that was read can be read after it.
TEST(TwoClocks, NoEdgeBeforeATimeComesAfterIt) {
  for (const double period_ns : kCorePeriods_ns) {
    SCOPED_TRACE(period_ns);
    Bench bench(3, period_ns);
    bench.set_activity(0.02);
    bench.device().set_ticks((std::uint64_t{5} << 32) - 30'000);  // wraps in between
    std::uint64_t last = 0;
    for (int pass = 0; pass < 3000; ++pass) {
      const std::uint64_t asked = bench.device().ticks();
      const std::uint64_t time = bench.read_time();
      ASSERT_GE(time, asked);
      ASSERT_LE(time, bench.device().ticks());
      ASSERT_GT(time, last);
      last = time;
      Record record;
      while (bench.read_record(record)) {
        ASSERT_FALSE(bench.expected().empty());
        ASSERT_EQ(record.stamp, bench.expected().front().stamp);
        bench.expected().pop_front();
      }
      if (bench.expected().empty()) continue;
      const auto ahead = static_cast<std::int32_t>(bench.expected().front().stamp - static_cast<std::uint32_t>(time));
      ASSERT_GT(ahead, -8) << "an edge before the time was not there";
    }
    EXPECT_LE(bench.worst_wait(), 30);
  }
}

// More edges than the crossing and the reader carry: what comes is right and in order, what is missing is counted and
// marked.
TEST(TwoClocks, LostEdgesAreCountedAndMarked) {
  for (const double period_ns : kCorePeriods_ns) {
    for (const double activity : {0.3, 0.9}) {
      SCOPED_TRACE(period_ns);
      SCOPED_TRACE(activity);
      Bench bench(4, period_ns);
      std::uint64_t read_edges = 0;
      int marked = 0;
      const auto take_all = [&] {
        Record record;
        while (bench.read_record(record)) {
          bool skipped = false;
          while (!bench.expected().empty() && bench.expected().front().stamp != record.stamp) {
            bench.expected().pop_front();
            skipped = true;
          }
          ASSERT_FALSE(bench.expected().empty()) << "a record that nothing caused";
          ASSERT_EQ(record.changed, bench.expected().front().changed);
          ASSERT_EQ(record.levels, bench.expected().front().levels);
          bench.expected().pop_front();
          ASSERT_TRUE(record.gap || !skipped) << "edges are missing before an unmarked record";
          marked += record.gap ? 1 : 0;
          read_edges += static_cast<std::uint64_t>(std::popcount(record.changed));
        }
      };
      for (int burst = 0; burst < 20; ++burst) {
        bench.set_activity(activity);
        bench.idle(3000);  // more than the FIFO holds, where the crossing carries all
        bench.set_activity(0.0);
        bench.idle(100);
        take_all();
        if (testing::Test::HasFatalFailure()) return;
      }
      bench.set_activity(0.001);
      bench.idle(2000);
      bench.set_activity(0.0);
      bench.idle(100);
      take_all();
      EXPECT_GT(marked, 1);
      EXPECT_EQ(read_edges + bench.read(PHAROS_CAPTURE_LOST_OFFSET), bench.edges());
      EXPECT_NE(bench.read(PHAROS_CAPTURE_STATUS_OFFSET) & PHAROS_CAPTURE_STATUS_OVERFLOW, 0u);
    }
  }
}

TEST(TwoClocks, InputsThatAreNotEnabledAreLeftOut) {
  Bench bench(5, 62.5);
  bench.write(PHAROS_CAPTURE_INPUT_ENABLE_OFFSET, 0b0101);
  bench.idle(10);
  bench.set_activity(0.01);
  int records = 0;
  while (records < 500) {
    Record record;
    if (!bench.read_record(record)) continue;
    ++records;
    while ((bench.expected().front().changed & 0b0101) == 0) bench.expected().pop_front();
    ASSERT_EQ(record.stamp, bench.expected().front().stamp);
    ASSERT_EQ(record.changed, bench.expected().front().changed & 0b0101);
    bench.expected().pop_front();
  }
}

TEST(TwoClocks, TellWhatTheyAreBuiltWith) {
  Bench bench(6, 62.5);
  EXPECT_EQ(bench.read(PHAROS_CAPTURE_ID_OFFSET), static_cast<std::uint32_t>(PHAROS_CAPTURE_ID));
  EXPECT_EQ(bench.read(PHAROS_CAPTURE_BUILD_OFFSET), 0x01000904u);  // version 1, no filter, 512 records, 4 inputs
  bench.write(PHAROS_CAPTURE_FILTER_OFFSET, 3);
  EXPECT_EQ(bench.read(PHAROS_CAPTURE_FILTER_OFFSET), 0u);
}

}  // namespace
}  // namespace pharos::rtl
