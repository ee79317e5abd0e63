// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "host/daemon/fusion/fusion_feed.hpp"
#include "host/daemon/remote/remote_feed.hpp"
#include "unit/host/daemon/fusion_fixture.hpp"
#include "unit/host/daemon/moving_target.hpp"
#include "unit/host/daemon/simulated_network.hpp"

namespace pharos::host::test {

/// A daemon's side of its sources on one computer of a simulated network.
struct NetworkedDaemon {
  NetworkedDaemon(SimulatedNetwork& network, const std::string& name, double offset_s, double drift)
      : computer(network.add(offset_s, drift)) {
    config.source = name;
    context.open_receiver = [this](const std::string&) { return computer.receiver(); };
  }

  SimulatedNetwork::Computer& computer;
  DaemonConfig config;
  EventLoop loop;
  Publisher publisher{computer, "PHAROS_"};
  SourceContext context{loop, computer.clock, publisher, config, ReplaySpeed::kFastest};
  std::int64_t not_finite = 0;
  std::optional<RemoteFeed> remote;
  std::optional<FusionFeed> fusion;

  // Questions at the feed's rate from true time `from_ns` on.
  void ask_from(SimulatedNetwork& network, std::int64_t from_ns) {
    network.at(from_ns, [this, &network, from_ns] {
      if (remote) remote->ask();
      ask_from(network, from_ns + kNsPerSecond / RemoteFeed::kAsksPerSecond);
    });
  }
};

}  // namespace pharos::host::test
