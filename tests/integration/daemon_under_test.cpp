// SPDX-License-Identifier: Apache-2.0
#include "integration/daemon_under_test.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <thread>

#include "host/runtime/now.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// The target's clock at the test's start: an arbitrary value far from zero.
constexpr std::int64_t kFirst_ticks = 1000 * kTicksPerSecond;

std::string own_url() { return "udpm://239.255.76.68:" + std::to_string(20'000 + ::getpid() % 20'000) + "?ttl=0"; }

}  // namespace

DaemonUnderTest::DaemonUnderTest()
    : folder_(fs::path(::testing::TempDir()) / ("pharosd_" + std::to_string(::getpid()))), url_(own_url()) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  std::ofstream(folder_ / "dock.csv") << StationaryTarget::target_table();
  lcm_ = std::make_unique<lcm::LCM>(url_);
  target_clock_zero_ns_ = monotonic_now_ns() - ticks_to_nanoseconds(kFirst_ticks);
  if (!lcm_->good()) return;  // start() says so
  // LCM's queue has 30 messages by default: fewer than a daemon sends while a test waits for its end.
  constexpr int kMessages = 10'000;
  for (const char* system : {"LIGHTHOUSE", "TOF", "RING2", "SLAM"}) {
    lcm_->subscribe(std::string("PHAROS_") + system + "_POSE", &DaemonUnderTest::on_pose, this)
        ->setQueueCapacity(kMessages);
  }
  lcm_->subscribe("PHAROS_LINE_POINTING", &DaemonUnderTest::on_pointing, this)->setQueueCapacity(kMessages);
  lcm_->subscribe("PHAROS_SLAM_SPIN", &DaemonUnderTest::on_spin, this)->setQueueCapacity(kMessages);
  lcm_->subscribe("PHAROS_STATUS", &DaemonUnderTest::on_status, this)->setQueueCapacity(kMessages);
  listen(1);
}

DaemonUnderTest::~DaemonUnderTest() {
  process_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string DaemonUnderTest::program() { return PHAROSD; }

void DaemonUnderTest::plug_in(const PseudoTerminal& line, const std::string& name) const {
  fs::create_symlink(line.path(), folder_ / name);
}

void DaemonUnderTest::pull_out(const std::string& name) const { fs::remove(folder_ / name); }

fs::path DaemonUnderTest::write_config(const std::string& more, const std::string& head) const {
  const fs::path file = folder_ / "pharosd.toml";
  std::ofstream(file) << head << "\n[lcm]\nurl = '" << url_ << "'\n[publish]\nstatus_rate_hz = 10\n"
                      << "[[target]]\nname = 'dock'\nport = '" << port() << "'\ntarget_file = 'dock.csv'\n"
                      << more;
  return file;
}

ChildProcess& DaemonUnderTest::start(const std::vector<std::string>& arguments, unsigned long file_size_limit) {
  if (!lcm_->good()) throw std::runtime_error("no multicast on this computer: ip route add 224.0.0.0/4 dev lo");
  std::vector<std::string> all{program(), (folder_ / "pharosd.toml").string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  process_ = std::make_unique<ChildProcess>(all, file_size_limit);
  if (!process_->wait_for("started")) ADD_FAILURE() << "pharosd did not start:\n" << process_->text();
  return *process_;
}

void DaemonUnderTest::listen(int timeout_ms) {
  if (lcm_->handleTimeout(timeout_ms) <= 0) return;
  while (lcm_->handleTimeout(0) > 0) {
  }
}

bool DaemonUnderTest::wait(const std::function<bool()>& done, double seconds) {
  const std::int64_t end_ns = monotonic_now_ns() + static_cast<std::int64_t>(seconds * 1e9);
  while (!done()) {
    if (monotonic_now_ns() > end_ns) return false;
    listen(10);
  }
  return true;
}

bool DaemonUnderTest::play(StationaryTarget& target, const PseudoTerminal& line, const std::function<bool()>& done,
                           double seconds) {
  const std::int64_t end_ns = monotonic_now_ns() + static_cast<std::int64_t>(seconds * 1e9);
  const auto now_ticks = [&] { return (monotonic_now_ns() - target_clock_zero_ns_) / kNanosecondsPerTick; };
  // A station turns on between two calls: its next flash comes after whole turns.
  const std::int64_t pause_ticks = now_ticks() - last_cycle_ticks_;
  std::int64_t ticks = last_cycle_ticks_ + pause_ticks / StationaryTarget::kTurn_ticks * StationaryTarget::kTurn_ticks;
  while (!done()) {
    if (monotonic_now_ns() > end_ns) return false;
    ticks += StationaryTarget::kTurn_ticks;
    while (now_ticks() < ticks) listen(static_cast<int>((ticks - now_ticks()) / (kTicksPerSecond / 1000)));
    line.write(target.cycle(ticks));
    last_cycle_ticks_ = ticks;
    line.write(target.time(now_ticks()));
  }
  return true;
}

std::size_t DaemonUnderTest::valid_poses(const std::string& target) const {
  return static_cast<std::size_t>(std::count_if(
      poses_.begin(), poses_.end(), [&](const pose_t& pose) { return pose.valid != 0 && pose.target == target; }));
}

const source_status_t* DaemonUnderTest::source(const std::string& target) const {
  if (!status_) return nullptr;
  for (const source_status_t& source : status_->sources) {
    if (source.target == target) return &source;
  }
  return nullptr;
}

std::int64_t DaemonUnderTest::counter(const std::string& name, const std::string& target) const {
  const source_status_t* found = source(target);
  if (found == nullptr) return -1;
  for (const counter_t& counter : found->counters) {
    if (counter.name == name) return counter.value;
  }
  return -1;
}

}  // namespace pharos::host
