// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/pointing_refusal.hpp"

namespace pharos::pointing {

const char* name_of(PointingRefusal refusal) {
  switch (refusal) {
    case PointingRefusal::kWrongSize:
      return "wrong_size";
    case PointingRefusal::kBlack:
      return "black";
    case PointingRefusal::kSaturated:
      return "saturated";
    case PointingRefusal::kStarsOnly:
      return "stars_only";
    case PointingRefusal::kStarsBrighter:
      return "stars_brighter";
    case PointingRefusal::kNoPanel:
      return "no_panel";
    case PointingRefusal::kOneEdge:
      return "one_edge";
    case PointingRefusal::kCutByBorder:
      return "cut_by_border";
    case PointingRefusal::kEdgeUnsure:
      return "edge_unsure";
    case PointingRefusal::kAlongSight:
      return "along_sight";
    case PointingRefusal::kOutsideLens:
      return "outside_lens";
  }
  return "";
}

const char* advice_of(PointingRefusal refusal) {
  switch (refusal) {
    case PointingRefusal::kWrongSize:
      return "the image has another size than the camera file; take the camera file of this camera";
    case PointingRefusal::kBlack:
      return "the image is black; expose longer";
    case PointingRefusal::kSaturated:
      return "the target is overexposed; expose shorter";
    case PointingRefusal::kStarsOnly:
      return "only stars are to be seen, no target";
    case PointingRefusal::kStarsBrighter:
      return "stars outshine the target and no panel stands out; expose longer";
    case PointingRefusal::kNoPanel:
      return "no panel with two parallel edges against the sky";
    case PointingRefusal::kOneEdge:
      return "only one edge of a panel is to be seen; the axis needs two";
    case PointingRefusal::kCutByBorder:
      return "a panel's edge runs out of the image; point so that the panel is in it as a whole";
    case PointingRefusal::kEdgeUnsure:
      return "a panel's edge is no straight line; a sharper or brighter image is needed";
    case PointingRefusal::kAlongSight:
      return "the panel's axis points at the telescope; look from another direction";
    case PointingRefusal::kOutsideLens:
      return "the camera file's lens model has no rays where the panel is";
  }
  return "";
}

}  // namespace pharos::pointing
