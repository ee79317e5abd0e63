// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluate/pairs.hpp"

namespace pharos::evaluate {

/// Transformation from truth to estimate: T_EstimateWorld_EstimateBody = world * T_TruthWorld_TruthBody * body, at
/// ESTIMATE's time plus the offset on TRUTH's clock.
struct Alignment {
  Pose<EstimateWorld, TruthWorld> world;
  Pose<TruthBody, EstimateBody> body;
  double time_offset_s = 0.0;

  EstimatePose predicted(const TruthPose& truth) const { return world * truth * body; }
};

/// The parts of an Alignment to be estimated; the others do not change.
struct FreeParts {
  bool world = false;
  bool body = false;
  bool time = false;
};

/// A direction in the space of the estimated parameters that is unobservable with this motion: no worse fit within 1
/// deg, 20 mm or 20 ms along it. The fitted poses do not depend on the value along it.
struct UnobservableDirection {
  Vector3 world_rotation = Vector3::Zero();  // in ESTIMATE's world; unit length over all parts together,
  Vector3 world_offset = Vector3::Zero();    // one being 1 deg, 20 mm or 20 ms
  Vector3 body_rotation = Vector3::Zero();   // in TRUTH's body
  Vector3 body_offset = Vector3::Zero();
  double time = 0.0;

  /// Attitudes are unobservable too, not only offsets along the axis of all rotations.
  bool turns() const;
  /// The parts with a component along it: "body_offset|world_offset".
  std::string parts() const;
  /// For messages: "the offset of the bodies along (0.00, 0.00, 1.00) of TRUTH's body with …".
  std::string words() const;
};

struct Aligned {
  Alignment alignment;
  std::vector<UnobservableDirection> open;
  double cost = 0.0;  // robust, for comparing starts
};

/// Frame and body offsets in closed form: AX = XB over the relative motions of poses distributed over the recording
/// (rotation: Park and Martin 1994; offsets: linear), trimmed, so that a tenth of outliers has no effect. At least
/// three pairs.
Alignment hand_eye_start(const std::vector<Pair>& pairs);
/// The same, taking the world's rotation from the paths as se3_of_positions() does: for motions with little rotation.
Alignment path_start(const std::vector<Pair>& pairs);

/// The world's pose that brings the positions together in the least-squares sense (Umeyama 1991, without scale).
struct PositionFit {
  Pose<EstimateWorld, TruthWorld> world;
  double second_extent_m = 0.0;  // standard deviation of the path across its longest direction
};
PositionFit se3_of_positions(const std::vector<Pair>& pairs, const Alignment& present);

/// Refines `start` over all free parts together: Gauss-Newton on rotation vectors and positions, each weighted by its
/// own spread (median) and Cauchy's function. Unobservable directions are not changed and are reported; for this test a
/// hundred poses at most count as independent, because errors within one recording are correlated.
Aligned align(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth, const Alignment& start,
              FreeParts free, double max_gap_s);

}  // namespace pharos::evaluate
