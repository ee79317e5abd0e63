// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_pose.hpp"

#include <cmath>
#include <utility>

#include "pharos/ellipse/detect.hpp"
#include "pharos/tof/relief_image.hpp"

namespace pharos::tof {
namespace {

constexpr double kPartlyHidden = 0.9;
// A boom that fills most of the frame, and the face behind it.
constexpr int kFacePlanes = 2;
// Protrusions and missing corners included.
constexpr double kDoubtfulArea = 3.0;

void tell(TofStageListener* listener, TofStage ended) {
  if (listener != nullptr) listener->ended(ended);
}

bool is_good(const TargetPose& target) {
  if (!target.pose.is_finite() || !target.covariance.allFinite()) return false;
  return (target.covariance.diagonal().array() > 0.0).all();
}

// A face and its source.
struct Choice {
  ConnectorFace face;
  bool sure = false;  // its edges were found

  double distance_m() const { return face.rectangle.centre_m.norm(); }
};

// Connectors are of one kind: their fitted sides agree to within this factor.
constexpr double kAlikeSides = 1.25;

bool of_one_size(const ConnectorFace& one, const ConnectorFace& other) {
  const auto area = [](const ConnectorFace& face) {
    return face.rectangle.half_sides_m.x() * face.rectangle.half_sides_m.y();
  };
  const double ratio = area(one) / area(other);
  return ratio < kAlikeSides * kAlikeSides && ratio * kAlikeSides * kAlikeSides > 1.0;
}

class ConnectorChoice {
 public:
  ConnectorChoice(const TofFrame& frame, const DepthCamera& camera, const TofWorkspace& workspace, const RingFit& ring)
      : frame_(frame), camera_(camera), workspace_(workspace), ring_(ring) {}

  // Nearest first. False where it is undecided whether a region is a nearer connector: then none may be chosen.
  // Doubtful regions are only used where connectors are missing.
  bool choose(std::int32_t expected, double min_difference_m) {
    const auto& found = workspace_.connector.connectors;
    for (std::size_t i = 0; i < found.size() && i < 3; ++i) add(found[i]);
    if (static_cast<std::int32_t>(found.size()) >= expected) return true;
    for (const RegionReport& doubt : workspace_.connector.doubtful) {
      if (!found.empty() && !are_alike(doubt, found[0], kDoubtfulArea)) continue;
      if (add_doubtful(doubt, min_difference_m)) continue;
      if (choices_.empty() || doubt.distance_m < choices_[0].distance_m() + min_difference_m) return false;
    }
    return !choices_.empty();
  }
  const StaticVector<Choice, 8>& choices() const { return choices_; }

