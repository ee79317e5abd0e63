// SPDX-License-Identifier: Apache-2.0
// The smallest source that is not part of pharosd: an example for "How to add a source" in host/daemon/README.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <limits>

#include "host/daemon/daemon.hpp"
#include "host/publish/finite.hpp"
#include "host/publish/messages.hpp"
#include "host/publish/publish_gate.hpp"
#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

// The source's own room: report, source class and the function that opens sources.
namespace pharos::host::beacon {

using BeaconPose = PoseEstimate<frame::Camera, frame::Target>;

struct BeaconReport : MeasurementHeader {
  BeaconPose pose;
};
const char* channel_of(const BeaconReport&) { return "BEACON_POSE"; }
bool is_finite(const BeaconReport& report) { return host::is_finite(report.pose); }
pose_t message_of(const BeaconReport& report) {
  pose_t message = pose_message_of(report);
  if (report.answered()) message.position_m[2] = report.pose.pose.t.z();
  return message;
}

/// Publishes five reports: valid, not a number, stale, refused, and valid again.
class BeaconSource final : public Source {
 public:
  explicit BeaconSource(const SourceContext& context)
      : context_(context),
        gate_(context.publisher, not_finite_, PublishGate::AgeLimit{context.config.publish.max_age_ns(), stale_}) {}

  const std::string& name() const override { return name_; }
  void attend() override {
    if (finished_) return;
    tell(1.0);
    tell(std::numeric_limits<double>::quiet_NaN());
    tell(2.0, context_.config.publish.max_age_ns() + 1);
    tell(3.0, 0, "out_of_sight");
    tell(4.0);
    finished_ = true;
    context_.on_finished();
  }
  std::vector<SourceHealth> health() override {
    SourceHealth health;
    health.source = "beacon/" + name_;
    health.target = "client";
    health.state = SourceState::kOk;
    health.counters = {{"beacons_stale", stale_}, {"beacons_not_finite", not_finite_}};
    return {health};
  }
  bool finished() const override { return finished_; }

 private:
  void tell(double range_m, std::int64_t age_ns = 0, const std::string& refusal = "") {
    BeaconReport report;
    report.utc_ns = context_.clock.utc_ns();
    report.age_ns = age_ns;
    report.source = "beacon/" + name_;
    report.target = "client";
    report.frames = frames_of(report.pose);
    report.refusal = refusal;
    report.pose.pose.t = Vector3(0.0, 0.0, range_m);
    gate_.publish(report);
  }

  const SourceContext& context_;
  std::string name_ = "mast";
  std::int64_t stale_ = 0;
  std::int64_t not_finite_ = 0;
  PublishGate gate_;
  bool finished_ = false;
};

std::size_t open_beacons(const SourceContext& context, SourceList& sources) {
  sources.push_back(std::make_unique<BeaconSource>(context));
  return 1;
}

}  // namespace pharos::host::beacon

namespace pharos::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::int64_t value_of(const std::vector<counter_t>& counters, const std::string& name) {
  for (const counter_t& counter : counters) {
    if (counter.name == name) return counter.value;
  }
  return -1;
}

class AddedSource : public ::testing::Test {
 protected:
  // The daemon needs only the registration. It ends when the source has finished, as with any recording.
  void run() {
    SourceKinds kinds = source_kinds();
    kinds.push_back({"beacon", beacon::open_beacons});
    Signals signals{SIGUSR2};
    Daemon(DaemonConfig{}, sink, signals, ReplaySpeed::kReal, clock, kinds).run();
    const auto told = sink.all<status_t>("PHAROS_STATUS");
    ASSERT_FALSE(told.empty());
    status = told.back();
  }

  MessageList sink;
  test::ManualClock clock;
  status_t status{};
};

TEST_F(AddedSource, SendsWhatIsFiniteAndFreshAndNothingElse) {
  run();
  const auto poses = sink.all<pose_t>("PHAROS_BEACON_POSE");
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].position_m[2], 1.0);
  EXPECT_EQ(poses[0].parent_frame, "camera");
  EXPECT_EQ(poses[1].status, "refused_out_of_sight");
  EXPECT_EQ(poses[2].position_m[2], 4.0);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].sequence, static_cast<std::int64_t>(i));
}

TEST_F(AddedSource, StandsInTheStatusWithItsHealthAndCounters) {
  run();
  EXPECT_EQ(status.message, "stopped");
  ASSERT_EQ(status.source_count, 1);
  EXPECT_EQ(status.sources[0].source, "beacon/mast");
  EXPECT_EQ(status.sources[0].state, "ok");
  EXPECT_EQ(value_of(status.sources[0].counters, "beacons_not_finite"), 1);
  EXPECT_EQ(value_of(status.sources[0].counters, "beacons_stale"), 1);
  EXPECT_EQ(value_of(status.counters, "published_poses"), 3);
  EXPECT_EQ(value_of(status.counters, "calibrations.kept"), 0);
}

TEST_F(AddedSource, IsCountedInTheLogBesideTheOthers) {
  const test::CapturedLog log;
  run();
  EXPECT_THAT(log.lines("started"), ElementsAre(HasSubstr("started, 0 targets, 1 beacon")));
}

}  // namespace
}  // namespace pharos::host
