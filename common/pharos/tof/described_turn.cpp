// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/described_turn.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tof {
namespace {

// Distances, places and heights agree within this many deviations, and within this much beside: foil under a connector,
// rounded corners.
constexpr double kGate = 4.0;
constexpr double kPlaceMargin_m = 0.004;
constexpr double kHeightMargin_m = 0.012;
// Sides agree to within this factor: noise of a cell on either side, at the far end.
constexpr double kLikeDescribed = 1.35;
// A side's length and the centre along it have errors of the same two edges: the length's is twice the centre's.
constexpr double kLengthPerCentre = 2.0;
// A side that differs from the described one by more than this many deviations has an edge that is not its own.
constexpr double kSideGate = 2.0;
// And beside it: rounded corners, a rim.
constexpr double kSizeMargin_m = 0.003;
// Corners that are a disc's by these odds are no connector's.
constexpr double kRoundLogOdds = 1.0;
// What one connector can say at most for or against a turn, as the logarithm of odds. One that is absent in plain sight
// says less: bodies differ from drawings, and any one connector gives the turn.
constexpr double kMaxFor = 15.0;
// One whose edges could not be fitted: depth alone tells its sides to a cell and its height to centimetres, which
// look-alikes of other kinds pass.
constexpr double kMaxForByDepth = 3.0;
constexpr double kMaxAgainst = 10.0;
// Turns closer than this are one, rad.
constexpr double kSameTurn_rad = 0.05;
// DESIGN's bound on the second minimum's chi-squared.
constexpr double kAmbiguous = 9.21;
// That none of the described connectors is seen explains the boxes as well: a turn must be more likely by as much.
constexpr double kMinLogOdds = 0.5 * kAmbiguous;

struct Hypothesis {
  std::size_t seen = 0;
  std::size_t described = 0;
  double turn_rad = 0.0;
  double log_odds = 0.0;
};

class TurnFinder {
 public:
  TurnFinder(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
             const TargetDescription& target, const RaisedWorkspace& workspace)
      : frame_(frame), camera_(camera), rays_(rays), ring_(ring), target_(target), workspace_(workspace) {}

  std::optional<DescribedTurn> find() {
    for (const RaisedBox& box : workspace_.boxes) {
      if (box.verdict == BoxVerdict::kStructure || faces_.full()) continue;
      faces_.push_back(fit_face(frame_, camera_, rays_, ring_, box));
    }
    propose();
    const Hypothesis* best = nullptr;
    for (const Hypothesis& one : hypotheses_) {
      if (one.log_odds > kMinLogOdds && (best == nullptr || better(one, *best))) best = &one;
    }
    if (best == nullptr) return std::nullopt;
    const Hypothesis* second = nullptr;
    for (const Hypothesis& one : hypotheses_) {
      if (same_turn(one, *best) || (second != nullptr && one.log_odds <= second->log_odds)) continue;
      second = &one;
    }
    DescribedTurn result{identified(*best), std::nullopt, 0.0};
    if (second != nullptr) {
      result.delta_chi2 = std::max(0.0, 2.0 * (best->log_odds - second->log_odds));
      if (result.delta_chi2 < kAmbiguous) {
        result.second = identified(*second);
      }
    }
    return result;
  }

