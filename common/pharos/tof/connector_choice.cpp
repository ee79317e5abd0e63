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
// And something stands there where that is more likely than the plate by e^15: places are some thousand.
constexpr double kStands = 15.0;
// Nozzles are no wider than this fraction of the ring.
constexpr double kClearOfNozzle = 0.45;
// Places so near to a box' centre, in half diagonals, show the box or its walls.
constexpr double kBesideBox = 2.0;
// Of what is seen as a connector, the side of a smaller one that may be hidden.
constexpr double kConnectorPerCover = 0.5;
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
    if (box.verdict == BoxVerdict::kUnclear || (box.verdict == BoxVerdict::kConnector && overlaps_another(box))) {
      unclear_m_ = std::min(unclear_m_, box.distance_m() - box.rectangle.half_sides_m.maxCoeff());
      return;
    }
    if (box.verdict != BoxVerdict::kConnector) return;
    const ConnectorFace face = fit_face(frame_, camera_, rays_, ring_, box);
    const SeenConnector seen{face, face.edge_points > 0};
    // A thruster: its place counts as one that is not the plate's.
    if (face.is_round()) return;
    if (seen.sure && face.rectangle.slenderness() > settings_.max_aspect) {
      // Of a connector's shape by depth alone: noise, perhaps.
      unclear_m_ = std::min(unclear_m_, seen.distance_m());
      return;
    }
    auto& list = result_.seen;
    if (!list.push_back(seen)) {
      if (list.back().distance_m() < seen.distance_m()) return;
      list.back() = seen;
    }
    for (std::size_t i = list.size() - 1; i > 0 && list[i].distance_m() < list[i - 1].distance_m(); --i) {
      std::swap(list[i], list[i - 1]);
    }
  }

  // Two boxes that overlap are parts of one thing: a rail in noise.
  bool overlaps_another(const RaisedBox& box) const {
    return std::any_of(workspace_.boxes.begin(), workspace_.boxes.end(), [&](const RaisedBox& other) {
      return &other != &box && other.verdict == BoxVerdict::kConnector &&
             (holds_a_corner(box.rectangle, other.rectangle) || holds_a_corner(other.rectangle, box.rectangle));
    });
  }
  static bool holds_a_corner(const PlanarRectangle& a, const PlanarRectangle& b) {
    for (int side = 0; side < 4; ++side) {
      if (a.holds(b.centre_m + b.half_side(side) * b.outward(side) + b.half_side(side + 1) * b.outward(side + 1))) {
        return true;
      }
    }
    return false;
  }

  ConnectorDoubt doubt() const {
    const auto& seen = result_.seen;
    const auto count = static_cast<std::int32_t>(seen.size());
    if (count == 0) return ConnectorDoubt::kNoneSeen;
    if (count > settings_.expected) return ConnectorDoubt::kMore;
    if (unclear_m_ < seen[0].distance_m() || !workspace_.complete) return ConnectorDoubt::kUnclear;
    for (const SeenConnector& other : seen) {
      if (!alike(seen[0], other)) return ConnectorDoubt::kUnlike;
    }
    // One of them may be a look-alike, a cover or a thruster for example, and a connector hidden or not found.
    if ((count == 1 || !seen[0].face.is_square()) && face_is_hidden()) return ConnectorDoubt::kHidden;
    if (count < settings_.expected) {
      return nearer_places_are_plate() ? ConnectorDoubt::kNone : ConnectorDoubt::kHidden;
    }
    // A single one that pixels do not show as a rectangle may be anything, and the connector too dark for depth.
    if (count == 1 && !seen[0].face.is_square()) return ConnectorDoubt::kUnclear;
    return something_stands_nearer() ? ConnectorDoubt::kUnclear : ConnectorDoubt::kNone;
  }

  bool alike(const SeenConnector& a, const SeenConnector& b) const {
    const double heights = (a.face.height_m - workspace_.base_m) / (b.face.height_m - workspace_.base_m);
    if (!(heights < kAlikeHeights && heights * kAlikeHeights > 1.0)) return false;
    const double first = std::sqrt(a.face.rectangle.area_m2()), second = std::sqrt(b.face.rectangle.area_m2());
    // Sides that only the depth image gives are known to a cell.
    const double slack_m = a.sure && b.sure ? 0.0 : workspace_.grid.cell_m();
    return std::max(first, second) - slack_m < kAlikeSides * (std::min(first, second) + slack_m);
  }

  double equal_within(const SeenConnector& a, const SeenConnector& b) const {
    const auto variance = [](const SeenConnector& one) {
      const Vector2 along = one.face.rectangle.centre_m.normalized();
      return along.dot(one.face.covariance * along);
    };
    return std::max(settings_.min_difference_m, kEqualSigmas * std::sqrt(variance(a) + variance(b)));
  }

  // Whether something before the satellite hides as much of it as a connector takes.
  bool face_is_hidden() const {
    const ReliefGrid& grid = workspace_.grid;
    const double nearest = kMinConnectorDistance * ring_.model.radius_m[0];
    int cells = 0;
    for (int row = 0; row < grid.side(); ++row) {
      for (int column = 0; column < grid.side(); ++column) {
        cells += grid.hidden(column, row) && grid.place_of(column, row).norm() > nearest ? 1 : 0;
      }
    }
    return cells * grid.cell_m() * grid.cell_m() > result_.seen[0].face.rectangle.area_m2();
  }

  // Whether no connector like the nearest one seen can stand nearer to the centre.
  bool nearer_places_are_plate() const {
    // The one seen may be a cover: a connector of half its side must be told from the plate too.
    const double half_m = kConnectorPerCover * seen_half_m();
    return !any_nearer_place(kMinConnectorDistance * ring_.model.radius_m[0], half_m,
                             [](const Vector2&, double log_odds) { return log_odds > kPlateCertain; });
  }
  // Whether something as high and wide as the nearest one stands nearer, and is none of the boxes found.
  bool something_stands_nearer() const {
    // Clear of the nozzle and of its walls in sight.
    const double half_m = seen_half_m();
    const double nearest_m = kClearOfNozzle * ring_.model.radius_m[0] + 2.0 * half_m;
    return any_nearer_place(nearest_m, half_m, [&](const Vector2& place, double log_odds) {
      if (log_odds < kStands || beside_wall(place.norm(), half_m) || beside_hidden(place, half_m)) return false;
      return std::none_of(workspace_.boxes.begin(), workspace_.boxes.end(), [&](const RaisedBox& box) {
        return (place - box.rectangle.centre_m).norm() < kBesideBox * box.rectangle.half_sides_m.norm();
      });
    });
  }

  // In the ring's plane its walls in sight lie beside it, as far as the plate is deep.
  bool beside_wall(double distance_m, double half_m) const {
    const double facing = std::clamp(-ring_.model.normal.dot(ring_.model.centre_m.normalized()), 0.1, 1.0);
    const double wall_m = std::fabs(workspace_.base_m) * std::sqrt(1.0 - facing * facing) / facing;
    const double clear_m = 1.5 * half_m + wall_m;
    return distance_m > ring_.model.radius_m[1] - clear_m && distance_m < ring_.model.radius_m[0] + clear_m;
  }

  // At the rim of something before the satellite pixels are mixed with it.
  bool beside_hidden(const Vector2& place, double half_m) const {
    const ReliefGrid& grid = workspace_.grid;
    const double reach_m = 2.0 * half_m;
    const auto cell = [&](double along_m) {
      return std::clamp(static_cast<int>(std::lround(grid.column_of(along_m))), 0, grid.side() - 1);
    };
    for (int row = cell(place.y() - reach_m); row <= cell(place.y() + reach_m); ++row) {
      for (int column = cell(place.x() - reach_m); column <= cell(place.x() + reach_m); ++column) {
        if (grid.hidden(column, row)) return true;
      }
    }
    return false;
  }

  double seen_half_m() const { return std::sqrt(0.25 * result_.seen[0].face.rectangle.area_m2()); }

  // Calls is(place, logarithm of the odds of a connector over the plate) of half side `half` for places nearer to the
  // centre than the nearest one seen, until it is true.
  template <class Is>
  bool any_nearer_place(double nearest_m, double half, Is is) const {
    const SeenConnector& nearest = result_.seen[0];
    const double step = nearest.face.height_m - workspace_.base_m;
    const double limit = nearest.distance_m() + settings_.min_difference_m;
    const RingModel& model = ring_.model;
    const double clear = seen_half_m() * (1.0 - 2.0 * kRingOverlap);
    const ReliefGrid& grid = workspace_.grid;
    for (int row = 0; row < grid.side(); ++row) {
      for (int column = 0; column < grid.side(); ++column) {
        const Vector2 place = grid.place_of(column, row);
        const double distance = place.norm();
        if (distance > limit || distance < nearest_m) continue;
        if (distance > model.radius_m[1] - clear && distance < model.radius_m[0] + clear) continue;
        // Those that overlap the one seen are itself.
        if ((place - nearest.face.rectangle.centre_m).norm() < 2.5 * seen_half_m()) continue;
        if (is(place, log_likelihood_of_box(workspace_, model, column, row, half, step))) return true;
      }
    }
    return false;
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
