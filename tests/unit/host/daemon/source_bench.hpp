// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "host/daemon/source.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host::test {

/// What the daemon lends to its sources, in a test's hands: a loop that it turns, a clock that it moves, a list in the
/// place of LCM.
struct SourceBench {
  /// Turns the loop until something is so; the daemon's attend timer is played. Work in threads ends when it ends: the
  /// test program's own time limit is the only one.
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
