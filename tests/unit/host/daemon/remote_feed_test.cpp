// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>

#include "pharos/clock_exchange_t.hpp"
#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/remote_fixture.hpp"

namespace pharos::host {
namespace {

using test::kMs;
using test::NetworkedDaemon;
using test::SimulatedNetwork;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Lt;
using ::testing::SizeIs;

/// A daemon that takes another one's depth camera, and that other one's messages as a test writes them.
class Remotes : public ::testing::Test {
 protected:
  Remotes() {
    chaser.config.remotes = {test::two_remotes()[0]};
    chaser.publisher.set_pose_listener([this](const char*, const pose_t& pose) { taken.push_back(pose); });
    cameras.config.lcm.answer_clock = true;
    cameras.remote.emplace(cameras.context);
    chaser.ask_from(network, 10 * kMs);
  }
  void open() { chaser.remote.emplace(chaser.context); }

  pose_t pose(std::int64_t number) const {
    pose_t message{};
    message.utime = cameras.computer.clock.utc_ns() / 1000 - 40'000;
    message.utime_sigma_us = 30;
    message.sequence = number;
    message.source = "tof/helios";
    message.target = "client";
    message.parent_frame = "camera";
    message.child_frame = "target";
    message.status = "ok";
    message.valid = 1;
    message.orientation_wxyz[0] = 1.0;
    message.position_m[2] = 2.0;
    for (int i = 0; i < 6; ++i) message.covariance[7 * i] = 1e-6;
    return message;
  }
  static std::vector<std::uint8_t> bytes_of(const pose_t& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }
  void send(const pose_t& message) { network.send("PHAROS_TOF_POSE", bytes_of(message)); }
  void run_ms(std::int64_t ms) {
    network.run_until(network.now_ns + ms * kMs);
    if (chaser.remote) chaser.remote->attend();
  }
  // Ten poses a second, with `change` made to each.
  template <class Change>
  void poses(int count, const Change& change) {
    for (int k = 0; k < count; ++k) {
      pose_t message = pose(sequence++);
      change(message);
      send(message);
      run_ms(100);
    }
  }
  void poses(int count) {
    poses(count, [](pose_t&) {});
  }
  SourceHealth health() { return chaser.remote->health().at(0); }
  std::int64_t counter(const std::string& name) {
    for (const NamedCount& count : health().counters) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  SimulatedNetwork network;
  NetworkedDaemon chaser{network, "chaser", 0.0, 0.0};
  NetworkedDaemon cameras{network, "cameras", 5e-3, 20e-6};
  std::vector<pose_t> taken;
  std::int64_t sequence = 0;
};

TEST_F(Remotes, APoseComesOnThisComputersClock) {
  open();
  EXPECT_EQ(health().state, SourceState::kWaiting);
  EXPECT_THAT(health().message, HasSubstr("does that daemon run"));
  run_ms(2000);
  poses(20);
  ASSERT_THAT(taken, SizeIs(20));
  EXPECT_EQ(taken.back().source, "remote/depth");
  const std::int64_t true_us = SimulatedNetwork::DriftingClock::kEpoch_ns / 1000 + (network.now_ns - 140 * kMs) / 1000;
  EXPECT_NEAR(static_cast<double>(taken.back().utime - true_us), 0.0, 150.0) << "and not 5 ms ahead";
  EXPECT_GT(taken.back().utime_sigma_us, 50) << "with what the round trips leave";
  EXPECT_LT(taken.back().utime_sigma_us, 1000);
  EXPECT_EQ(health().state, SourceState::kOk);
  EXPECT_EQ(health().source, "remote/depth");
  EXPECT_EQ(health().identity, "tof/helios of cameras");
  EXPECT_NEAR(health().clock_drift_ppm, 20.0, 40.0);
  EXPECT_EQ(counter("poses_taken"), 20);
}

TEST_F(Remotes, NothingIsUsedWhileTheClockIsNotKnown) {
  cameras.config.lcm.answer_clock = false;
  open();
  poses(30);
  EXPECT_THAT(taken, SizeIs(0));
  EXPECT_EQ(counter("poses_no_clock"), 30);
  EXPECT_EQ(health().state, SourceState::kError);
  EXPECT_THAT(health().message, HasSubstr("lcm.answer_clock = true"));
  EXPECT_GT(cameras.remote->daemon_counters().at(1).value, 10) << "questions that are not answered are counted";
  cameras.config.lcm.answer_clock = true;
  poses(20);
  EXPECT_FALSE(taken.empty());
}

TEST_F(Remotes, ClocksHeldTogetherElsewhereNeedNoAnswers) {
  chaser.config.remotes[0].daemon.clear();
  chaser.config.remotes[0].clock_sigma_s = 1e-2;
  open();
  poses(5);
  ASSERT_THAT(taken, SizeIs(5));
  EXPECT_EQ(taken.back().utime_sigma_us, 10'000);
  EXPECT_EQ(counter("clock.asked"), -1);
}

TEST_F(Remotes, SilenceIsToldOnceAndItsEnd) {
  const test::CapturedLog log;
  open();
  run_ms(1000);
  poses(10);
  for (int k = 0; k < 30; ++k) run_ms(100);
  EXPECT_EQ(health().state, SourceState::kStale);
  EXPECT_THAT(log.lines("remote/depth: stale: silent"), SizeIs(1));
  poses(5);
  EXPECT_EQ(health().state, SourceState::kOk);
  EXPECT_THAT(log.lines("remote/depth: ok"), SizeIs(2));
}

TEST_F(Remotes, LatePosesAreNotUsed) {
  open();
  run_ms(2000);
  poses(10, [](pose_t& message) { message.utime -= 600'000; });
  EXPECT_EQ(counter("poses_late"), 10);
  EXPECT_THAT(health().message, HasSubstr("older than 0.5 s"));
  poses(10, [](pose_t& message) { message.utime += 600'000; });
  EXPECT_EQ(counter("poses_ahead"), 10);
  EXPECT_THAT(health().message, HasSubstr("from the future"));
  EXPECT_THAT(taken, SizeIs(0));
}

TEST_F(Remotes, ARestartIsTakenAfterItsProof) {
  open();
  run_ms(2000);
  sequence = 5000;
  poses(10);
  sequence = 0;
  poses(10);
  EXPECT_EQ(counter("restarts"), 1);
  EXPECT_EQ(counter("poses_unproven"), MessageSeries::kProof - 1);
  EXPECT_EQ(counter("poses_taken"), 20 - (MessageSeries::kProof - 1));
  EXPECT_EQ(health().state, SourceState::kOk);
}

TEST_F(Remotes, TwoPublishersUnderOneNameAreNotBelieved) {
  for (const std::int64_t ahead : {0, 2, 4000}) {
    taken.clear();
    chaser.computer.handlers.clear();
    chaser.remote.reset();
    open();
    sequence = 100;
    run_ms(2000);
    poses(10);
    ASSERT_THAT(taken, SizeIs(10));
    for (int k = 0; k < 30; ++k) {
      pose_t other = pose(sequence + ahead);
      other.utime -= 20'000;
      other.position_m[0] = 1.0;
      send(other);
      run_ms(50);
      poses(1);
    }
    EXPECT_EQ(health().state, SourceState::kError) << ahead;
    EXPECT_THAT(health().message, HasSubstr("two programs"));
    EXPECT_LE(taken.size(), 10U + 8U) << "until both have gone on; " << ahead << " ahead";
    EXPECT_GT(counter("poses_doubled"), 40);
    taken.clear();
    poses(60);  // 6 s of one alone
    EXPECT_GE(taken.size(), 5U) << ahead;
    EXPECT_EQ(health().state, SourceState::kOk) << health().message;
  }
}

TEST_F(Remotes, TwoDaemonsUnderOneNameAreNotBelieved) {
  open();
  run_ms(2000);
  poses(10);
  NetworkedDaemon twin(network, "cameras", 1.0, 0.0);
  twin.config.lcm.answer_clock = true;
  twin.remote.emplace(twin.context);
  poses(20);
  EXPECT_EQ(health().state, SourceState::kError);
  EXPECT_THAT(health().message, HasSubstr("two programs"));
  EXPECT_GT(counter("poses_doubled"), 10);
  twin.computer.handlers.clear();
  poses(80);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
}

TEST_F(Remotes, ADaemonThatStartsAnewIsAskedAnew) {
  open();
  run_ms(2000);
  poses(5);
  cameras.computer.handlers.clear();
  cameras.remote.reset();
  cameras.computer.clock.step(0.2);
  cameras.remote.emplace(cameras.context);
  sequence = 0;
  poses(20);
  EXPECT_EQ(counter("clock.restarts"), 1);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
  const std::int64_t true_us = SimulatedNetwork::DriftingClock::kEpoch_ns / 1000 + (network.now_ns - 140 * kMs) / 1000;
  EXPECT_NEAR(static_cast<double>(taken.back().utime - true_us), 0.0, 500.0);
}

TEST_F(Remotes, MessagesThatTheNetworkDoublesAreTakenOnce) {
  open();
  run_ms(2000);
  for (int k = 0; k < 20; ++k) {
    const pose_t message = pose(sequence++);
    send(message);
    send(message);
    run_ms(100);
  }
  EXPECT_THAT(taken, SizeIs(20));
  EXPECT_EQ(counter("poses_repeated"), 20);
  EXPECT_EQ(health().state, SourceState::kOk);
}

TEST_F(Remotes, ForeignAndDamagedMessagesAreCountedAndNotUsed) {
  open();
  run_ms(2000);
  poses(1, [](pose_t& m) { m.source = "tof/other"; });
  poses(1, [](pose_t& m) { m.target = "debris"; });
  EXPECT_EQ(counter("poses_other"), 2);
  EXPECT_EQ(health().state, SourceState::kWaiting);
  EXPECT_THAT(health().message, HasSubstr("tof/helios of debris in camera, target came"));
  poses(1, [](pose_t& m) { m.parent_frame = "rig"; });
  EXPECT_EQ(counter("poses_foreign"), 1);
  EXPECT_THAT(health().message, HasSubstr("in rig, target came, expected are camera, target"));
  poses(1, [](pose_t& m) { m.parent_frame = "\x1b[2J\n" + std::string(1000, 'x'); });
  EXPECT_THAT(health().message, AllOf(HasSubstr("in ?[2J?x"), SizeIs(Lt(300U))));
  poses(1, [](pose_t& m) { m.position_m[1] = std::numeric_limits<double>::quiet_NaN(); });
  poses(1, [](pose_t& m) { m.orientation_wxyz[0] = 0.0; });
  poses(1, [](pose_t& m) { m.has_second = 1; });
  poses(1, [](pose_t& m) { m.position_m[2] = 1e30; });
  poses(1, [](pose_t& m) { m.sigma_pos_m = -1.0; });
  EXPECT_EQ(counter("poses_not_finite"), 5);
  poses(1, [](pose_t& m) { m.covariance[0] = -1e-6; });
  poses(1, [](pose_t& m) { m.covariance[1] = m.covariance[6] = 2e-6; });
  poses(1, [](pose_t& m) { m.covariance[1] = 1e-7; });
  poses(1, [](pose_t& m) { m.covariance[35] = std::numeric_limits<double>::infinity(); });
  EXPECT_EQ(counter("poses_covariance"), 4);
  poses(1, [](pose_t& m) { m.flags = "no_connector|clock_set"; });
  EXPECT_EQ(counter("poses_doubtful"), 1);
  poses(1, [](pose_t& m) {
    m.valid = 0;
    m.status = "refused_no_ring";
  });
  EXPECT_EQ(counter("poses_without_answer"), 1);
  EXPECT_THAT(health().message, HasSubstr("refused_no_ring"));
  std::vector<std::uint8_t> lying = bytes_of(pose(sequence));
  for (std::size_t k = 32; k < 36; ++k) lying[k] = 0xFF;  // the length of `source`
  network.send("PHAROS_TOF_POSE", lying);
  network.send("PHAROS_TOF_POSE", {1, 2, 3});
  network.send("PHAROS_CLOCK", {1, 2, 3});
  run_ms(100);
  EXPECT_EQ(counter("messages_damaged"), 2);
  EXPECT_EQ(chaser.remote->daemon_counters().at(2).value, 1) << "clock_damaged";
  EXPECT_THAT(taken, SizeIs(0));
  poses(10);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
}

TEST_F(Remotes, ARateThatIsNotAsExpectedIsTold) {
  chaser.config.remotes[0].rate_hz = 30.0;
  open();
  run_ms(2000);
  poses(120);
  EXPECT_EQ(health().state, SourceState::kDegraded);
  EXPECT_THAT(health().message, HasSubstr("messages a second, expected 30"));
}

TEST_F(Remotes, AClockOfTheOtherComputerThatIsSetIsFollowed) {
  open();
  run_ms(2000);
  poses(10);
  cameras.computer.clock.step(-3.0);
  poses(10);
  EXPECT_GT(counter("poses_no_clock"), 0);
  poses(20);
  EXPECT_EQ(counter("clock.steps"), 1);
  const std::int64_t true_us = SimulatedNetwork::DriftingClock::kEpoch_ns / 1000 + (network.now_ns - 140 * kMs) / 1000;
  EXPECT_NEAR(static_cast<double>(taken.back().utime - true_us), 0.0, 500.0);
}

TEST_F(Remotes, QuestionsBeyondALimitAreNotAnswered) {
  NetworkedDaemon flood(network, "flood", 0.0, 0.0);
  clock_exchange_t question{};
  question.sender = "flood";
  question.recipient = "cameras";
  for (int k = 0; k < 1000; ++k) {
    question.sequence = k;
    flood.publisher.publish_clock("PHAROS_CLOCK", question);
  }
  run_ms(500);
  EXPECT_LE(cameras.remote->daemon_counters().at(0).value, RemoteFeed::kMaxAnswersPerSecond);
}

}  // namespace
}  // namespace pharos::host
