// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/ring2_estimator.hpp"

#include <array>

#include "host/preview/ring2_drawing.hpp"
#include "host/support/flag_text.hpp"
#include "host/vision/ring2/ring2_pose.hpp"
#include "host/vision/ring2/ring2_rig.hpp"

namespace pharos::host {
namespace {

enum Ring2Flag : std::uint8_t {
  kNoConnector = 1,  // as for tof: the rotation about Z' is unknown; two circles on one axis never determine it
  kNoNozzle = 2,     // the ring only
};
constexpr std::array<FlagWord, 2> kRing2FlagWords{{{kNoConnector, "no_connector"}, {kNoNozzle, "no_nozzle"}}};

// Advice for a refusal of host/vision/ring2 or common/ring2.
const char* advice_of(const std::string& refusal) {
  const auto ends = [&refusal](const char* end) { return refusal.ends_with(end); };
  if (ends("_black")) return "the image shows nothing: light, lens cap, exposure?";
  if (ends("_saturated")) return "most of the image is white: expose it less";
  if (ends("_even")) return "nothing stands out from anything: is it in focus, is there a target?";
  if (ends("_no_ellipse")) return "no ellipse of 12 px or more: is the ring in view, and whole?";
  if (refusal == "left_right_exchanged") return "exchange the cameras in the configuration, or their cables";
  if (refusal == "no_common_circle" || refusal == "inconsistent") {
    return "what the cameras see is no one circle before this rig: has a camera been moved since its calibration?";
  }
  if (refusal == "ring_unsure")
    return "circles are seen, but none that is surely the ring: is the nozzle in view and lit?";
  return "the ellipses do not tell a ring's pose";
}

}  // namespace

Ring2Estimator::Ring2Estimator(const RigFile& rig)
    : finder_(ring2_rig(rig), {}), focal_px_(0.5 * (rig.left.intrinsics.fx_px + rig.right.intrinsics.fx_px)) {}

PairResult Ring2Estimator::measure(const StereoPair& pair) {
  PairResult answer;
  const Ring2Detection circles = finder_.find({pair.frames[0]->intensity_view(), pair.frames[1]->intensity_view()});
  for (std::size_t side = 0; pair.with_pictures && side < pair.frames.size(); ++side) {
    answer.pictures.push_back(annotated_image(pair.frames[side]->intensity_view(),
                                              ring2_drawing(circles, finder_.rig(), side),
                                              side == 0 ? "left" : "right"));
  }
  answer.refusal = circles.refusal;
  answer.advice = circles.refusal.empty() ? "" : advice_of(circles.refusal);
  answer.pose = Ring2PoseEstimate{};
  if (!circles.estimate) return answer;
  if ((circles.estimate->unobservable & (ring2::kUnobservableScale | ring2::kUnobservableRing)) != 0) {
    answer.refusal = "no_ring";
    answer.advice = "the ring was not seen by both cameras: where is it?";
    return answer;
  }
  Ring2PoseEstimate pose = ring2_pose(*circles.estimate, focal_px_);
  pose.observations = answer.observations = circles.edge_points;
  const bool no_nozzle = (circles.estimate->unobservable & ring2::kUnobservableNozzle) != 0;
  answer.flags = joined_flags(kNoConnector | (no_nozzle ? kNoNozzle : 0), kRing2FlagWords);
  answer.pose = pose;
  return answer;
}

}  // namespace pharos::host
