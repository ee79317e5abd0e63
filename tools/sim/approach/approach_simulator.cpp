// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_simulator.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/sim/approach/fault_injection.hpp"
#include "tools/sim/approach/source_errors.hpp"

namespace pharos::sim {
namespace {

using host::MountingOrigin;
using host::SourceKind;

constexpr double kAmbiguousRange = 9.21;  // DESIGN: ambiguous below this difference in chi-squared

Matrix6 diagonal(double sigma_deg, double sigma_mm) {
  Vector6 variance;
  variance.head<3>().setConstant(std::pow(sigma_deg * kRadPerDeg, 2));
  variance.tail<3>().setConstant(std::pow(sigma_mm / kMmPerM, 2));
  return variance.asDiagonal();
}

// The pose that a calibration with this covariance found: T_true = T.moved_by(delta).
template <class PoseType>
host::MountingPose calibrated(const PoseType& truth, const Matrix6& covariance, RandomStream& random) {
  const Vector6 delta = covariance.diagonal().cwiseSqrt().cwiseProduct(normal6(random));
  host::MountingPose out;
  out.origin = MountingOrigin::kEstimated;
  out.covariance = covariance;
  out.set(PoseType{rotation_exp(-delta.head<3>()) * truth.R, truth.t - delta.tail<3>()});
  return out;
}

template <class PoseType>
host::MountingPose given(const PoseType& truth) {
  host::MountingPose out;
  out.origin = MountingOrigin::kGiven;
  out.set(truth);
  return out;
}

// The slow error beside the white noise, both of an axis: at every range the same, but in the sun's glare.
std::optional<host::SlowError> slow_error_of(const ApproachSource& source) {
  const RangeNoise& noise = source.noise;
  const double rotation_deg =
      source.has_turn ? std::sqrt((2.0 * noise.tilt_deg * noise.tilt_deg + noise.turn_deg * noise.turn_deg) / 3.0)
                      : noise.tilt_deg;
  const double position_mm =
      std::sqrt((2.0 * noise.lateral_mm * noise.lateral_mm + noise.depth_mm * noise.depth_mm) / 3.0);
  if (!(rotation_deg > 0.0 && position_mm > 0.0)) return std::nullopt;
  return host::SlowError{source.bias.rotation_deg / rotation_deg, source.bias.position_mm / position_mm,
                         source.bias.time_constant_s};
}

// One measurement with noise; the second solution where there is one.
class Noise {
 public:
  Noise(const ApproachSource& source, std::uint64_t seed)
      : source_(source),
        slow_random_(seed, "slow " + source.name),
        random_(seed, "white " + source.name),
        slow_(source, slow_random_) {}

  void apply(ApproachMeasurement& m, const Vector3& p_noise, double ratio) {
    slow_.advance(m.true_time_s, slow_random_);
    const PoseNoise white = white_noise(source_, m.pose, p_noise, ratio);
    const Vector6 slow = slow_.error(range_factor(source_.noise, (m.pose * p_noise).norm()));
    // The slow error is the sensor's: the point p_noise moves by its translation.
    Vector6 delta = white.root * normal6(random_);
    delta.head<3>() += slow.head<3>();
    delta.tail<3>() += slow.tail<3>() - slow.head<3>().cross(m.pose.R * p_noise);
    m.pose = m.pose.moved_by(delta);
    m.pose.t *= slow_.scale();
    m.covariance = white.covariance();
    const double chance = random_.uniform(), chi2 = random_.uniform(0.0, kAmbiguousRange);
    if (source_.ambiguous_beyond_m && m.pose.t.norm() > *source_.ambiguous_beyond_m) {
      make_ambiguous(m, chance, chi2, 3.0 * std::sqrt(m.covariance.topLeftCorner<3, 3>().trace()));
    }
    m.has_turn = source_.has_turn;
    if (m.has_turn) return;
    m.pose = without_turn(m.pose);
    if (m.second) m.second = without_turn(*m.second);
  }

 private:
  // The first solution is the wrong one as often as its likelihood says.
  static void make_ambiguous(ApproachMeasurement& m, double chance, double chi2, double min_angle_rad) {
    m.second = mirrored(m.pose, min_angle_rad);
    if (!m.second) return;
    m.delta_chi2 = chi2;
    if (chance < 1.0 / (1.0 + std::exp(0.5 * chi2))) std::swap(m.pose, *m.second);
  }

