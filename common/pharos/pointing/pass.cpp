// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/pass.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

constexpr int kPassRounds = 6;
// Squared sigmas beyond which an image contradicts the rest.
constexpr double kContradiction = 25.0;
// Standard normal deviate of 99.99 %.
constexpr double kQuantile = 3.72;
constexpr std::size_t kMinImages = 3;

// The planes of the law's own fit, and its result.
struct Fit {
  Vector3 axis = Vector3::UnitZ();  // in the law's frame, at the middle of the pass
  Matrix3 covariance = Matrix3::Zero();
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  std::optional<SpinEstimate> spin;

  Vector3 at(double seconds) const { return spin ? spin->spin.at(seconds) : axis; }
};

struct Law {
  AttitudeLaw kind = AttitudeLaw::kInertial;
  double max_spin_rad_s = 0.0;
};

Result<Fit, PassFailure> fit_planes(const PassWorkspace& workspace, const Law& law) {
  const std::span<const AxisPlane> planes(workspace.planes.data(), workspace.planes.size());
  Fit fit;
  if (law.kind != AttitudeLaw::kSpin) {
    const auto estimate = estimate_axis(planes);
    if (!estimate) return PassFailure::kTooFewImages;
    fit = {estimate->axis, estimate->covariance, estimate->chi2, estimate->degrees_of_freedom, std::nullopt};
    return fit;
  }
  const std::span<const double> seconds(workspace.seconds.data(), workspace.seconds.size());
  const auto spin = fit_spin(planes, seconds, law.max_spin_rad_s);
  if (!spin) return spin.error() == SpinFailure::kNotSeen ? PassFailure::kSpinNotSeen : PassFailure::kTooFewImages;
  fit = {spin->spin.axis, spin->axis_covariance, spin->chi2, spin->degrees_of_freedom, *spin};
  return fit;
}

double misfit(const AxisPlane& plane, const Vector3& direction) {
  const double off = plane.normal.dot(direction);
  return off * off / std::max(1e-30, direction.dot(plane.covariance * direction));
}

// Removes the images that contradict the fit, the worst first, up to `most` of them; returns how many.
int rejected(PassWorkspace& workspace, const Fit& fit, int maximum) {
  int taken = 0;
  while (taken < maximum) {
    double worst = kContradiction;
    std::int32_t image = -1;
    for (std::size_t i = 0; i < workspace.planes.size(); ++i) {
      const double now = misfit(workspace.planes[i], fit.at(workspace.seconds[i]));
      if (now <= worst) continue;
      worst = now;
      image = workspace.image[i];
    }
    if (image < 0) break;
    for (std::size_t i = workspace.planes.size(); i-- > 0;) {
      if (workspace.image[i] != image) continue;
      workspace.planes.erase_unordered(i);
      workspace.seconds.erase_unordered(i);
      workspace.image.erase_unordered(i);
    }
    ++taken;
  }
  return taken;
}

// Half a rotation between two images is not observable: the axis has no sign.
double tellable_spin(const PassWorkspace& workspace, double max_spin_rad_s) {
  double longest = 0.0;
  for (std::size_t i = 1; i < workspace.seconds.size(); ++i) {
    longest = std::max(longest, workspace.seconds[i] - workspace.seconds[i - 1]);
  }
  return longest > 0.0 ? std::min(max_spin_rad_s, 0.25 * kTwoPi / longest) : max_spin_rad_s;
}

struct Gathered {
  std::optional<PassFailure> failure;
  std::optional<Orbit> orbit;
  double epoch_s = 0.0;
  int images = 0;
};

Gathered gather(std::span<const PassImage> images, const PassOptions& options, PassWorkspace& workspace) {
  workspace.planes.clear();
  workspace.seconds.clear();
  workspace.image.clear();
  workspace.observations.clear();
  Gathered gathered;
  for (const PassImage& image : images) {
    if (image.planes_station.empty()) continue;
    if (!workspace.observations.push_back(image.observation)) gathered.failure = PassFailure::kTooManyImages;
  }
  if (workspace.observations.size() < kMinImages) gathered.failure = PassFailure::kTooFewImages;
  if (gathered.failure) return gathered;
  const auto& observations = workspace.observations;
  gathered.epoch_s = observations[0].time_s + 0.5 * (observations.back().time_s - observations[0].time_s);
  if (options.law == AttitudeLaw::kNadir) {
    const auto orbit = find_orbit({observations.data(), observations.size()}, options.station, gathered.epoch_s);
    if (!orbit) {
      gathered.failure = PassFailure::kNoOrbit;
      return gathered;
    }
    gathered.orbit = *orbit;
  }
  const Matrix3 R_earth_station = station_to_earth(options.station);
  for (const PassImage& image : images) {
    if (image.planes_station.empty()) continue;
    const double seconds = image.observation.time_s - gathered.epoch_s;
    Matrix3 R = earth_to_inertial(seconds) * R_earth_station;
    if (gathered.orbit)
      R = inertial_to_orbital(*gathered.orbit, image.observation, options.station, gathered.epoch_s) * R;
    for (const AxisPlane& plane : image.planes_station) {
      if (!workspace.planes.push_back(rotated(plane, R))) gathered.failure = PassFailure::kTooManyImages;
      workspace.seconds.push_back(seconds);
      workspace.image.push_back(gathered.images);
    }
    ++gathered.images;
  }
  return gathered;
}