 private:
  IdentifiedConnector identified(const Hypothesis& h) const {
    IdentifiedConnector result{faces_[h.seen], h.described};
    add_side_errors(target_.connectors[h.described].size_m, result.face);
    return result;
  }
  // Where a side's length is wrong, a wall or a shadow was taken for one of its edges: half of what it differs by is an
  // error of the centre.
  static void add_side_errors(const Vector2& described_m, ConnectorFace& face) {
    const Vector2 off_m = side_errors(described_m, face);
    Matrix2 more = Matrix2::Zero();
    for (int side = 0; side < 2; ++side) {
      const Vector2 along = face.rectangle.outward(side);
      if (std::fabs(off_m[side]) > kSideGate * side_sigma(face, side))
        more += 0.25 * off_m[side] * off_m[side] * along * along.transpose();
    }
    face.covariance += more;
  }
  // Of the fitted sides' lengths, whichever is which.
  static Vector2 side_errors(const Vector2& described_m, const ConnectorFace& face) {
    const Vector2 sides = 2.0 * face.rectangle.half_sides_m;
    const Vector2 off = sides - described_m, turned = sides - Vector2(described_m.y(), described_m.x());
    return off.squaredNorm() <= turned.squaredNorm() ? off : turned;
  }
  // By the odds of a rectangle's corners over a disc's; so few pixels may not tell.
  static bool is_rather_round(const ConnectorFace& face) {
    return face.squareness - 0.5 < -kRoundLogOdds * face.sigma_squareness * face.sigma_squareness;
  }
  static double side_sigma(const ConnectorFace& face, int side) {
    const Vector2 along = face.rectangle.outward(side);
    return kLengthPerCentre * std::sqrt(along.dot(face.covariance * along));
  }
  // By its edges, not by depth alone. A wall or a shadow may stand for one edge; two sides that are both of another
  // length are another thing's, as are corners that are more like a disc's.
  static bool is_shaped_like(const ConnectorFace& face, const DescribedConnector& described) {
    const Vector2 off_m = side_errors(described.size_m, face);
    return face.edge_points > 0 && !is_rather_round(face) &&
           (std::fabs(off_m[0]) < kSizeMargin_m + kGate * side_sigma(face, 0) ||
            std::fabs(off_m[1]) < kSizeMargin_m + kGate * side_sigma(face, 1));
  }

  static bool same_turn(const Hypothesis& a, const Hypothesis& b) {
    return std::fabs(std::remainder(a.turn_rad - b.turn_rad, kTwoPi)) < kSameTurn_rad;
  }
  // Of one turn: by the connector whose direction is best known.
  bool better(const Hypothesis& one, const Hypothesis& other) const {
    if (!same_turn(one, other)) return one.log_odds > other.log_odds;
    return direction_sigma(faces_[one.seen]) < direction_sigma(faces_[other.seen]);
  }
  static double direction_sigma(const ConnectorFace& face) {
    return std::sqrt(face.covariance.trace()) / std::max(0.01, face.rectangle.centre_m.norm());
  }

  void propose() {
    for (std::size_t seen = 0; seen < faces_.size(); ++seen) {
      for (std::size_t k = 0; k < target_.connectors.size(); ++k) {
        const Vector2 &at = faces_[seen].rectangle.centre_m, &described = target_.connectors[k].place_m;
        if (!(described.norm() > 0.0) || !could_be(faces_[seen], target_.connectors[k])) continue;
        if (std::fabs(at.norm() - described.norm()) > gate_m(faces_[seen], target_.connectors[k])) continue;
        const double turn = std::atan2(at.y(), at.x()) - std::atan2(described.y(), described.x());
        hypotheses_.push_back({seen, k, turn, log_odds(turn)});
      }
    }
  }

  double gate_m(const ConnectorFace& face, const DescribedConnector& described) const {
    return kPlaceMargin_m +
           kGate * std::sqrt(0.5 * face.covariance.trace() + described.sigma_place_m * described.sigma_place_m);
  }

  // By height, over the ring's plane or over the plate, and size.
  bool could_be(const ConnectorFace& face, const DescribedConnector& described) const {
    const double gate = kHeightMargin_m + kGate * std::hypot(face.sigma_height_m, described.sigma_height_m);
    const double over_plate = face.height_m - plate_at(face.rectangle.centre_m);
    if (std::min(std::fabs(face.height_m - described.height_m), std::fabs(over_plate - described.height_m)) > gate) {
      return false;
    }
    const auto alike = [](double a, double b) { return a < kLikeDescribed * b && b < kLikeDescribed * a; };
    const Vector2 sides = 2.0 * face.rectangle.half_sides_m;
    return alike(sides.minCoeff(), described.size_m.minCoeff()) && alike(sides.maxCoeff(), described.size_m.maxCoeff());
  }
  double plate_at(const Vector2& place) const {
    return place.norm() < ring_.model.radius_m[0] ? workspace_.base_m : workspace_.outer_base_m;
  }

