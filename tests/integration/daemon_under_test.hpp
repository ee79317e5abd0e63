// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "integration/child_process.hpp"
#include "integration/pseudo_terminal.hpp"
#include "integration/stationary_target.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"

namespace lcm {
class LCM;
struct ReceiveBuffer;
}  // namespace lcm

namespace pharos::host {

/// A pharosd for one test, with its own folder and multicast port, and a subscriber to all its messages.
class DaemonUnderTest {
 public:
  DaemonUnderTest();
  ~DaemonUnderTest();

  const std::filesystem::path& folder() const { return folder_; }
  const std::string& url() const { return url_; }
  /// A port's name that can be linked to one pseudo-terminal after another, like udev's names.
  std::string port(const std::string& name = "port") const { return (folder_ / name).string(); }
  void plug_in(const PseudoTerminal& line, const std::string& name = "port") const;
  void pull_out(const std::string& name = "port") const;

  /// Writes pharosd.toml: [lcm], status ten times a second, one target `dock` at port(), then `more`.
  std::filesystem::path write_config(const std::string& more = "", const std::string& head = "") const;
  /// Starts pharosd with that configuration and waits until it reports its start.
  ChildProcess& start(const std::vector<std::string>& arguments = {}, unsigned long file_size_limit = 0);
  ChildProcess& process() { return *process_; }
  static std::string program();

  /// Sends cycles of `target` to `line` in real time until `done` or for `seconds`; true when done. The target's clock
  /// continues from call to call.
  bool play(StationaryTarget& target, const PseudoTerminal& line, const std::function<bool()>& done,
            double seconds = 8.0);
  /// Receives messages without sending.
  bool wait(const std::function<bool()>& done, double seconds = 8.0);

  const std::vector<pose_t>& poses() const { return poses_; }
  const std::vector<pointing_t>& pointings() const { return pointings_; }
  const std::vector<spin_t>& spins() const { return spins_; }
  std::size_t valid_poses(const std::string& target = "dock") const;
  const std::optional<status_t>& status() const { return status_; }
  /// Of the last status: a source's state, message and counter.
  const source_status_t* source(const std::string& target = "dock") const;
  std::int64_t counter(const std::string& name, const std::string& target = "dock") const;

 private:
  void listen(int timeout_ms);
  void on_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_t* pose) { poses_.push_back(*pose); }
  void on_pointing(const lcm::ReceiveBuffer*, const std::string&, const pointing_t* pointing) {
    pointings_.push_back(*pointing);
  }
  void on_spin(const lcm::ReceiveBuffer*, const std::string&, const spin_t* spin) { spins_.push_back(*spin); }
  void on_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status) { status_ = *status; }

  std::filesystem::path folder_;
  std::string url_;
  std::unique_ptr<lcm::LCM> lcm_;
  std::unique_ptr<ChildProcess> process_;
  std::vector<pose_t> poses_;
  std::vector<pointing_t> pointings_;
  std::vector<spin_t> spins_;
  std::optional<status_t> status_;
  std::int64_t target_clock_zero_ns_ = 0;
  std::int64_t last_cycle_ticks_ = 0;
};

}  // namespace pharos::host
