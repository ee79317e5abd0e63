// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include "integration/camera/hostile_sender.hpp"
#include "integration/camera/pharosd_tof_fixture.hpp"
#include "integration/pseudo_terminal.hpp"
#include "integration/stationary_target.hpp"

namespace pharos::host {

/// pharosd with a lighthouse and the simulated Helios, which is attacked while the lighthouse runs.
class AttackedDaemon : public PharosdTofTest {
 protected:
  static constexpr const char* kLighthouse = "dock";
  static constexpr const char* kCamera = "client";

  AttackedDaemon() {
    render("tof_still.toml", 3);
    play.frame_rate_hz = 10.0;
  }
  void start_both() {
    serve();
    daemon.plug_in(line);
    start(kByAddress, "[[target]]\nname = 'dock'\nport = '" + daemon.port() + "'\ntarget_file = 'dock.csv'\n");
  }
  /// Plays the lighthouse until `done`.
  bool play_until(const std::function<bool()>& done, double seconds = kTimeout_s) {
    return daemon.play(target, line, done, seconds);
  }
  bool camera_poses_come(std::size_t count) {
    const std::size_t wanted = daemon.valid_poses(kCamera) + count;
    return play_until([&] { return daemon.valid_poses(kCamera) >= wanted; });
  }
  bool lighthouse_poses_come(std::size_t count) {
    const std::size_t wanted = daemon.valid_poses(kLighthouse) + count;
    return play_until([&] { return daemon.valid_poses(kLighthouse) >= wanted; });
  }
  /// Plays until both measure and the status reports it; losses are counted from here on.
  bool both_measure() {
    const bool come = camera_poses_come(3) && lighthouse_poses_come(60);
    unanswered_ = unanswered_sweeps();
    return come;
  }
  /// Sweeps without a pose since then, from a status that is newer than every sweep played so far.
  std::int64_t lighthouse_poses_lost() {
    const std::size_t poses = daemon.valid_poses(kLighthouse);
    play_until([&] { return daemon.counter("cycles_ok", kLighthouse) >= static_cast<std::int64_t>(poses); });
    return unanswered_sweeps() - unanswered_;
  }
  /// Process id of pharosd's child pharos-camera; -1 if there is none.
  pid_t camera_process() {
    std::ifstream children("/proc/" + std::to_string(daemon.process().pid()) + "/task/" +
                           std::to_string(daemon.process().pid()) + "/children");
    pid_t child = -1;
    children >> child;
    return child;
  }
  bool is_alive(pid_t process) const {
    std::ifstream about("/proc/" + std::to_string(process) + "/comm");
    std::string name;
    return static_cast<bool>(about >> name) && name == "pharos-camera";
  }

  std::int64_t unanswered_sweeps() const {
    return daemon.counter("sweeps", kLighthouse) - daemon.counter("cycles_ok", kLighthouse);
  }

  std::int64_t unanswered_ = 0;
  PseudoTerminal line;
  StationaryTarget target{LighthouseFromBody{rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}};
};

}  // namespace pharos::host
