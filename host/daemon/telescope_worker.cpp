// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/telescope_worker.hpp"

#include <sys/eventfd.h>

#include <cerrno>
#include <cstdint>
#include <memory>
#include <system_error>
#include <utility>

#include "host/images/grey_image.hpp"
#include "host/support/flag_text.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/line/measure_panel.hpp"

namespace pharos::host {
namespace {

ImageResult measured(const ImageJob& job, const PinholeCamera& camera) {
  ImageResult result;
  result.sighting = job.sighting;
  try {
    const GreyImage image = read_grey_image(job.file.string());
    const auto panel = line::measure_panel(image.view(), camera);
    if (!panel) {
      result.refusal = line::name_of(panel.error());
      result.trouble = job.file.string() + ": " + line::advice_of(panel.error());
      return result;
    }
    const line::LineAnswer answer = line::answer_of(*panel, job.sighting.sight);
    result.axis = answer.axis;
    result.planes_station = answer.planes_station;
    result.flags = joined_flags(answer.flags, line::kLineFlagWords);
  } catch (const InputError& error) {
    result.refusal = "unreadable";
    result.trouble = error.what();
  }
  return result;
}

PassResult solved(const PassJob& job) {
  const auto workspace = std::make_unique<pointing::PassWorkspace>();
  return {pointing::estimate_pass(job.images, job.options, *workspace)};
}

}  // namespace

TelescopeWorker::TelescopeWorker(PinholeCamera camera)
    : camera_(camera), ready_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!ready_.valid()) throw std::system_error(errno, std::generic_category(), "eventfd");
  thread_ = std::thread([this] { run(); });
}

TelescopeWorker::~TelescopeWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

bool TelescopeWorker::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return false;
    waiting_.push_back(std::move(job));
  }
  changed_.notify_one();
  return true;
}

std::optional<TelescopeWorker::Done> TelescopeWorker::take() {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) {
    std::uint64_t count = 0;
    static_cast<void>(::read(ready_.get(), &count, sizeof count) == 0);
    return std::nullopt;
  }
  Done done = std::move(done_.front());
  done_.pop_front();
  return done;
}

void TelescopeWorker::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    Done done = std::holds_alternative<ImageJob>(job) ? Done(measured(std::get<ImageJob>(job), camera_))
                                                      : Done(solved(std::get<PassJob>(job)));
    lock.lock();
    done_.push_back(std::move(done));
    const std::uint64_t one = 1;
    static_cast<void>(::write(ready_.get(), &one, sizeof one) == sizeof one);  // full only while it is readable
  }
}

}  // namespace pharos::host
