// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/pointing/panel_hypothesis.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// What of an image confirms a hypothesis: something that a pair of any two edges would not have.
class PanelEvidence {
 public:
  PanelEvidence(ImageView<const std::uint16_t> image, const TargetMask& target, const PinholeCamera& camera,
                const std::vector<Segment>& outline, const std::vector<EdgePair>& pairs)
      : image_(image), target_(target), camera_(camera), outline_(outline), pairs_(pairs) {}

  /// By a second panel on the axis or a third edge along it, by two ends square to it, or by one and a plane region.
  /// Where perspective hardly tells the axis: by a second panel, or by how much of the target it covers.
  bool is_confirmed(const PanelHypothesis& h) const;

  /// Two panels on one axis, or one and an edge of another.
  bool is_in_line(const PanelHypothesis& h) const;

 private:
  bool is_much_of_target(const PanelHypothesis& h) const;
  bool is_end_of_plane(const PanelHypothesis& h) const;
  bool continues_face(const PanelHypothesis& h, const Segment& own, const Segment& edge) const;
  bool is_of_yokes(const PanelHypothesis& h) const;
  bool is_interrupted(const PanelHypothesis& h) const;
  bool goes_on_between(const Segment& one, const Segment& other) const;
  bool is_of_a_narrower(const EdgePair& own, const Segment& edge) const;
  bool is_third(const PanelHypothesis& h, const Segment& edge) const;
  bool is_in_line_with_a_side(const PanelHypothesis& h, const LineFit& edge) const;

  ImageView<const std::uint16_t> image_;
  const TargetMask& target_;
  const PinholeCamera& camera_;
  const std::vector<Segment>& outline_;
  const std::vector<EdgePair>& pairs_;
};

}  // namespace pharos::pointing
