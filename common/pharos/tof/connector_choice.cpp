// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pharos/tof/constants.hpp"

namespace pharos::tof {
namespace {

// Connectors are of one kind: their fitted sides agree to within this factor.
constexpr double kAlikeSides = 1.3;
// And their heights over the plate.
constexpr double kAlikeHeights = 1.5;
// A place is the plate's where that is more likely than a connector by e^10.
constexpr double kPlateCertain = -10.0;
// Distances closer than this many deviations are equal.
constexpr double kEqualSigmas = 4.0;
// A connector does not overlap the ring by more than this fraction of its side.
constexpr double kRingOverlap = 0.1;

class Chooser {
 public:
  Chooser(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
          const ConnectorSettings& settings, const RaisedWorkspace& workspace)
      : frame_(frame), camera_(camera), rays_(rays), ring_(ring), settings_(settings), workspace_(workspace) {}

  ConnectorChoice choose() {
    for (const RaisedBox& box : workspace_.boxes) sort_in(box);
    result_.doubt = doubt();
    if (result_.doubt == ConnectorDoubt::kNone && result_.seen.size() > 1) {
      const SeenConnector &first = result_.seen[0], &second = result_.seen[1];
      result_.two_nearest = second.distance_m() - first.distance_m() < equal_within(first, second);
    }
    return result_;
  }

 private:
  void sort_in(const RaisedBox& box) {
    if (box.verdict == BoxVerdict::kUnclear) {
      unclear_m_ = std::min(unclear_m_, box.distance_m() - box.rectangle.half_sides_m.maxCoeff());
      return;
    }
    if (box.verdict != BoxVerdict::kConnector) return;
    const ConnectorFace face = fit_face(frame_, camera_, rays_, ring_, box);
    const SeenConnector seen{face, face.edge_points > 0};
    if (seen.sure && face.rectangle.slenderness() > settings_.max_aspect) return;
    auto& list = result_.seen;
    if (!list.push_back(seen)) {
      if (list.back().distance_m() < seen.distance_m()) return;
      list.back() = seen;
    }
    for (std::size_t i = list.size() - 1; i > 0 && list[i].distance_m() < list[i - 1].distance_m(); --i) {
      std::swap(list[i], list[i - 1]);
    }
  }

  ConnectorDoubt doubt() const {
    const auto& seen = result_.seen;
    const auto count = static_cast<std::int32_t>(seen.size());
    if (count == 0) return ConnectorDoubt::kNoneSeen;
    if (count > settings_.expected) return ConnectorDoubt::kMore;
    if (unclear_m_ < seen[0].distance_m()) return ConnectorDoubt::kUnclear;
    for (const SeenConnector& other : seen) {
      if (!alike(seen[0], other)) return ConnectorDoubt::kUnlike;
    }
    return count == settings_.expected || nearer_places_are_plate() ? ConnectorDoubt::kNone : ConnectorDoubt::kHidden;
  }

  bool alike(const SeenConnector& a, const SeenConnector& b) const {
    const double heights = (a.face.height_m - workspace_.base_m) / (b.face.height_m - workspace_.base_m);
    if (!(heights < kAlikeHeights && heights * kAlikeHeights > 1.0)) return false;
    if (!a.sure || !b.sure) return true;
    const double areas = a.face.rectangle.area_m2() / b.face.rectangle.area_m2();
    return areas < kAlikeSides * kAlikeSides && areas * kAlikeSides * kAlikeSides > 1.0;
  }

  double equal_within(const SeenConnector& a, const SeenConnector& b) const {
    const auto variance = [](const SeenConnector& one) {
      const Vector2 along = one.face.rectangle.centre_m.normalized();
      return along.dot(one.face.covariance * along);
    };
    return std::max(settings_.min_difference_m, kEqualSigmas * std::sqrt(variance(a) + variance(b)));
  }

  // Whether no connector like the nearest one seen can stand nearer to the centre.
  bool nearer_places_are_plate() const {
    const SeenConnector& nearest = result_.seen[0];
    const double half = std::sqrt(0.25 * nearest.face.rectangle.area_m2());
    const double step = nearest.face.height_m - workspace_.base_m;
    const double limit = nearest.distance_m() + settings_.min_difference_m;
    const RingModel& model = ring_.model;
    const double clear = half * (1.0 - 2.0 * kRingOverlap);
    const ReliefGrid& grid = workspace_.grid;
    for (int row = 0; row < grid.side(); ++row) {
      for (int column = 0; column < grid.side(); ++column) {
        const Vector2 place = grid.place_of(column, row);
        const double distance = place.norm();
        if (distance > limit || distance < kMinConnectorDistance * model.radius_m[0]) continue;
        if (distance > model.radius_m[1] - clear && distance < model.radius_m[0] + clear) continue;
        // Those that overlap the one seen are itself.
        if ((place - nearest.face.rectangle.centre_m).norm() < 2.5 * half) continue;
        if (log_likelihood_of_box(workspace_, model, column, row, half, step) > kPlateCertain) return false;
      }
    }
    return true;
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingFit& ring_;
  const ConnectorSettings& settings_;
  const RaisedWorkspace& workspace_;
  ConnectorChoice result_;
  double unclear_m_ = 1e9;
};

}  // namespace

ConnectorChoice choose_connector(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                 const RingFit& ring, const ConnectorSettings& settings,
                                 const RaisedWorkspace& workspace) {
  return Chooser(frame, camera, rays, ring, settings, workspace).choose();
}

}  // namespace pharos::tof