  static Vector2 turned(const Vector2& place_m, double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * place_m.x() - s * place_m.y(), s * place_m.x() + c * place_m.y()};
  }
  // Whether something of a described connector's size and height stands where, by this turn, none is described.
  bool leaves_look_alikes(double turn) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](const ConnectorFace& face) {
      bool alike = false, explained = false;
      for (const DescribedConnector& one : target_.connectors) {
        if (!could_be(face, one)) continue;
        alike = true;
        const double off_m = (face.rectangle.centre_m - turned(one.place_m, turn)).norm();
        explained = explained || off_m <= 2.0 * gate_m(face, one);
      }
      return alike && !explained;
    });
  }

  // Of a turn, all described connectors together.
  double log_odds(double turn) const {
    double in_favour = 0.0, against = 0.0, by_depth = 0.0;
    for (const DescribedConnector& described : target_.connectors) {
      const Vector2 place = turned(described.place_m, turn);
      const double standing = standing_at(place, described);
      in_favour += standing;
      by_depth += std::min(standing, kMaxForByDepth);
      if (!(standing > 0.0)) against += std::clamp(evidence_at(place, described), -kMaxAgainst, 0.0);
    }
    // Where a connector is absent in plain sight and another look-alike stands elsewhere, what agrees is one as well.
    const bool is_doubtful = against < -kMinLogOdds && leaves_look_alikes(turn);
    return (is_doubtful ? by_depth : in_favour) + against;
  }
  // What the connector seen there says for the turn; 0 where none is.
  double standing_at(const Vector2& place, const DescribedConnector& described) const {
    double most = 0.0;
    for (const ConnectorFace& face : faces_) {
      // The turn is that of one of them, whose own error moves the others' places.
      if (!could_be(face, described) || (face.rectangle.centre_m - place).norm() > 2.0 * gate_m(face, described))
        continue;
      most = std::max(most, is_shaped_like(face, described) ? kMaxFor : kMaxForByDepth);
    }
    return most;
  }
  // In the ring's plane a face appears where its ray meets it.
  double evidence_at(const Vector2& place, const DescribedConnector& described) const {
    const ReliefGrid& grid = workspace_.grid;
    const double plate = plate_at(place);
    // Heights over the plate are positive; one over the ring's plane is seldom as far over it as the plate is below.
    const double over_plane = described.height_m > -0.5 * plate ? described.height_m + plate : described.height_m;
    const PlaneAxes axes = axes_of(ring_.model.normal);
    const Vector3 point = ring_.model.centre_m + place.x() * axes.first + place.y() * axes.second;
    const Vector2 slope = Vector2(axes.first.dot(point), axes.second.dot(point)) / -ring_.model.normal.dot(point);
    const Vector2 seen_at = place + over_plane * slope;
    const auto column = static_cast<int>(std::lround(grid.column_of(seen_at.x())));
    const auto row = static_cast<int>(std::lround(grid.column_of(seen_at.y())));
    if (column < 0 || row < 0 || column >= grid.side() || row >= grid.side()) return 0.0;
    return log_likelihood_of_box(workspace_, ring_.model, column, row, 0.5 * described.size_m.minCoeff(),
                                 over_plane - plate);
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingFit& ring_;
  const TargetDescription& target_;
  const RaisedWorkspace& workspace_;
  StaticVector<ConnectorFace, kMaxRaised> faces_;
  StaticVector<Hypothesis, kMaxRaised * kMaxDescribed> hypotheses_;
};

}  // namespace

std::optional<DescribedTurn> find_described_turn(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                                 const RingFit& ring, const TargetDescription& target,
                                                 const RaisedWorkspace& workspace) {
  return TurnFinder(frame, camera, rays, ring, target, workspace).find();
}

}  // namespace pharos::tof
