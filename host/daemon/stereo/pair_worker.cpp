// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/pair_worker.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "host/daemon/now.hpp"

namespace pharos::host {

PairWorker::PairWorker(std::unique_ptr<PairEstimator> estimator)
    : estimator_(std::move(estimator)), ready_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!ready_.valid()) throw std::system_error(errno, std::generic_category(), "eventfd");
  thread_ = std::thread([this] { run(); });
}

PairWorker::~PairWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

StereoPairPtr PairWorker::post(StereoPairPtr pair) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.swap(pair);
    posted_ns_ = monotonic_now_ns();
  }
  in_hand_ += pair ? 0 : 1;
  changed_.notify_one();
  return pair;
}

std::optional<PairWorker::Done> PairWorker::take() {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) {
    std::uint64_t count = 0;
    static_cast<void>(::read(ready_.get(), &count, sizeof count) == 0);
    return std::nullopt;
  }
  Done done = std::move(done_.front());
  done_.pop_front();
  --in_hand_;
  return done;
}

void PairWorker::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || waiting_; });
    if (stop_) return;
    Done done;
    done.pair = std::exchange(waiting_, nullptr);
    const std::int64_t posted_ns = posted_ns_;
    lock.unlock();
    const std::int64_t began_ns = monotonic_now_ns();
    done.waited_ns = began_ns - posted_ns;
    done.answer = estimator_->measure(*done.pair);
    done.took_ns = monotonic_now_ns() - began_ns;
    lock.lock();
    done_.push_back(std::move(done));
    const std::uint64_t one = 1;
    static_cast<void>(::write(ready_.get(), &one, sizeof one) == sizeof one);  // full only while it is readable
  }
}

}  // namespace pharos::host
