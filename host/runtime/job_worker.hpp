// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "host/runtime/now.hpp"
#include "host/support/ready_event.hpp"

namespace pharos::host {

/// The refusal for a job that threw an exception; the exception's text has the details.
inline constexpr const char* kInternalError = "internal_error";

/// Runs jobs in a thread of its own, one after the other, for work of tens of milliseconds for which lighthouse cycles
/// in the event loop must not wait. The threads exchange complete values only.
template <class Job, class JobResult>
class JobWorker {
 public:
  struct Done {
    Job job;
    JobResult answer;
    std::int64_t waited_ns = 0;  // from post() until the thread began it
    std::int64_t took_ns = 0;
  };

  /// `max_waiting`: maximum number of waiting jobs, without the one in progress. `work` is called in the thread. If it
  /// throws, `failed` makes the result from the exception's text, so that one bad job does not end the daemon. Throws
  /// std::system_error if no descriptor can be created.
  JobWorker(std::size_t max_waiting, std::function<JobResult(const Job&)> work,
            std::function<JobResult(const Job&, const std::string& error)> failed)
      : max_waiting_(max_waiting), work_(std::move(work)), failed_(std::move(failed)), thread_([this] { run(); }) {}
  ~JobWorker() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  JobWorker(const JobWorker&) = delete;
  JobWorker& operator=(const JobWorker&) = delete;

  /// If too many jobs wait, the oldest is removed from the queue and returned; it will not be run.
  std::optional<Job> post(Job job) {
    std::optional<Job> discarded;
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back({std::move(job), monotonic_now_ns()});
      if (waiting_.size() > max_waiting_) {
        discarded = std::move(waiting_.front().job);
        waiting_.pop_front();
      }
    }
    unfinished_ += discarded ? 0 : 1;
    changed_.notify_one();
    return discarded;
  }
  /// Readable when a result can be taken.
  int fd() const { return ready_.fd(); }
  std::optional<Done> take() {
    const std::lock_guard lock(mutex_);
    if (done_.empty()) {
      ready_.clear();
      return std::nullopt;
    }
    Done done = std::move(done_.front());
    done_.pop_front();
    --unfinished_;
    return done;
  }
  /// True if every posted job was taken or returned.
  bool idle() const { return unfinished_ == 0; }

 private:
  struct Waiting {
    Job job;
    std::int64_t posted_ns = 0;
  };

  JobResult answer_to(const Job& job) const {
    try {
      return work_(job);
    } catch (const std::exception& error) {
      return failed_(job, error.what());
    } catch (...) {
      return failed_(job, "an exception that is none of the standard library's");
    }
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (stop_) return;
      Waiting next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      const std::int64_t began_ns = monotonic_now_ns();
      JobResult answer = answer_to(next.job);
      const std::int64_t took_ns = monotonic_now_ns() - began_ns;
      lock.lock();
      done_.push_back({std::move(next.job), std::move(answer), began_ns - next.posted_ns, took_ns});
      ready_.set();
    }
  }

  std::size_t max_waiting_;
  std::function<JobResult(const Job&)> work_;
  std::function<JobResult(const Job&, const std::string&)> failed_;
  ReadyEvent ready_;
  int unfinished_ = 0;  // used by the event loop's thread only
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  std::deque<Done> done_;
  bool stop_ = false;
  std::thread thread_;  // last member, as it uses all the others
};

}  // namespace pharos::host
