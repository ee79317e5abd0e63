// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/ring2_kind.hpp"

#include <cmath>

#include "host/images/grey_image.hpp"
#include "host/vision/ring2/ring2_detector.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"
#include "tools/sim/optics/tone_curve.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/ring2/random_target.hpp"
#include "tools/sim/ring2/ring2_writer.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0, kTolerance_mm = 10.0;
// The rule of availability.
constexpr double kMaxSunIncidence_rad = 65.0 * kRadPerDeg;
constexpr double kMinNozzleMinor_px = 15.0;

bool is_answerable(const sim::RandomTarget& target) {
  return target.in_both_images && !target.has_twin && !target.is_crossed &&
         target.sun_incidence_rad < kMaxSunIncidence_rad && target.nozzle_minor_px > kMinNozzleMinor_px;
}

double angle_deg(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegPerRad; }

std::array<host::GreyImage, 2> images_of(const sim::RandomTarget& target, std::uint64_t seed, double tone_power) {
  std::array<host::GreyImage, 2> images = {sim::image_of(target, 0, seed), sim::image_of(target, 1, seed)};
  for (host::GreyImage& image : images) sim::apply_tone_curve(image, tone_power);
  return images;
}

IntegrityTrial trial_of(std::uint64_t seed, double tone_power) {
  const sim::RandomTarget target = sim::random_target(seed);
  const std::array<host::GreyImage, 2> images = images_of(target, seed, tone_power);
  host::Ring2Detector detector(ring2::core_rig(target.rig), {});
  const host::Ring2Detection found = detector.find({images[0].view(), images[1].view()});
  IntegrityTrial trial;
  trial.answerable = is_answerable(target);
  if (!found.estimate) {
    trial.status = "refused_" + found.refusal;
    return trial;
  }
  const ring2::Ring2Estimate& e = *found.estimate;
  trial.status = e.ambiguous() ? "ambiguous" : "ok";
  trial.deviations.push_back(
      {"attitude, deg", angle_deg(e.normal, target.truth.normal), e.sigma_normal_rad() * kDegPerRad, kTolerance_deg});
  if ((e.unobservable & (ring2::kUnobservableRing | ring2::kUnobservableScale)) == 0) {
    trial.deviations.push_back({"position, mm", kMmPerM * (e.ring_centre_m - target.truth.ring_centre_m).norm(),
                                kMmPerM * std::sqrt(e.covariance.block<3, 3>(2, 2).trace()), kTolerance_mm});
  }
  return trial;
}

void write_pair(std::uint64_t seed, const std::filesystem::path& folder, double tone_power) {
  const sim::RandomTarget target = sim::random_target(seed);
  const std::array<host::GreyImage, 2> images = images_of(target, seed, tone_power);
  sim::make_output_folder(folder);
  sim::write_output(folder / "rig.toml", sim::rig_text_of(target.rig));
  host::write_grey_png((folder / "left.png").string(), images[0].view(), 8);
  host::write_grey_png((folder / "right.png").string(), images[1].view(), 8);
}

}  // namespace

IntegrityKind ring2_kind() {
  return {
      "ring2",
      "ring and nozzle are whole in both images, the nozzle's semi-minor axis above 15 px, the sun within 65 deg of "
      "the ring's normal, no boom across it and no second ring with a nozzle",
      [](std::uint64_t seed) { return trial_of(seed, 1.0); }, write_pair,
      [](std::uint64_t seed) { return trial_of(seed, sim::tone_power(seed)); }};
}

}  // namespace pharos::tools