// R_S_law in the middle of the pass.
Matrix3 law_to_station(const Gathered& gathered, const PassOptions& options, const Observation& middle) {
  const Matrix3 R_station_inertial = station_to_earth(options.station).transpose();
  if (!gathered.orbit) return R_station_inertial;
  return R_station_inertial *
         inertial_to_orbital(*gathered.orbit, middle, options.station, gathered.epoch_s).transpose();
}

// Between the two sightings around the middle of the pass, as a line of sight moves in so short a time.
Observation middle_observation(const PassWorkspace& workspace, double epoch_s) {
  const auto& observations = workspace.observations;
  std::size_t after = 1;
  while (after + 1 < observations.size() && observations[after].time_s < epoch_s) ++after;
  const Observation &from = observations[after - 1], &to = observations[after];
  const double fraction = to.time_s > from.time_s ? (epoch_s - from.time_s) / (to.time_s - from.time_s) : 0.0;
  const Vector3 d = (1.0 - fraction) * direction_station(from.sight) + fraction * direction_station(to.sight);
  Observation middle{epoch_s, {std::atan2(d.x(), d.y()), std::atan2(d.z(), std::hypot(d.x(), d.y()))}, 0.0};
  if (from.range_m > 0.0 && to.range_m > 0.0) middle.range_m = (1.0 - fraction) * from.range_m + fraction * to.range_m;
  return middle;
}

}  // namespace

const char* name_of(AttitudeLaw law) {
  switch (law) {
    case AttitudeLaw::kInertial:
      return "inertial";
    case AttitudeLaw::kNadir:
      return "nadir";
    case AttitudeLaw::kSpin:
      return "spin";
  }
  return "";
}

const char* name_of(PassFailure failure) {
  switch (failure) {
    case PassFailure::kTooFewImages:
      return "too_few_images";
    case PassFailure::kTooManyImages:
      return "too_many_images";
    case PassFailure::kNoOrbit:
      return "no_orbit";
    case PassFailure::kLawDoesNotFit:
      return "law_does_not_fit";
    case PassFailure::kSpinNotSeen:
      return "spin_not_seen";
  }
  return "";
}

bool is_fitting(double chi2, int degrees_of_freedom) {
  if (degrees_of_freedom <= 0) return true;
  const double k = degrees_of_freedom;
  if (chi2 <= kFittingChi2 * k) return true;
  const double spread = 2.0 / (9.0 * k);
  return (std::cbrt(chi2 / k) - (1.0 - spread)) / std::sqrt(spread) <= kQuantile;
}

PassSolution estimate_pass(std::span<const PassImage> images, const PassOptions& options, PassWorkspace& workspace) {
  PassSolution answer;
  PassEstimate& estimate = answer.estimate;
  const Gathered gathered = gather(images, options, workspace);
  estimate.time_s = gathered.epoch_s;
  estimate.images = gathered.images;
  estimate.orbit = gathered.orbit;
  answer.failure = gathered.failure;
  if (answer.failure) return answer;
  const Law law{options.law, tellable_spin(workspace, options.max_spin_rad_s)};
  const int max_rejected = static_cast<int>(kMaxRejectedFraction * gathered.images);
  auto fit = fit_planes(workspace, law);
  for (int round = 0; round < kPassRounds && fit && !is_fitting(fit->chi2, fit->degrees_of_freedom); ++round) {
    const int taken =
        rejected(workspace, *fit, std::min(max_rejected - estimate.rejected, 1 + max_rejected / kPassRounds));
    if (taken == 0) break;
    estimate.rejected += taken;
    fit = fit_planes(workspace, law);
  }
  if (!fit) {
    answer.failure = fit.error();
    return answer;
  }
  estimate.images -= estimate.rejected;
  estimate.chi2 = fit->chi2;
  estimate.degrees_of_freedom = fit->degrees_of_freedom;
  if (!is_fitting(fit->chi2, fit->degrees_of_freedom)) {
    answer.failure = PassFailure::kLawDoesNotFit;
    return answer;
  }
  const double widening = fit->degrees_of_freedom > 0 ? std::max(1.0, fit->chi2 / fit->degrees_of_freedom) : 1.0;
  const Matrix3 R = law_to_station(gathered, options, middle_observation(workspace, gathered.epoch_s));
  estimate.axis_law = fit->axis;
  estimate.axis_station = signed_axis(R * fit->axis);
  if (estimate.axis_station.dot(R * fit->axis) < 0.0) estimate.axis_law = -fit->axis;
  estimate.covariance_station = widening * R * fit->covariance * R.transpose();
  estimate.spin = fit->spin;
  if (fit->spin && fit->spin->second) estimate.second_axis_station = signed_axis(R * fit->spin->second->axis);
  return answer;
}

}  // namespace pharos::pointing
