// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/station.hpp"

namespace pharos::network {
namespace {

// Leaves the smaller residual on real stations (lighthouse/station_model.hpp).
constexpr lighthouse::ModelForm kForm = lighthouse::ModelForm::kForm1;

Axis axis_of(std::size_t plane) { return plane == 0 ? Axis::kX : Axis::kY; }

lighthouse::StationCalibration lh1_calibration(const Station& station) {
  lighthouse::StationCalibration calibration;
  calibration.id = station.id;
  for (std::size_t k = 0; k < kPlanes; ++k) {
    const lighthouse::PlaneCalibration& plane = station.plane[k];
    calibration.rotor[k] = {plane.phase_rad, plane.tilt_rad, plane.curve, plane.gibbous_phase_rad,
                            plane.gibbous_magnitude_rad};
  }
  return calibration;
}

}  // namespace

const Station* find_station(const Stations& stations, std::uint8_t number) {
  for (const Station& station : stations) {
    if (station.number == number) return &station;
  }
  return nullptr;
}

double raw_angle(const Station& station, std::size_t plane, const Vector3& p_station) {
  if (station.generation == Generation::kLighthouse2) {
    return lighthouse::lh2_angle(station.plane[plane], plane, p_station);
  }
  return lighthouse::raw_theta(lh1_calibration(station), kForm, axis_of(plane), p_station);
}

Vector3 ideal_gradient(Generation generation, std::size_t plane, const Vector3& p) {
  if (generation == Generation::kLighthouse2) return lighthouse::ideal_lh2_angle(plane, p).gradient;
  // theta = pi/2 - atan2(p[plane], z)
  const auto along = static_cast<Eigen::Index>(plane);
  const double inverse_square = 1.0 / (p[along] * p[along] + p.z() * p.z());
  Vector3 gradient = Vector3::Zero();
  gradient[along] = -p.z() * inverse_square;
  gradient.z() = p[along] * inverse_square;
  return gradient;
}

std::optional<Vector3> direction_of(const Station& station, const lighthouse::PlaneAngles& raw_rad) {
  if (station.generation == Generation::kLighthouse2) {
    return lighthouse::lh2_direction({station.id, station.plane}, raw_rad);
  }
  const auto ideal = lighthouse::ideal_from_raw(lh1_calibration(station), kForm, {raw_rad[0], raw_rad[1]});
  if (!ideal) return std::nullopt;
  return lighthouse::direction_of(*ideal);
}

}  // namespace pharos::network
