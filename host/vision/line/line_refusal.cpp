// SPDX-License-Identifier: Apache-2.0
#include "host/vision/line/line_refusal.hpp"

namespace pharos::line {

const char* name_of(LineRefusal refusal) {
  switch (refusal) {
    case LineRefusal::kWrongSize:
      return "wrong_size";
    case LineRefusal::kBlack:
      return "black";
    case LineRefusal::kSaturated:
      return "saturated";
    case LineRefusal::kStarsOnly:
      return "stars_only";
    case LineRefusal::kStarsBrighter:
      return "stars_brighter";
    case LineRefusal::kNoPanel:
      return "no_panel";
    case LineRefusal::kOneEdge:
      return "one_edge";
    case LineRefusal::kCutByBorder:
      return "cut_by_border";
    case LineRefusal::kEdgeUnsure:
      return "edge_unsure";
    case LineRefusal::kOutsideLens:
      return "outside_lens";
  }
  return "";
}

const char* advice_of(LineRefusal refusal) {
  switch (refusal) {
    case LineRefusal::kWrongSize:
      return "the image has another size than the camera file; take the camera file of this camera";
    case LineRefusal::kBlack:
      return "the image is black; expose longer";
    case LineRefusal::kSaturated:
      return "the target is overexposed; expose shorter";
    case LineRefusal::kStarsOnly:
      return "only stars are to be seen, no target";
    case LineRefusal::kStarsBrighter:
      return "stars outshine the target and no panel stands out; expose longer";
    case LineRefusal::kNoPanel:
      return "no panel with two parallel edges against the sky";
    case LineRefusal::kOneEdge:
      return "only one edge of a panel is to be seen; the axis needs two";
    case LineRefusal::kCutByBorder:
      return "a panel's edge runs out of the image; point so that the panel is in it as a whole";
    case LineRefusal::kEdgeUnsure:
      return "a panel's edge is no straight line; a sharper or brighter image is needed";
    case LineRefusal::kOutsideLens:
      return "the camera file's lens model has no rays where the panel is";
  }
  return "";
}

}  // namespace pharos::line
