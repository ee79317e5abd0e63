// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "host/support/unique_fd.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::host {

/// An image to be measured.
struct ImageJob {
  std::filesystem::path file;
  pointing::Sighting sighting;
};
struct ImageResult {
  pointing::Sighting sighting;
  std::string refusal;  ///< the word after refused_; empty where there is an answer
  std::string trouble;  ///< what it means, with the file's name; empty where there is an answer
  std::string flags;
  pointing::AxisEstimate axis;
  pointing::AxisPlanes planes_station;
};

/// A pass to be solved.
struct PassJob {
  std::vector<pointing::PassImage> images;
  pointing::PassOptions options;
};
struct PassResult {
  pointing::PassAnswer answer;
};

/// Measures in a thread of its own, one job after the other: an image costs tens of milliseconds, for which the loop's
/// lighthouse cycles must not wait. Only whole values pass between the threads.
class TelescopeWorker {
 public:
  explicit TelescopeWorker(PinholeCamera camera);
  ~TelescopeWorker();
  TelescopeWorker(const TelescopeWorker&) = delete;
  TelescopeWorker& operator=(const TelescopeWorker&) = delete;

  using Job = std::variant<ImageJob, PassJob>;
  using Done = std::variant<ImageResult, PassResult>;

  /// False where kMostWaiting jobs wait already: the job is not taken.
  bool post(Job job);
  /// Readable when there is something to take().
  int fd() const { return ready_.get(); }
  std::optional<Done> take();

  static constexpr std::size_t kMostWaiting = 512;

 private:
  void run();

  PinholeCamera camera_;
  UniqueFd ready_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  std::deque<Done> done_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace pharos::host
