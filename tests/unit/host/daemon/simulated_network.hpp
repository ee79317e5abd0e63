// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "host/publish/message_sink.hpp"
#include "host/receive/message_receiver.hpp"
#include "host/runtime/clock.hpp"

namespace pharos::host::test {

/// Computers on one network, in simulated true time: each has clocks of its own, and what one sends reaches all (itself
/// too, as LCM does) after a delay.
class SimulatedNetwork {
 public:
  /// A computer's clocks: true time with an offset and a drift.
  class DriftingClock final : public Clock {
   public:
    DriftingClock(const std::int64_t& true_ns, double offset_s, double drift)
        : true_ns_(true_ns), offset_s_(offset_s), drift_(drift) {}
    std::int64_t utc_ns() const override { return kEpoch_ns + own(); }
    std::int64_t monotonic_ns() const override { return 40'000'000'000 + own(); }
    /// UTC of this computer at a true time.
    std::int64_t utc_at(std::int64_t true_ns) const {
      return kEpoch_ns + true_ns + std::llround(offset_s_ * 1e9 + drift_ * static_cast<double>(true_ns));
    }
    void step(double seconds) { offset_s_ += seconds; }

    static constexpr std::int64_t kEpoch_ns = 1'700'000'000'000'000'000;

   private:
    std::int64_t own() const { return utc_at(true_ns_) - kEpoch_ns; }
    const std::int64_t& true_ns_;
    double offset_s_;
    double drift_;
  };

  /// One computer's connection.
  class Computer final : public MessageSink {
   public:
    Computer(SimulatedNetwork& network, double offset_s, double drift)
        : clock(network.now_ns, offset_s, drift), network_(network) {}
    bool send(const std::string& channel, std::span<const std::uint8_t> message) override {
      network_.send(channel, {message.begin(), message.end()});
      sent.push_back({channel, {message.begin(), message.end()}});
      return true;
    }
    std::unique_ptr<MessageReceiver> receiver() { return std::make_unique<Receiver>(handlers); }

    DriftingClock clock;
    std::multimap<std::string, MessageReceiver::Handler> handlers;
    std::vector<std::pair<std::string, std::vector<std::uint8_t>>> sent;

   private:
    struct Receiver final : MessageReceiver {
      explicit Receiver(std::multimap<std::string, Handler>& all) : handlers(all) {}
      void subscribe(const std::string& channel, Handler handler) override {
        handlers.emplace(channel, std::move(handler));
      }
      int fd() const override { return -1; }
      void take() override {}
      std::multimap<std::string, Handler>& handlers;
    };
    SimulatedNetwork& network_;
  };

  Computer& add(double offset_s, double drift) {
    computers_.push_back(std::make_unique<Computer>(*this, offset_s, drift));
    return *computers_.back();
  }
  /// `what` at true time `at_ns`.
  void at(std::int64_t at_ns, std::function<void()> what) { events_.emplace(at_ns, std::move(what)); }
  void run_until(std::int64_t end_ns) {
    while (!events_.empty() && events_.begin()->first <= end_ns) {
      auto event = events_.extract(events_.begin());
      now_ns = std::max(now_ns, event.key());
      event.mapped()();
    }
    now_ns = end_ns;
  }
  void send(const std::string& channel, const std::vector<std::uint8_t>& bytes) {
    for (const auto& computer : computers_) {
      std::exponential_distribution<double> jitter(1.0 / jitter_ns);
      const std::int64_t arrival_ns = now_ns + std::llround(delay_ns + jitter(random));
      at(arrival_ns, [bytes, channel, to = computer.get()] {
        const auto [begin, end] = to->handlers.equal_range(channel);
        for (auto handler = begin; handler != end; ++handler) handler->second(bytes);
      });
    }
  }

  std::int64_t now_ns = 0;  // true time
  double delay_ns = 100e3;
  double jitter_ns = 50e3;  // mean, exponential
  std::mt19937_64 random{20261124};

 private:
  std::vector<std::unique_ptr<Computer>> computers_;
  std::multimap<std::int64_t, std::function<void()>> events_;
};

}  // namespace pharos::host::test
