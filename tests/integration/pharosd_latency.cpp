// SPDX-License-Identifier: Apache-2.0
// usage: pharosd_latency [SECONDS]
// Latency from the last byte of a cycle written to the line until its pose is received over LCM from pharosd, and the
// load of pharosd. 60 cycles/s of 12 sensors on a pseudo-terminal. Prints figures without checks.
#include <sched.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <map>

#include "host/runtime/latency_histogram.hpp"
#include "host/runtime/now.hpp"
#include "integration/child_process.hpp"
#include "integration/pseudo_terminal.hpp"
#include "integration/stationary_target.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/status_t.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

struct Subscriber {
  LatencyHistogram latency;
  std::int64_t written_ns = 0;
  std::int64_t poses = 0;
  std::map<std::string, std::int64_t> counters;
  void on_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_t* pose) {
    if (pose->valid == 0) return;
    ++poses;
    latency.add(monotonic_now_ns() - written_ns);
  }
  void on_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status) {
    for (const counter_t& counter : status->counters) counters[counter.name] = counter.value;
    for (const source_status_t& source : status->sources) {
      for (const counter_t& counter : source.counters) counters[counter.name] = counter.value;
    }
  }
};

void hear_until(lcm::LCM& lcm, std::int64_t until_ns) {
  for (std::int64_t left_ns = 0; (left_ns = until_ns - monotonic_now_ns()) > 0;) {
    lcm.handleTimeout(static_cast<int>(left_ns / 1'000'000));
  }
}

int measure(double seconds) {
  const fs::path folder = fs::temp_directory_path() / ("pharosd_latency_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::string url = "udpm://239.255.76.68:" + std::to_string(20'000 + ::getpid() % 20'000) + "?ttl=0";
  PseudoTerminal line;
  std::ofstream(folder / "target.csv") << StationaryTarget::target_table(12);
  std::ofstream(folder / "p.toml") << "[lcm]\nurl = '" << url << "'\n[[target]]\nname = 'dock'\nport = '" << line.path()
                                   << "'\ntarget_file = 'target.csv'\n";
  lcm::LCM lcm(url);
  Subscriber subscriber;
  lcm.subscribe("PHAROS_LIGHTHOUSE_POSE", &Subscriber::on_pose, &subscriber);
  lcm.subscribe("PHAROS_STATUS", &Subscriber::on_status, &subscriber);
  ChildProcess daemon({PHAROSD, (folder / "p.toml").string()});
  if (!daemon.wait_for("is open")) {
    std::fprintf(stderr, "pharosd did not start:\n%s", daemon.text().c_str());
    return 1;
  }
  StationaryTarget target({rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}, 12);
  const std::int64_t start_ns = monotonic_now_ns();
  const auto ticks_now = [&] { return (monotonic_now_ns() - start_ns) / kNanosecondsPerTick + kTicksPerSecond; };
  std::int64_t ticks = ticks_now();
  while (static_cast<double>(monotonic_now_ns() - start_ns) < seconds * 1e9) {
    ticks += StationaryTarget::kTurn_ticks;
    hear_until(lcm, start_ns + (ticks - kTicksPerSecond) * kNanosecondsPerTick);
    const StationaryTarget::Bytes cycle = target.cycle(ticks);
    subscriber.written_ns = monotonic_now_ns();
    if (!line.write(cycle)) return 1;
    line.write(target.time(ticks_now()));
  }
  hear_until(lcm, monotonic_now_ns() + 1'100'000'000);
  const auto us = [&](double q) { return static_cast<double>(subscriber.latency.quantile_ns(q)) * 1e-3; };
  std::printf("poses                      %lld in %.1f s\n", static_cast<long long>(subscriber.poses), seconds);
  std::printf("last byte in -> pose heard p50 %.0f us, p99 %.0f us, largest %.0f us\n", us(0.5), us(0.99), us(1.0));
  std::printf("of that inside pharosd     p50 %lld us, p99 %lld us\n",
              static_cast<long long>(subscriber.counters["latency_p50_us"]),
              static_cast<long long>(subscriber.counters["latency_p99_us"]));
  std::printf("pharosd                    %.2f %% of one core, %.1f MiB resident\n",
              static_cast<double>(subscriber.counters["process_cpu_us"]) * 1e-6 / (seconds + 1.1) * 100.0,
              static_cast<double>(subscriber.counters["process_resident_kib"]) / 1024.0);
  fs::remove_all(folder);
  return subscriber.poses > 0 ? 0 : 1;
}

}  // namespace
}  // namespace pharos::host

int main(int argc, char** argv) {
  constexpr double kDefault_s = 20.0;
  return pharos::host::measure(argc > 1 ? std::atof(argv[1]) : kDefault_s);
}