 private:
  // By the edges around the region; else by those of a square like the nearest connector's, which may show another
  // connector but never a nearer one: protrusions shift it.
  bool add_doubtful(const RegionReport& doubt, double min_difference_m) {
    const Choice own = choice_of(doubt);
    if (own.sure && is_another(own)) {
      insert(own);
      return true;
    }
    if (choices_.empty() || !choices_[0].sure) return false;
    const Choice like = choice_like(doubt);
    if (!like.sure || !is_another(like)) return false;
    if (like.distance_m() < choices_[0].distance_m() + min_difference_m) return false;
    insert(like);
    return true;
  }
  Choice choice_of(const RegionReport& region) const {
    const ConnectorFace face = fit_face(frame_, camera_, workspace_.rays, ring_, region);
    return {face, face.edge_points > 0};
  }
  Choice choice_like(const RegionReport& region) const {
    const ConnectorFace face = fit_face_within(frame_, camera_, workspace_.rays, ring_, region, choices_[0].face);
    return {face, face.edge_points > 0};
  }
  // Of the same kind, and not one of those already known.
  bool is_another(const Choice& choice) const {
    const double side = 2.0 * choice.face.rectangle.half_sides_m.minCoeff();
    for (const Choice& known : choices_) {
      const Vector2 apart = choice.face.rectangle.centre_m - known.face.rectangle.centre_m;
      if (!of_one_size(choice.face, known.face) || apart.norm() < side) return false;
    }
    return true;
  }
  void add(const RegionReport& region) { insert(choice_of(region)); }
  void insert(const Choice& choice) {
    if (!choices_.push_back(choice)) return;
    for (std::size_t i = choices_.size() - 1; i > 0 && choices_[i].distance_m() < choices_[i - 1].distance_m(); --i) {
      std::swap(choices_[i], choices_[i - 1]);
    }
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const TofWorkspace& workspace_;
  const RingFit& ring_;
  StaticVector<Choice, 8> choices_;
};

void add_connector(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                   TofWorkspace& workspace, TofStageListener* listener, TofPose& result) {
  const RingFit& ring = result.ring.fit;
  find_connectors(frame, camera, workspace.rays, ring, settings.connector, workspace.connector);
  tell(listener, TofStage::kConnector);
  ConnectorChoice choice(frame, camera, workspace, ring);
  const bool told = choice.choose(settings.connector.expected, settings.connector.min_difference_m);
  const bool few = static_cast<std::int32_t>(choice.choices().size()) < settings.connector.expected;
  if (!told || few) {
    result.flags |= kFlagNoConnector;
    if (few && !choice.choices().empty()) result.flags |= kFlagFewConnectors;
    result.target = target_pose_without_turn(ring);
    return;
  }
  const auto& choices = choice.choices();
  result.connector = choices[0].face;
  result.target = target_pose(ring, result.connector);
  if (!choices[0].sure) result.flags |= kFlagCoarseConnector;
  if (choices.size() > 1 && choices[1].distance_m() - choices[0].distance_m() < settings.connector.min_difference_m) {
    result.second = target_pose(ring, choices[1].face);
  }
}

std::span<const ellipse::DetectedEllipse> ellipses_in(ImageView<const std::uint16_t> image, const TofSettings& settings,
                                                      TofWorkspace& workspace, TofStageListener* listener) {
  ellipse::Contours contours;
  ellipse::trace_contours(image, workspace.ellipse, contours);
  tell(listener, TofStage::kEdges);
  const auto ellipses = ellipse::ellipses_along(contours, settings.ellipse, workspace.ellipse);
  tell(listener, TofStage::kEllipses);
  return ellipses;
}

// By the intensity image; where that does not show the ring (foil as bright beside it), by the relief over the face.
// The failure is the first one's.
Result<RingChoice, TofFailure> find_ring(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                                         TofWorkspace& workspace, TofStageListener* listener) {
  const auto ring_in = [&](ImageView<const std::uint16_t> image) {
    const auto ellipses = ellipses_in(image, settings, workspace, listener);
    return choose_ring(frame, camera, workspace.rays, ellipses, settings.ring, settings.noise, workspace.edges,
                       listener);
  };
  const auto ring = ring_in(frame.intensity);
  if (ring) return ring;
  // Connectors are searched later: the memory of their heights is free.
  const ImageView<std::uint16_t> relief(workspace.connector.heights.data(), frame.depth.width_px,
                                        frame.depth.height_px);
  auto face = face_plane(frame, camera, workspace.rays, settings.noise);
  for (int plane = 0; face && plane < kFacePlanes; ++plane) {
    make_relief_image(frame, camera, workspace.rays, *face, relief);
    tell(listener, TofStage::kFace);
    const auto by_height = ring_in(relief);
    if (by_height) return by_height;
    const DepthPlane front = *face;
    face = face_plane(frame, camera, workspace.rays, settings.noise, &front);
  }
  return ring;
}

}  // namespace

Result<TofPose, TofFailure> measure_tof_pose(const TofFrame& frame, const DepthCamera& camera,
                                             const TofSettings& settings, TofWorkspace& workspace,
                                             TofStageListener* listener) {
  workspace.connector.regions.clear();
  workspace.connector.connectors.clear();
  workspace.ellipse.found.clear();
  workspace.ellipse.arcs.clear();
  for (RingEdgePoints& points : workspace.edges.points) points.clear();
  if (const auto failure = workspace.frames.check(frame, camera)) return *failure;
  if (!workspace.rays.prepare(camera.intrinsics)) return TofFailure::kCameraUnusable;
  tell(listener, TofStage::kCheck);
  const auto ring = find_ring(frame, camera, settings, workspace, listener);
  if (!ring) return ring.error();
  TofPose result;
  result.ring = *ring;
  if (ring->fit.seen < kPartlyHidden) result.flags |= kFlagRingPartlyHidden;
  add_connector(frame, camera, settings, workspace, listener, result);
  tell(listener, TofStage::kPose);
  if (!is_good(result.target)) return TofFailure::kRingNotCircles;
  return result;
}

}  // namespace pharos::tof
