// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "campaigns/attack/campaign_table.hpp"
#include "host/runtime/now.hpp"
#include "integration/pharosd_fixture.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {

/// pharosd with one lighthouse target that is attacked: counts the sweeps sent and what came of them.
class AttackedLighthouse : public PharosdTest {
 protected:
  /// Plays until poses come steadily; losses are counted from here on.
  ::testing::AssertionResult measures() {
    const ::testing::AssertionResult come = poses_come(60);
    restart_count();
    return come;
  }
  void restart_count() {
    constexpr double kStillTracked_s = 0.25;  // and two statuses
    daemon.wait([] { return false; }, kStillTracked_s);
    sweeps_sent_ = 0;
    first_pose_ = daemon.poses().size();
    lost_before_ = counted_losses();
  }
  /// Plays until `done` is true before a cycle.
  bool play_until(const std::function<bool()>& done, double seconds = 60.0) {
    return daemon.play(
        target, line,
        [&] {
          if (done()) return true;
          sweeps_sent_ += 2;
          return false;
        },
        seconds);
  }
  void play_for(double seconds) {
    const std::int64_t end_ns = monotonic_now_ns() + static_cast<std::int64_t>(seconds * 1e9);
    play_until([&] { return monotonic_now_ns() >= end_ns; }, seconds + 60.0);
  }

  /// Poses that count as `ok` and are wrong, of all received so far.
  int false_poses() const {
    constexpr double kPosition_m = 0.01, kRotation_rad = 0.5 * kRadPerDeg;
    int count = 0;
    for (const pose_t& pose : daemon.poses()) {
      if (pose.valid == 0 || pose.status != "ok") continue;
      const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                         pose.orientation_wxyz[3]);
      const Vector3 t(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
      const Vector6 error = pose_difference(LighthouseFromBody{q.toRotationMatrix(), t}, target.truth());
      count += error.tail<3>().norm() > kPosition_m || error.head<3>().norm() > kRotation_rad ? 1 : 0;
    }
    return count;
  }
  /// Sweeps sent since restart_count() of which no valid pose was received.
  std::int64_t lost_poses() {
    wait_for_last_poses();
    std::int64_t received = 0;
    for (std::size_t i = first_pose_; i < daemon.poses().size(); ++i) received += daemon.poses()[i].valid != 0 ? 1 : 0;
    return sweeps_sent_ - received;
  }
  /// Those of them that no counter of pharosd reports as lost on the line, or as answered and not sent.
  std::int64_t uncounted_poses() { return std::max<std::int64_t>(0, lost_poses() - (counted_losses() - lost_before_)); }
  /// The counters behind those, in words.
  std::string reasons() const {
    std::string text;
    const source_status_t* source = daemon.source();
    if (source == nullptr) return text;
    for (const counter_t& counter : source->counters) {
      const bool told = counter.name == "link.frames_lost" || counter.name.rfind("cycles_", 0) == 0;
      if (told && counter.value != 0) text += ' ' + counter.name + ' ' + std::to_string(counter.value);
    }
    return text;
  }
  std::int64_t sweeps_sent() const { return sweeps_sent_; }
  std::string memory() { return peak_memory("pharosd", daemon.process().pid()); }
  bool runs() { return daemon.process().wait_exit(0.0) == -1; }

 private:
  void wait_for_last_poses() {
    constexpr double kSomeStatuses_s = 0.5;
    daemon.wait([] { return false; }, kSomeStatuses_s);
  }
  std::int64_t counted_losses() const {
    const source_status_t* source = daemon.source();
    std::int64_t sum = 0;
    if (source == nullptr) return sum;
    for (const counter_t& counter : source->counters) {
      const bool answered = counter.name == "cycles_ok";
      const bool loss = counter.name == "link.frames_lost" || (counter.name.rfind("cycles_", 0) == 0 && !answered);
      if (loss) sum += counter.value;
    }
    return sum;
  }

  std::int64_t sweeps_sent_ = 0;
  std::size_t first_pose_ = 0;
  std::int64_t lost_before_ = 0;
};

}  // namespace pharos::host