  const ApproachSource& source_;
  RandomStream slow_random_, random_;
  SlowErrors slow_;
};

}  // namespace

ApproachSimulator::ApproachSimulator(const ApproachScenario& scenario, std::uint64_t seed)
    : scenario_(scenario), seed_(seed), truth_(scenario.motion, seed) {
  make_mountings();
  draw_faults();
}

void ApproachSimulator::make_mountings() {
  for (const ApproachSource& source : scenario_.sources) {
    RandomStream random(seed_, "mounting " + source.name);
    const bool slam = source.kind == SourceKind::kSlam;
    // Slam's feature frame is the camera's at its first image.
    const host::TargetFromFeature T_target_feature =
        slam ? [&] {
          const auto first = truth_.at(source.time_offset_s).inverse() * source.T_vehicle_sensor;
          return host::TargetFromFeature{first.R, first.t};
        }()
             : source.T_target_feature;
    host::SourceMounting exact;
    exact.name = source.name;
    exact.kind = source.kind;
    exact.T_vehicle_sensor = given(source.T_vehicle_sensor);
    exact.T_target_feature = given(T_target_feature);
    exact.time_offset_s = source.time_offset_s;
    exact.time_offset_origin = MountingOrigin::kGiven;
    if (!slam) exact.slow_error = slow_error_of(source);
    host::SourceMounting stated = exact;
    stated.scale_sigma = source.scale_sigma;
    const double time_error = random.normal();
    if (!source.given) {
      stated.T_vehicle_sensor =
          calibrated(source.T_vehicle_sensor, diagonal(source.mounting_sigma_deg, source.mounting_sigma_mm), random);
      stated.T_target_feature =
          calibrated(T_target_feature, diagonal(source.feature_sigma_deg, source.feature_sigma_mm), random);
      stated.time_offset_s += source.time_sigma_s * time_error;
      stated.time_offset_sigma_s = source.time_sigma_s;
      stated.time_offset_origin = MountingOrigin::kEstimated;
    }
    if (slam) stated.T_target_feature.reset();
    true_mounting_.sources.push_back(exact);
    calibrated_mounting_.sources.push_back(stated);
  }
}

void ApproachSimulator::draw_faults() {
  RandomStream random(seed_, "faults");
  for (const ApproachFault& fault : scenario_.faults) {
    DrawnFault drawn;
    for (std::size_t i = 0; i < scenario_.sources.size(); ++i) {
      if (scenario_.sources[i].name == fault.source) drawn.source = i;
    }
    drawn.kind = fault.kind;
    drawn.from_s = random.uniform(fault.at_low_s, fault.at_high_s);
    drawn.to_s = drawn.from_s + fault.for_s;
    drawn.amount = random.uniform(fault.amount_low, fault.amount_high);
    faults_.push_back(drawn);
  }
}

std::vector<ApproachSight> ApproachSimulator::sights(std::size_t index) const {
  const ApproachSource& source = scenario_.sources[index];
  const host::SourceMounting& mounting = true_mounting_.sources[index];
  const auto T_sensor_vehicle = mounting.vehicle_from_sensor().inverse();
  const host::TargetFromFeature T_target_feature = *mounting.target_from_feature();
  RandomStream timing(seed_, "timing " + source.name);
  Visibility visibility(scenario_, index, seed_);
  std::vector<ApproachSight> out(static_cast<std::size_t>(scenario_.motion.duration_s * source.rate_hz));
  for (std::size_t i = 0; i < out.size(); ++i) {
    ApproachSight& at = out[i];
    at.time_s = static_cast<double>(i) / source.rate_hz;
    at.true_time_s = at.time_s + source.time_offset_s;
    at.arrival_s = at.true_time_s + source.delay_s + source.delay_jitter_s * timing.uniform();
    const auto T_sensor_target = T_sensor_vehicle * truth_.at(at.true_time_s);
    at.pose = T_sensor_target * T_target_feature;
    at.sight = visibility.at(at.true_time_s, T_sensor_target);
    if (at.true_time_s < scenario_.from_s || at.true_time_s > scenario_.to_s) at.sight = Sight::kOutside;
  }
  return out;
}

std::vector<ApproachMeasurement> ApproachSimulator::measure(std::size_t index) const {
  const ApproachSource& source = scenario_.sources[index];
  const auto T_feature_target = true_mounting_.sources[index].target_from_feature()->inverse();
  const Vector3 p_noise = source.kind == SourceKind::kSlam ? T_feature_target.t : Vector3::Zero();
  Noise noise(source, seed_);
  std::vector<ApproachMeasurement> out;
  for (const ApproachSight& at : sights(index)) {
    ApproachMeasurement m;
    m.source = index;
    m.time_s = at.time_s;
    m.true_time_s = at.true_time_s;
    m.arrival_s = at.arrival_s;
    m.pose = at.pose;
    m.seen = at.sight == Sight::kSeen;
    // Drawn always, so that an outage changes nothing else.
    noise.apply(m, p_noise, noise_ratio(scenario_, index, m.true_time_s));
    if (at.sight != Sight::kOutside) out.push_back(m);
  }
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (faults_[i].source == index) inject(faults_[i], scenario_.faults[i].ramp_s, seed_ + i, out);
  }
  return out;
}

std::vector<ApproachMeasurement> ApproachSimulator::measure_all() const {
  std::vector<ApproachMeasurement> all;
  for (std::size_t i = 0; i < scenario_.sources.size(); ++i) {
    const std::vector<ApproachMeasurement> own = measure(i);
    all.insert(all.end(), own.begin(), own.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.arrival_s < b.arrival_s; });
  return all;
}

}  // namespace pharos::sim
