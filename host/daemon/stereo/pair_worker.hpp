// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "host/daemon/stereo/pair_estimator.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Measures pairs in a thread of its own: one is worked on, one may wait, and the newest wins. A pair costs tens of
/// milliseconds, for which the loop's lighthouse cycles must not wait, and a queue would only make poses older.
class PairWorker {
 public:
  /// Throws std::system_error where the kernel gives no descriptor.
  explicit PairWorker(std::unique_ptr<PairEstimator> estimator);
  ~PairWorker();
  PairWorker(const PairWorker&) = delete;
  PairWorker& operator=(const PairWorker&) = delete;

  struct Done {
    StereoPairPtr pair;
    PairAnswer answer;
    std::int64_t waited_ns = 0;  // for the thread, from when it was posted
    std::int64_t took_ns = 0;
  };

  /// Gives back the pair that waited and never will be measured, where there was one.
  StereoPairPtr post(StereoPairPtr pair);
  /// Readable when there is something to take().
  int fd() const { return ready_.get(); }
  std::optional<Done> take();
  /// Pairs posted and not yet taken or given back.
  bool idle() const { return in_hand_ == 0; }

 private:
  void run();

  std::unique_ptr<PairEstimator> estimator_;
  UniqueFd ready_;
  int in_hand_ = 0;  // of the loop alone
  std::mutex mutex_;
  std::condition_variable changed_;
  StereoPairPtr waiting_;
  std::int64_t posted_ns_ = 0;
  std::deque<Done> done_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace pharos::host
