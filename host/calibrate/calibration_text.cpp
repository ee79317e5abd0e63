// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>

#include "host/calibrate/calibration_file.hpp"
#include "host/support/exact_number.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

using host::exact_list;
using host::exact_number;

std::array<double, 3> array_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::string quoted_id(std::uint32_t id) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "\"%08X\"", static_cast<unsigned>(id));
  return text.data();
}

std::string summary_text(const LighthouseCalibration& calibration) {
  const BundleResult& bundle = calibration.bundle;
  std::string out = "# Written by `pharos calibrate lighthouse`, for `pharos track --calibration` and for pharosd.\n";
  out += "[calibration]\n";
  out += std::string("scale = ") + (calibration.scale_measured ? "\"measured\"" : "\"prior\"") +
         "  # \"prior\": nobody measured a length, the size is the nominal one\n";
  out += "scale_sigma = " + exact_number(bundle.scale_sigma) +
         "  # relative, of the target's size: part of every range's sigma\n";
  out += "model_form = " + std::to_string(static_cast<int>(calibration.form)) + "\n";
  out += "stills = " + std::to_string(calibration.intervals) + "\n";
  out += "poses = " + std::to_string(calibration.poses) + "\n";
  out += "unmodelled_arcsec = " + exact_number(calibration.unmodelled_rad * kArcsecPerRad) +
         "  # left in every mean angle beyond its noise\n";
  out += "body_frame = \"the sensors that were hit lie on their nominal positions by least squares\"\n";
  out += "parameters = [\n";
  for (const Parameter& parameter : bundle.parameters) out += "  \"" + parameter.name + "\",\n";
  out += "]\ncovariance = [\n";
  for (Eigen::Index i = 0; i < bundle.covariance.rows(); ++i) {
    const Eigen::VectorXd row = bundle.covariance.row(i);
    out += "  " + exact_list(row) + ",\n";
  }
  return out + "]\n";
}

std::string sensor_text(const BundleResult& bundle, std::size_t index, const Target& nominal) {
  const SensorPlacement& sensor = bundle.unknowns.target[index];
  const std::array<double, 3> sigma = {bundle.parameters[3 * index].sigma, bundle.parameters[3 * index + 1].sigma,
                                       bundle.parameters[3 * index + 2].sigma};
  std::string out = "\n[[sensor]]\nsensor = " + std::to_string(sensor.sensor) + "\n";
  out += "position_m = " + exact_list(array_of(sensor.position_m)) + "\n";
  out += "sigma_m = " + exact_list(sigma) + "\n";
  out += "nominal_m = " + exact_list(array_of(nominal[index].position_m)) + "\n";
  if (sensor.has_normal()) out += "normal = " + exact_list(array_of(sensor.normal)) + "\n";
  return out;
}

std::string pair_text(const Unknowns& unknowns) {
  const ReferenceFromStation& T = *unknowns.T_reference_station[1];
  const Quaternion q = T.quaternion();
  const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
  return "\n# The second station's pose in the reference's frame: p_reference = R p_station + position.\n[[pair]]\n"
         "reference = " +
         quoted_id(unknowns.station[0].id) + "\nstation = " + quoted_id(unknowns.station[1].id) +
         "\norientation_wxyz = " + exact_list(wxyz) + "\nposition_m = " + exact_list(array_of(T.t)) + "\n";
}

}  // namespace

std::string calibration_text(const LighthouseCalibration& calibration, const Target& nominal) {
  const Unknowns& unknowns = calibration.bundle.unknowns;
  std::string out = summary_text(calibration);
  for (const lighthouse::StationCalibration& station : unknowns.station) out += "\n" + host::station_text(station);
  for (std::size_t i = 0; i < nominal.size(); ++i) out += sensor_text(calibration.bundle, i, nominal);
  if (unknowns.T_reference_station.size() > 1 && unknowns.T_reference_station[1]) out += pair_text(unknowns);
  return out;
}

}  // namespace pharos::calibrate
