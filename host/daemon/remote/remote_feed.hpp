// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"
#include "host/daemon/remote/remote_intake.hpp"
#include "host/daemon/rolling_count.hpp"
#include "host/daemon/source.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Every [[remote]]: poses of other daemons to the fusion, on this computer's clock; and the answers of this daemon to
/// those that ask for its clock.
class RemoteFeed final : public Source {
 public:
  /// Questions to each other daemon, per second: four trips for each bin of half a second (LowerEnvelope).
  static constexpr int kAsksPerSecond = 8;
  /// Further questions of one second are not answered.
  static constexpr int kMaxAnswersPerSecond = 400;

  /// Throws InputError where nothing can be received.
  explicit RemoteFeed(const SourceContext& context);
  ~RemoteFeed() override;

  const std::string& name() const override { return name_; }
  void attend() override;
  std::vector<SourceHealth> health() override;
  /// Other daemons' poses do not end; answering alone keeps no replay running.
  bool finished() const override { return remotes_.empty(); }
  NamedCounts daemon_counters() const override;

  /// Asks every other daemon for its clock; the timer calls it.
  void ask();

 private:
  struct Remote {
    Remote(const RemoteConfig& remote, PeerClock* clock);

    RemoteConfig config;
    PeerClock* peer;  // null: its clock is held together with this one's elsewhere
    RemoteIntake intake;
    RateMonitor rate;
    RollingCount poses;  // `came`: messages of the source
    RateLimitedLog log;
    std::string told;  // state and message in the log
  };

  void take_pose(Remote& remote, std::span<const std::uint8_t> message);
  void take_clock(std::span<const std::uint8_t> message);
  void answer(const clock_exchange_t& question);
  // remote_health.cpp
  SourceHealth health_of(Remote& remote, std::int64_t now_ns) const;
  static void assess(const Remote& remote, SourceHealth& health, std::int64_t now_ns);

  const SourceContext& context_;
  std::string name_ = "remote";
  std::int64_t session_;
  std::map<std::string, PeerClock> peers_;  // by the daemon's name
  std::vector<std::unique_ptr<Remote>> remotes_;
  Timer timer_;
  std::int64_t answers_ = 0, not_answered_ = 0, damaged_ = 0;
  std::int64_t answered_second_ = 0;
  int answered_in_second_ = 0;
  std::unique_ptr<MessageReceiver> receiver_;
};

/// Opens one feed for all [[remote]] and the answers, where the configuration has either; returns the number of
/// remotes.
std::size_t open_remote_feed(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
