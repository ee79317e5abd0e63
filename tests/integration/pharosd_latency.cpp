// SPDX-License-Identifier: Apache-2.0
// usage: pharosd_latency [SECONDS [TARGETS]]
// Latency from the last byte of a sweep written to a target's line until its pose is received over LCM from pharosd,
// and the load of pharosd. TARGETS (1) pseudo-terminals with 120 sweeps/s of 12 sensors each, evenly distributed in
// time as those of targets in different directions of their stations are. Prints figures without checks.
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <thread>

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

constexpr std::uint8_t kSensors = 12;
constexpr double kWarmUp_s = 2.0;
constexpr std::int64_t kLimit_ns = 1'000'000;

/// One target's line: its sweeps, and when each was written.
class PlayedTarget {
 public:
  explicit PlayedTarget(std::int64_t phase_ticks) : phase_ticks_(phase_ticks) {}

  const std::string& path() const { return line_.path(); }
  std::int64_t end_ticks(std::int64_t sweep) const { return phase_ticks_ + sweep * StationaryTarget::kHalfTurn_ticks; }
  /// Writes the sweep that ends at end_ticks(sweep), now. `zero_ns`: the monotonic time of tick 0.
  bool write(std::int64_t sweep, std::int64_t zero_ns) {
    const std::int64_t flash_ticks = end_ticks(sweep) - StationaryTarget::kTurn_ticks / 3;
    const lighthouse::Sweep light = target_.sweep(sweep % 2 == 0 ? Axis::kX : Axis::kY, flash_ticks);
    StationaryTarget::Bytes bytes = target_.time((monotonic_now_ns() - zero_ns) / kNanosecondsPerTick);
    const StationaryTarget::Bytes frame = target_.bytes_of(light);
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    std::int32_t last_half_ticks = 0;
    for (const lighthouse::Hit& hit : light.hits) last_half_ticks = std::max(last_half_ticks, hit.centre_half_ticks);
    Written& entry = written_[static_cast<std::size_t>(sweep) % kKept];
    entry.hit_ns = zero_ns + ticks_to_nanoseconds(flash_ticks + last_half_ticks / 2);
    entry.written_ns = monotonic_now_ns();
    return line_.write(bytes);
  }
  /// When the sweep was written whose last hit was at `hit_ns`; 0 if unknown.
  std::int64_t written_ns(std::int64_t hit_ns) const {
    constexpr std::int64_t kTolerance_ns = 4'000'000;  // of the daemon's clock mapping; sweeps are 8.3 ms apart
    for (const Written& entry : written_) {
      if (std::abs(entry.hit_ns - hit_ns) < kTolerance_ns) return entry.written_ns;
    }
    return 0;
  }

 private:
  struct Written {
    std::atomic<std::int64_t> hit_ns = 0;
    std::atomic<std::int64_t> written_ns = 0;
  };
  static constexpr std::size_t kKept = 64;

  std::int64_t phase_ticks_;
  PseudoTerminal line_;
  StationaryTarget target_{{rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}, kSensors};
  std::array<Written, kKept> written_;
};

/// Receives poses and status in a thread of its own.
class Subscriber {
 public:
  Subscriber(const std::string& url, const std::vector<std::unique_ptr<PlayedTarget>>& lines)
      : lcm_(url), lines_(lines) {
    constexpr int kMessages = 10'000;
    lcm_.subscribe("PHAROS_LIGHTHOUSE_POSE", &Subscriber::on_pose, this)->setQueueCapacity(kMessages);
    lcm_.subscribe("PHAROS_STATUS", &Subscriber::on_status, this);
    thread_ = std::thread([this] {
      while (!stop_) lcm_.handleTimeout(100);
    });
  }
  ~Subscriber() { end(); }
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  std::atomic<bool> measuring = false;
  LatencyHistogram latency;
  std::int64_t beyond = 0, unknown = 0, refused = 0;
  std::map<std::string, std::int64_t> p50_us, p99_us;  // inside pharosd, by target
  double resident_mib = 0.0;

 private:
  void on_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_t* pose) {
    const std::int64_t now_ns = monotonic_now_ns();
    if (!measuring) return;
    if (pose->valid == 0) {
      ++refused;
      return;
    }
    const std::int64_t hit_ns = pose->utime * 1000 - utc_now_ns() + monotonic_now_ns();
    const std::int64_t written_ns = lines_[std::stoul(pose->target.substr(1))]->written_ns(hit_ns);
    if (written_ns == 0) {
      ++unknown;
      return;
    }
    latency.add(now_ns - written_ns);
    beyond += now_ns - written_ns > kLimit_ns ? 1 : 0;
  }
  void on_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status) {
    for (const counter_t& counter : status->counters) {
      if (counter.name == "process_resident_kib") resident_mib = static_cast<double>(counter.value) / 1024.0;
    }
    for (const source_status_t& source : status->sources) {
      for (const counter_t& counter : source.counters) {
        if (counter.name == "latency_p50_us") p50_us[source.target] = counter.value;
        if (counter.name == "latency_p99_us") p99_us[source.target] = counter.value;
      }
    }
  }

  lcm::LCM lcm_;
  const std::vector<std::unique_ptr<PlayedTarget>>& lines_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Processor time of a process, and how long its first thread was ready and waited for a processor, s.
struct ProcessTimes {
  double used_s = 0.0, waited_s = 0.0;
};

ProcessTimes times_of(int process) {
  ProcessTimes times;
  std::error_code error;
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", error)) {
    std::ifstream about(thread.path() / "schedstat");
    double used_ns = 0.0, waited_ns = 0.0;
    about >> used_ns >> waited_ns;
    times.used_s += used_ns * 1e-9;
    if (thread.path().filename() == std::to_string(process)) times.waited_s = waited_ns * 1e-9;
  }
  return times;
}

