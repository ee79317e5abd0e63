// SPDX-License-Identifier: Apache-2.0
// Any bytes as messages of another daemon: each two bytes of length, then a message that is a pose, or a clock's answer
// if it is one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "host/daemon/remote/remote_intake.hpp"
#include "host/receive/message_shape.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pose_t.hpp"
#include "support/require.hpp"

namespace {

using namespace pharos;
using namespace pharos::host;
using pharos::test::require;

struct FixedClock final : Clock {
  std::int64_t utc_ns() const override { return 1'700'000'000'000'000'000 + monotonic_ns(); }
  std::int64_t monotonic_ns() const override { return now_ns; }
  std::int64_t now_ns = 40'000'000'000;
};

RemoteConfig config_of(bool measured) {
  RemoteConfig config;
  config.name = "depth";
  config.source = "tof/helios";
  config.target = "client";
  config.frame = "camera";
  config.feature = "target";
  if (measured) {
    config.daemon = "cameras";
  } else {
    config.clock_sigma_s = 1e-4;
  }
  return config;
}

void check(const pose_t& pose, const Clock& clock) {
  require(pose.valid != 0 && pose.source == "remote/depth" && pose.utime_sigma_us >= 0);
  for (const double value : pose.position_m) require(std::isfinite(value));
  for (const double value : pose.orientation_wxyz) require(std::isfinite(value));
  for (int i = 0; i < 6; ++i) require(pose.covariance[7 * i] > 0.0 && std::isfinite(pose.covariance[7 * i]));
  const std::int64_t age_us = clock.utc_ns() / 1000 - pose.utime;
  require(age_us <= 500'001);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FixedClock clock;
  PeerClock peer("chaser", 7, "cameras");
  RemoteIntake held(config_of(false)), measured(config_of(true));
  std::span<const std::uint8_t> left(data, size);
  while (left.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(left[0] << 8U | left[1], left.size() - 2);
    const std::span<const std::uint8_t> message = left.subspan(2, length);
    left = left.subspan(2 + length);
    clock.now_ns += 50'000'000;
    clock_exchange_t exchange{};
    if (decode(exchange, message.data(), static_cast<int>(message.size()))) {
      static_cast<void>(peer.ask(clock.now_ns));
      peer.take(exchange, clock.now_ns + 1'000'000);
      require(peer.relation().sigma_ns() >= 0);
      continue;
    }
    if (const auto pose = held.take(message, nullptr, clock)) check(*pose, clock);
    if (const auto pose = measured.take(message, &peer, clock)) check(*pose, clock);
  }
  std::int64_t counted = 0;
  for (const NamedCount& count : held.counts()) {
    if (count.name != "poses_lost" && count.name != "restarts") counted += count.value;
  }
  require(counted >= 0);
  return 0;
}
