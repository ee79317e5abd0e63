// SPDX-License-Identifier: Apache-2.0
// One of the daemons of an approach in real time: with all sensors, with the cameras alone, or with the lighthouse and
// the fusion. The cameras' computer has a clock that differs and drifts.
//
//   two_computers one|cameras|chaser START_UTC_NS SECONDS OFFSET_MS DRIFT_PPM
//
// `one` and `chaser` print "states N position_mm P rotation_deg R remote_sigma_us S": RMS errors of the fused states,
// and the largest sigma of the clocks' relation.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>

#include "host/daemon/daemon.hpp"
#include "host/publish/lcm_sink.hpp"
#include "pharos/base/units.hpp"
#include "pharos/status_t.hpp"
#include "unit/host/daemon/moving_target.hpp"

namespace pharos::host {
namespace {

using test::kMs;
using test::MovingTarget;

struct Plan {
  std::string role;
  std::int64_t start_ns = 0;  // true UTC
  double seconds = 0.0;
  double offset_s = 0.0, drift = 0.0;

  bool has_cameras() const { return role != "chaser"; }
  bool has_lighthouse() const { return role != "cameras"; }
};

/// The computer's clocks with an offset, and a drift from the start on.
class OtherClock final : public Clock {
 public:
  explicit OtherClock(const Plan& plan) : plan_(plan), monotonic_start_ns_(monotonic_now_ns()) {}
  std::int64_t utc_ns() const override { return of(utc_now_ns()); }
  std::int64_t monotonic_ns() const override {
    const std::int64_t now_ns = monotonic_now_ns();
    return now_ns + std::llround(plan_.drift * static_cast<double>(now_ns - monotonic_start_ns_));
  }
  std::int64_t of(std::int64_t true_utc_ns) const {
    return true_utc_ns +
           std::llround(plan_.offset_s * 1e9 + plan_.drift * static_cast<double>(true_utc_ns - plan_.start_ns));
  }

 private:
  const Plan& plan_;
  std::int64_t monotonic_start_ns_;
};

/// Sensors that measure the moving target: lighthouse at 50 Hz, cameras at 10 Hz and 40 ms late. Ends the daemon.
class SimulatedSensors final : public Source {
 public:
  SimulatedSensors(const SourceContext& context, const Plan& plan, const OtherClock& clock)
      : context_(context), plan_(plan), clock_(clock), target_(test::a_vehicle()) {
    context_.loop.watch(timer_.fd(), [this] {
      timer_.take_expiries();
      measure();
    });
    timer_.start_every(std::chrono::milliseconds(2));
  }
  ~SimulatedSensors() override { context_.loop.forget(timer_.fd()); }

  const std::string& name() const override { return name_; }
  void attend() override {}
  std::vector<SourceHealth> health() override { return {}; }

 private:
  void measure() {
    const std::int64_t now_ns = utc_now_ns() - plan_.start_ns;
    for (; (next_ + 1) * 20 * kMs <= now_ns; ++next_) {
      const std::int64_t time_ns = (next_ + 1) * 20 * kMs;
      if (plan_.has_lighthouse()) publish(target_.lighthouse(time_ns), "lighthouse/chaser", time_ns);
      if (plan_.has_cameras() && next_ % 5 == 4) exposed_.push_back(time_ns);
    }
    while (!exposed_.empty() && exposed_.front() + 40 * kMs <= now_ns) {
      const std::int64_t time_ns = exposed_.front();
      exposed_.pop_front();
      publish(target_.tof(time_ns), "tof/helios", time_ns);
      publish(target_.ring2(time_ns), "ring2/bow", time_ns);
    }
    // The cameras go on for longer than the one who listens.
    const double end_s = plan_.seconds + (plan_.has_lighthouse() ? 0.0 : 2.0);
    if (static_cast<double>(now_ns) > end_s * 1e9) ::kill(::getpid(), SIGTERM);
  }
  template <class Report>
  void publish(Report report, const std::string& source, std::int64_t time_ns) {
    report.utc_ns = clock_.of(plan_.start_ns + time_ns);
    report.source = source;
    report.target = "client";
    auto [gate, fresh] = gates_.try_emplace(source, nullptr);
    if (fresh) gate->second = std::make_unique<PublishGate>(context_.publisher, not_finite_);
    gate->second->publish(report);
  }

