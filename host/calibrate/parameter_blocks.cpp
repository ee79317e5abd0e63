// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/parameter_blocks.hpp"

#include <cstdio>

namespace pharos::calibrate {
namespace {

std::string station_name(std::uint32_t id) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "station %08X", static_cast<unsigned>(id));
  return text.data();
}

void add_pair(const BundleProblem& problem, const ParameterBlocks& blocks, std::vector<Parameter>& parameters) {
  const std::string name = station_name(problem.nominal.station[1].id);
  const auto moved = problem.nominal.T_reference_station[1]->moved_by(Vector6(blocks.station_delta.data()));
  const Vector3 turn = rotation_log(moved.R);
  constexpr std::array<const char*, 3> kTurn = {" turn_x_rad", " turn_y_rad", " turn_z_rad"};
  constexpr std::array<const char*, 3> kPlace = {" x_m", " y_m", " z_m"};
  for (std::size_t i = 0; i < 3; ++i) {
    parameters.push_back({name + kTurn[i], 0.0, turn[static_cast<Eigen::Index>(i)], 0.0, 0.0});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    parameters.push_back({name + kPlace[i], 0.0, moved.t[static_cast<Eigen::Index>(i)], 0.0, 0.0});
  }
}

}  // namespace

std::size_t index_in(const Target& target, std::uint8_t sensor) {
  std::size_t i = 0;
  while (i < target.size() && target[i].sensor != sensor) ++i;
  return i;
}

ParameterBlocks::ParameterBlocks(const BundleProblem& problem) : hit(problem.nominal.target.size(), false) {
  for (const SensorPlacement& placement : problem.nominal.target) {
    sensor.push_back({placement.position_m.x(), placement.position_m.y(), placement.position_m.z()});
  }
  for (const lighthouse::StationCalibration& station : problem.nominal.station) {
    rotor.push_back({parameters_of(station.rotor[0]), parameters_of(station.rotor[1])});
  }
  pair = problem.nominal.station.size() > 1 && problem.nominal.T_reference_station[1].has_value();
  for (const StationaryAverage& interval : *problem.intervals) {
    pose_delta.push_back({});
    common.emplace_back(interval.rotors.size(), 0.0);
    for (const RotorView& view : interval.rotors) {
      for (const MeanBearing& bearing : view.bearings) hit[index_in(problem.nominal.target, bearing.sensor)] = true;
    }
  }
}

Unknowns ParameterBlocks::unknowns(const BundleProblem& problem) const {
  Unknowns out = problem.nominal;
  for (std::size_t i = 0; i < sensor.size(); ++i) out.target[i].position_m = Vector3(sensor[i].data());
  for (std::size_t s = 0; s < rotor.size(); ++s) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) out.station[s].rotor[axis] = rotor_of(rotor[s][axis]);
  }
  if (pair) out.T_reference_station[1] = out.T_reference_station[1]->moved_by(Vector6(station_delta.data()));
  for (std::size_t i = 0; i < pose_delta.size(); ++i) {
    out.T_home_body[i] = out.T_home_body[i].moved_by(Vector6(pose_delta[i].data()));
  }
  return out;
}

std::vector<Parameter> parameters_of(const BundleProblem& problem, const ParameterBlocks& blocks) {
  std::vector<Parameter> parameters;
  constexpr std::array<const char*, 3> kAxis = {" x_m", " y_m", " z_m"};
  for (std::size_t i = 0; i < blocks.sensor.size(); ++i) {
    const SensorPlacement& nominal = problem.nominal.target[i];
    for (std::size_t k = 0; k < 3; ++k) {
      parameters.push_back({"sensor " + std::to_string(nominal.sensor) + kAxis[k],
                            nominal.position_m[static_cast<Eigen::Index>(k)], blocks.sensor[i][k], 0.0, 0.0});
    }
  }
  for (std::size_t s = 0; s < blocks.rotor.size(); ++s) {
    const lighthouse::StationCalibration& nominal = problem.nominal.station[s];
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const auto a = static_cast<std::size_t>(index_of(axis));
      const RotorParameters prior = parameters_of(nominal.rotor[a]);
      for (std::size_t k = 0; k < kRotorParameters; ++k) {
        parameters.push_back({station_name(nominal.id) + " rotor " + name_of(axis) + " " + kRotorParameterNames[k],
                              prior[k], blocks.rotor[s][a][k], 0.0, 0.0});
      }
    }
  }
  if (blocks.pair) add_pair(problem, blocks, parameters);
  return parameters;
}

}  // namespace pharos::calibrate
