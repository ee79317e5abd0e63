// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/network/last_time.hpp"
#include "pharos/network/linearised_sweep.hpp"
#include "pharos/network/position_fix.hpp"
#include "pharos/network/station_watch.hpp"

namespace pharos::network {

/// What each plane of each station last showed of the body: what its own errors, and its contradictions, do to a
/// position.
class SeenPlanes {
 public:
  /// A sweep that fits; `sigma_rad`: of what station and plane are wrong by.
  void saw(const LinearisedSweep& sweep, double sigma_rad);
  void saw(const FixPlane& plane, double sigma_rad);
  /// A sweep whose light does not fit: the body may be where it says.
  void refuse(const LinearisedSweep& sweep);
  /// Those of the planes that a position was found from; all.
  void forget_contradictions(const PositionFix& fix);
  void forget_contradictions();

  /// How far the refused sweeps of the last tenth of a second would move the body, m^2.
  Matrix3 contradiction_covariance(const StationMask& excluded, double time_s) const;
  /// What stations and planes are wrong by is the same in every sweep: it does not average out. Of the planes that saw
  /// the body within a tenth of a second, each off by its own sigma, a position's part of it: (J^T W J)^-1. And what
  /// the room that these stations span is deformed by at that place; or, where their joint errors are known, what each
  /// of those moves the position by. m^2.
  Matrix3 station_covariance(const Stations& stations, const StationSigmas& unstated, const StationMask& excluded,
                             double time_s, const Vector3& body_m) const;

 private:
  struct Seen {
    LastTime last;                       // sweep
    Vector3 gradient = Vector3::Zero();  // of its angle by the position then
    double sigma_rad = 0.0;
    // How far along its gradient its last sweep puts the body, where it did not fit the filter.
    Vector3 contradiction_m = Vector3::Zero();
    LastTime contradicted;
  };
  using Planes = std::array<Seen, kPlanes>;

  std::array<Planes, kMaxNetworkStations> seen_;
};

}  // namespace pharos::network
