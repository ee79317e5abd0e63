// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <csignal>

#include "integration/daemon_under_test.hpp"

namespace pharos::host {

/// A daemon, a line at its port and a target with its station: the set-up of nearly every test of pharosd.
class PharosdTest : public ::testing::Test {
 protected:
  static LighthouseFromBody some_pose() { return {rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}; }

  /// Connects the line, writes the configuration (see DaemonUnderTest::write_config) and starts the daemon.
  void start(const std::string& more = "", const std::string& head = "", unsigned long file_size_limit = 0) {
    daemon.plug_in(line);
    daemon.write_config(more, head);
    daemon.start({}, file_size_limit);
  }
  /// Sends until `count` more valid poses of `dock` were received.
  ::testing::AssertionResult poses_come(std::size_t count) { return poses_come(count, line); }
  ::testing::AssertionResult poses_come(std::size_t count, const PseudoTerminal& on_line) {
    const std::size_t wanted = daemon.valid_poses() + count;
    if (daemon.play(target, on_line, [&] { return daemon.valid_poses() >= wanted; })) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "too few poses:\n" << daemon.process().text();
  }
  /// Ends the daemon like systemd; returns its exit code.
  int stop() {
    daemon.process().signal(SIGTERM);
    return daemon.process().wait_exit();
  }

  DaemonUnderTest daemon;
  PseudoTerminal line;
  StationaryTarget target{some_pose()};
};

}  // namespace pharos::host