std::string load_average() {
  std::ifstream in("/proc/loadavg");
  std::string one_minute;
  in >> one_minute;
  return one_minute;
}

/// Writes all sweeps that end before `until_ns`, each at its time.
bool play(std::vector<std::unique_ptr<PlayedTarget>>& lines, std::int64_t zero_ns, std::int64_t& sweep,
          std::int64_t until_ns) {
  for (; monotonic_now_ns() < until_ns; ++sweep) {
    for (const auto& line : lines) {
      const std::int64_t at_ns = zero_ns + ticks_to_nanoseconds(line->end_ticks(sweep));
      std::this_thread::sleep_for(std::chrono::nanoseconds(at_ns - monotonic_now_ns()));
      if (!line->write(sweep, zero_ns)) return false;
    }
  }
  return true;
}

std::int64_t median(std::vector<std::int64_t> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

void print(const Subscriber& subscriber, const ProcessTimes& times, double seconds, std::size_t targets) {
  const auto us = [&](double q) { return static_cast<double>(subscriber.latency.quantile_ns(q)) * 1e-3; };
  const auto poses = static_cast<double>(subscriber.latency.count());
  std::vector<std::int64_t> inside_p50_us, inside_p99_us;
  for (const auto& [target, value] : subscriber.p50_us) inside_p50_us.push_back(value);
  for (const auto& [target, value] : subscriber.p99_us) inside_p99_us.push_back(value);
  std::printf(
      "targets                    %zu, %.0f poses in %.1f s (%.1f/s each), %lld refused, %lld of unknown sweeps\n",
      targets, poses, seconds, poses / seconds / static_cast<double>(targets),
      static_cast<long long>(subscriber.refused), static_cast<long long>(subscriber.unknown));
  std::printf("last byte in -> pose heard p50 %.0f us, p99 %.0f us, largest %.0f us; %.2f %% beyond 1 ms\n", us(0.5),
              us(0.99), us(1.0), 100.0 * static_cast<double>(subscriber.beyond) / std::max(poses, 1.0));
  std::printf("of that inside pharosd     p50 %lld us, p99 %lld us (median target)\n",
              static_cast<long long>(median(inside_p50_us)), static_cast<long long>(median(inside_p99_us)));
  std::printf(
      "pharosd                    %.2f %% of one core (%.0f us a pose), %.1f MiB resident; ready and waiting for a "
      "core %.2f %%\n",
      times.used_s / seconds * 100.0, times.used_s / std::max(poses, 1.0) * 1e6, subscriber.resident_mib,
      times.waited_s / seconds * 100.0);
  std::printf("load average               %s\n", load_average().c_str());
}

int measure(double seconds, std::size_t targets) {
  const fs::path folder = fs::temp_directory_path() / ("pharosd_latency_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::string url = "udpm://239.255.76.68:" + std::to_string(20'000 + ::getpid() % 20'000) + "?ttl=0";
  std::ofstream(folder / "target.csv") << StationaryTarget::target_table(kSensors);
  std::ofstream config(folder / "p.toml");
  config << "[lcm]\nurl = '" << url << "'\n";
  std::vector<std::unique_ptr<PlayedTarget>> lines;
  for (std::size_t i = 0; i < targets; ++i) {
    const auto phase_ticks = static_cast<std::int64_t>(i) * StationaryTarget::kHalfTurn_ticks;
    lines.push_back(std::make_unique<PlayedTarget>(phase_ticks / static_cast<std::int64_t>(targets)));
    config << "[[target]]\nname = 't" << i << "'\nport = '" << lines.back()->path()
           << "'\ntarget_file = 'target.csv'\n";
  }
  config.close();
  Subscriber subscriber(url, lines);
  ChildProcess daemon({PHAROSD, (folder / "p.toml").string()});
  if (!daemon.wait_for("started")) {
    std::fprintf(stderr, "pharosd did not start:\n%s", daemon.text().c_str());
    return 1;
  }
  ::prctl(PR_SET_TIMERSLACK, 1000);  // ns: sweeps are written when they end
  const std::int64_t zero_ns = monotonic_now_ns() - kTicksPerSecond * kNanosecondsPerTick;
  std::int64_t sweep = kTicksPerSecond / StationaryTarget::kHalfTurn_ticks + 1;
  const auto after_ns = [](double s) { return monotonic_now_ns() + static_cast<std::int64_t>(s * 1e9); };
  bool played = play(lines, zero_ns, sweep, after_ns(kWarmUp_s));
  const ProcessTimes before = times_of(daemon.pid());
  const std::int64_t began_ns = monotonic_now_ns();
  subscriber.measuring = true;
  played = played && play(lines, zero_ns, sweep, after_ns(seconds));
  const double measured_s = static_cast<double>(monotonic_now_ns() - began_ns) * 1e-9;
  const ProcessTimes after = times_of(daemon.pid());
  subscriber.measuring = false;
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // the last status
  subscriber.end();
  print(subscriber, {after.used_s - before.used_s, after.waited_s - before.waited_s}, measured_s, targets);
  fs::remove_all(folder);
  return played && subscriber.latency.count() > 0 ? 0 : 1;
}

}  // namespace
}  // namespace pharos::host

int main(int argc, char** argv) {
  constexpr double kDefault_s = 20.0;
  const auto targets = static_cast<std::size_t>(argc > 2 ? std::max(1, std::atoi(argv[2])) : 1);
  return pharos::host::measure(argc > 1 ? std::atof(argv[1]) : kDefault_s, targets);
}
