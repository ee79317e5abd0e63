// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "host/daemon/source.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host::test {

/// The daemon's side of a source, controlled by a test: an event loop, a manual clock, and a list of messages instead
/// of LCM.
struct SourceBench {
  /// Runs the loop until `what` holds, and calls attend() as the daemon's timer does. There is no time limit for work
  /// in threads other than that of the test program.
  void run_until(Source& source, const std::function<bool()>& what) {
    while (!what()) {
      loop.turn(20);
      source.attend();
    }
  }
  static std::int64_t counter(Source& source, const std::string& name) {
    const SourceHealth health = source.health().at(0);
    for (const NamedCount& count : health.counters) {
      if (count.name == name) return count.value;
    }
    return -1;
  }

  MessageList sink;
  Publisher publisher{sink, "PHAROS_"};
  EventLoop loop;
  ManualClock clock;
  DaemonConfig config;
  bool finished = false;
  SourceContext context{loop, clock, publisher, config, ReplaySpeed::kFastest, [this] { finished = true; }};
};

}  // namespace pharos::host::test
