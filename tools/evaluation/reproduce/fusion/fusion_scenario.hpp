// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/settings.hpp"
#include "tools/sim/measurements/measured_world.hpp"

namespace pharos::tools {

/// Two metres from docking: lighthouse, tof, ring2 without roll, slam without origin, as the measurement-level runs see
/// them.
sim::WorldSettings close_range_world(std::uint64_t seed);

/// Settings of the fusion that know the world's densities, mountings and sigmas; every fault is expected
/// `faults_per_hour` times an hour.
fusion::Settings settings_of(const sim::WorldSettings& world, double faults_per_hour);

/// A simulated pose as the fusion takes it.
fusion::Measurement measurement_of(const sim::SimulatedPose& pose);

}  // namespace pharos::tools
