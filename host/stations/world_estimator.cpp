// SPDX-License-Identifier: Apache-2.0
#include "host/stations/world_estimator.hpp"

#include <algorithm>
#include <limits>

namespace pharos::host {
namespace {

// A sweep is reported at the latest 1 ms after its last hit, and lasts 1 to 2 ms.
constexpr double kOrder_s = 0.004;

}  // namespace

WorldEstimator::WorldEstimator(const network::Stations& stations, const Target& target)
    : stations_(stations), target_(target) {
  restart();
}

void WorldEstimator::restart() {
  tracker_ = std::make_unique<network::NetworkTracker>(stations_, target_, network::NetworkOptions{});
  waiting_.clear();
  any_ = false;
}

void WorldEstimator::push(const lighthouse::Lh2Sweep& sweep) {
  for (const lighthouse::Lh2Hit& hit : sweep.hits) {
    PlacedHit placed;
    placed.hit = {lh2_hit_time(sweep, hit), hit.sensor, lh2_hit_angle(sweep, hit)};
    placed.station = sweep.channel;
    placed.plane = sweep.plane;
    if (any_ && placed.hit.time_s < used_s_) {
      ++hits_late_;
      continue;
    }
    newest_s_ = any_ ? std::max(newest_s_, placed.hit.time_s) : placed.hit.time_s;
    if (!any_) used_s_ = placed.hit.time_s - kOrder_s;
    any_ = true;
    waiting_.insert(placed);
  }
  use_until(newest_s_ - kOrder_s);
}

void WorldEstimator::flush() {
  use_until(std::numeric_limits<double>::infinity());
  while (const auto result = tracker_->flush()) results_.push_back(*result);
}

void WorldEstimator::use_until(double time_s) {
  while (!waiting_.empty() && waiting_.begin()->hit.time_s <= time_s) {
    const PlacedHit& first = *waiting_.begin();
    used_s_ = first.hit.time_s;
    if (const auto result = tracker_->push(first.station, first.plane, first.hit)) results_.push_back(*result);
    waiting_.erase(waiting_.begin());
  }
}

std::optional<network::NetworkResult> WorldEstimator::next() {
  if (results_.empty()) return std::nullopt;
  const network::NetworkResult result = results_.front();
  results_.pop_front();
  return result;
}

}  // namespace pharos::host
