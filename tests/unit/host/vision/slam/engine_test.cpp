// SPDX-License-Identifier: Apache-2.0
// Failures in one of the system's own threads.
#include "host/vision/slam/engine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <latch>
#include <new>

#include "host/support/input_error.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::slam {
namespace {

TEST(KeyframeWorker, WorksInOrder) {
  std::vector<KeyframeId> seen;
  KeyframeWorker worker("test", [&seen](KeyframeId id) { seen.push_back(id); });
  for (KeyframeId id = 0; id < 20; ++id) worker.push(id);
  worker.wait_until_idle();
  EXPECT_TRUE(worker.idle());
  EXPECT_NO_THROW(worker.check());
  ASSERT_EQ(seen.size(), 20U);
  for (KeyframeId id = 0; id < 20; ++id) EXPECT_EQ(seen[static_cast<std::size_t>(id)], id);
}

TEST(KeyframeWorker, LeavesThoseThatWaitWhereItEnds) {
  std::latch begun(1), go_on(1);
  std::atomic<int> worked = 0;
  std::thread late;
  {
    KeyframeWorker worker("test", [&](KeyframeId) {
      ++worked;
      begun.count_down();
      go_on.wait();
    });
    worker.push(0);
    worker.push(1);
    begun.wait();
    EXPECT_FALSE(worker.idle());
    EXPECT_EQ(worker.waiting(), 1U);
    late = std::thread([&go_on] { go_on.count_down(); });
  }
  late.join();
  EXPECT_GE(worked, 1);
}

// No caller waits for ever, and every call of check() throws.
TEST(KeyframeWorker, ReportsWhatItsWorkThrew) {
  KeyframeWorker worker("mapping", [](KeyframeId id) {
    if (id == 1) throw std::runtime_error("no memory");
  });
  for (KeyframeId id = 0; id < 5; ++id) worker.push(id);
  worker.wait_until_idle();
  for (int k = 0; k < 2; ++k) {
    try {
      worker.check();
      ADD_FAILURE() << "nothing said";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "mapping: no memory");
    }
  }
  worker.push(5);
  worker.wait_until_idle();
  EXPECT_TRUE(worker.idle());
}

TEST(RunFigures, CountAllAndTakeMediansOfTheLast) {
  RunFigures figures;
  TrackedFrame frame;
  StereoFrontend::Result seen;
  for (int k = 0; k < 20'000; ++k) {
    frame.features = k < 15'000 ? 100 : 200;
    frame.lost = k % 2 == 0;
    figures.add_frame(frame, seen, k < 15'000 ? 1.0 : 3.0);
  }
  figures.add_loop(5.0);
  figures.add_loop(4.0);
  const SlamReport report = figures.report();
  EXPECT_EQ(report.frames, 20'000);
  EXPECT_EQ(report.lost, 10'000);
  EXPECT_EQ(report.loops, 2);
  EXPECT_EQ(report.features_median, 200.0);
  EXPECT_EQ(report.tracking_median_ms, 3.0);
  EXPECT_EQ(report.inliers_median, 0.0) << "none had a pose";
  EXPECT_EQ(report.loop_max_ms, 5.0);
}

class EngineWithAFault : public ::testing::Test {
 protected:
  EngineWithAFault() : sequence_({.turn_deg = 2.0, .width_px = 480, .height_px = 360, .povray = false}, 3) {
    for (std::size_t side = 0; side < 2; ++side) {
      for (const std::uint16_t value : sequence_.image(0, static_cast<int>(side)).pixels) {
        pair_[side].push_back(static_cast<std::uint8_t>(value >> 8U));
      }
    }
  }
  Engine engine(bool threads, Engine::KeyframeCallback on_keyframe) const {
    SlamSettings settings;
    settings.threads = threads;
    return {rectify(sequence_.rig(), "rig.toml"), Vocabulary::read(shipped_vocabulary_path()), settings,
            std::move(on_keyframe)};
  }
  void push(Engine& engine) { engine.push(0.0, {pair_[0].data(), 480, 360}, {pair_[1].data(), 480, 360}); }
  // The first pair is a keyframe, whose mapping in its thread has failed by finish() at the latest.
  void push_and_finish(Engine& engine) {
    push(engine);
    engine.finish();
  }

  sim::TumblingSequence sequence_;
  std::array<std::vector<std::uint8_t>, 2> pair_;
};

TEST_F(EngineWithAFault, HandsItToTheCaller) {
  Engine engine = this->engine(true, [](KeyframeId) { throw std::bad_alloc(); });
  EXPECT_THROW(push_and_finish(engine), std::runtime_error);
  EXPECT_THROW(push(engine), std::runtime_error);
  EXPECT_THROW(engine.finish(), std::runtime_error);
  EXPECT_THROW(static_cast<void>(engine.optimised_trajectory()), std::runtime_error);
  EXPECT_EQ(engine.report().frames, 1);
}

// Not an error of the pair: the daemon must not count it as a bad pair.
TEST_F(EngineWithAFault, IsNoInputErrorOfThePairThatReportsIt) {
  Engine engine = this->engine(true, [](KeyframeId) { throw host::InputError("a file that cannot be read"); });
  try {
    push_and_finish(engine);
    FAIL() << "nothing said";
  } catch (const host::InputError& error) {
    FAIL() << error.what();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "mapping a keyframe: a file that cannot be read");
  }
}

TEST_F(EngineWithAFault, ThrowsItAtOnceWithoutThreads) {
  Engine engine = this->engine(false, [](KeyframeId) { throw std::bad_alloc(); });
  EXPECT_THROW(push(engine), std::bad_alloc);
}

}  // namespace
}  // namespace pharos::slam
