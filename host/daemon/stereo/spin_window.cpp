// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/spin_window.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/slam/spin.hpp"

namespace pharos::host {
namespace {

constexpr double kWindow_s = 20.0;
constexpr std::size_t kMaxAttitudes = 400;  // 20 s at 20 pairs/s
constexpr double kEvery_s = 1.0;
constexpr double kSigmasFromRest = 3.0;

SpinEstimate estimate_of(const slam::Spin& fit, double span_s) {
  SpinEstimate spin{fit.rate_rad_s,       fit.covariance, Vector3::Zero(), 0.0, 0.0,
                    fit.residual_rms_rad, fit.frames,     span_s};
  if (!(fit.rate() > 0.0)) return spin;
  spin.sigma_rate_rad_s = fit.sigma_rate_rad_s();
  if (fit.rate() < kSigmasFromRest * std::sqrt(fit.covariance.trace())) return spin;
  spin.axis = fit.axis();
  spin.sigma_axis_rad = fit.sigma_axis_rad();
  return spin;
}

}  // namespace

void SpinWindow::clear() { attitudes_.clear(); }

std::optional<SpinResult> SpinWindow::push(const slam::TrackedFrame& frame) {
  if (frame.placed) attitudes_.push_back(frame);
  const auto old = std::find_if(attitudes_.begin(), attitudes_.end(), [&](const slam::TrackedFrame& kept) {
    return kept.time_s >= frame.time_s - kWindow_s;
  });
  attitudes_.erase(attitudes_.begin(), old);
  if (attitudes_.size() > kMaxAttitudes) attitudes_.erase(attitudes_.begin());
  if (last_reported_s_ && frame.time_s < *last_reported_s_ + kEvery_s) return std::nullopt;
  last_reported_s_ = frame.time_s;
  if (!frame.placed) return SpinResult{frame.lost ? "lost" : "no_map", {}};
  const auto fit = slam::fit_spin(attitudes_);
  if (!fit || !fit->rate_rad_s.allFinite() || !fit->covariance.allFinite()) return SpinResult{"too_few", {}};
  return SpinResult{"", estimate_of(*fit, attitudes_.back().time_s - attitudes_.front().time_s)};
}

}  // namespace pharos::host