  const SourceContext& context_;
  const Plan& plan_;
  const OtherClock& clock_;
  MovingTarget target_;
  std::string name_ = "simulated";
  Timer timer_;
  std::int64_t next_ = 0;  // interval of 20 ms
  std::deque<std::int64_t> exposed_;
  std::int64_t not_finite_ = 0;
  std::map<std::string, std::unique_ptr<PublishGate>> gates_;
};

/// Sends over LCM, and compares what is sent with the truth.
class ComparingSink final : public MessageSink {
 public:
  ComparingSink(MessageSink& sink, std::int64_t start_ns) : sink_(sink), start_us_(start_ns / 1000) {}
  bool send(const std::string& channel, std::span<const std::uint8_t> message) override {
    errors.add(channel, message.data(), message.size(), start_us_);
    status_t status;
    const auto size = static_cast<int>(message.size());
    if (channel == "PHAROS_STATUS" && status.decode(message.data(), 0, size) == size) {
      for (const source_status_t& source : status.sources) {
        if (source.source.rfind("remote/", 0) != 0) continue;
        remote_sigma_us = source.clock_sigma_us;
        if (source.state != "ok") std::fprintf(stderr, "%s is %s\n", source.source.c_str(), source.message.c_str());
      }
    }
    return sink_.send(channel, message);
  }

  test::StateErrors errors;
  double remote_sigma_us = 0.0;

 private:
  MessageSink& sink_;
  std::int64_t start_us_;
};

DaemonConfig config_of(const Plan& plan) {
  DaemonConfig config;
  config.source = plan.role == "cameras" ? "cameras" : "chaser";
  config.lcm.url = "udpm://239.255.76.77:7677?ttl=1";
  config.lcm.answer_clock = plan.role == "cameras";
  if (plan.role == "one") config.vehicle = test::a_vehicle();
  if (plan.role == "chaser") {
    config.vehicle = test::a_vehicle_with_remotes();
    config.remotes = test::two_remotes();
  }
  if (config.vehicle) config.vehicle->rate_hz = 20.0;
  return config;
}

int run(const Plan& plan) {
  Signals signals{SIGTERM};
  const OtherClock clock(plan);
  const DaemonConfig config = config_of(plan);
  LcmSink lcm(config.lcm.url);
  ComparingSink sink(lcm, plan.start_ns);
  SourceKinds kinds = source_kinds();
  kinds.push_back({"simulation", [&](const SourceContext& context, SourceList& sources) {
                     sources.push_back(std::make_unique<SimulatedSensors>(context, plan, clock));
                     return std::size_t{1};
                   }});
  Daemon(config, sink, signals, ReplaySpeed::kReal, clock, kinds).run();
  if (!plan.has_lighthouse()) return 0;
  std::printf("states %d position_mm %.4f rotation_deg %.5f remote_sigma_us %.1f\n", sink.errors.states(),
              1e3 * sink.errors.position_m(), sink.errors.rotation_rad() * kDegPerRad, sink.remote_sigma_us);
  return sink.errors.states() > 0 ? 0 : 1;
}

}  // namespace
}  // namespace pharos::host

int main(int argc, char** argv) {
  constexpr int kArguments = 6;
  if (argc != kArguments) return 2;
  const pharos::host::Plan plan{argv[1], std::atoll(argv[2]), std::atof(argv[3]), 1e-3 * std::atof(argv[4]),
                                1e-6 * std::atof(argv[5])};
  return pharos::host::run(plan);
}
