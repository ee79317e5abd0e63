// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "tools/layout/convex_body.hpp"
#include "tools/layout/layout_score.hpp"

namespace pharos::layout {

/// Constraints on sensor positions.
struct Rules {
  std::size_t sensors = 12;
  double spacing_m = 0.012;  // between centres
  /// Minimum distance of a centre from its face's edges: half of a photodiode of 5 mm, and 0.5 mm.
  double edge_m = 0.003;
};

/// A position on a body.
struct MountPoint {
  std::size_t facet = 0;
  Vector2 xy = Vector2::Zero();
};
using MountPoints = std::vector<MountPoint>;

/// The target with sensors 0, 1, … at the given positions, with the normals of the faces; coordinates rounded to 0.01
/// mm.
Target target_of(const ConvexBody& body, const MountPoints& mount_points);

/// Facets from which a sensor could see the station, at one of the poses at least.
std::vector<std::size_t> seen_facets(const ConvexBody& body, const std::vector<LighthouseFromBody>& poses,
                                     double incidence_rad);

/// Searches the best layout on some facets: `starts` distributed or random layouts, each improved by moving one sensor
/// at a time to the best free position of a grid, the best of them then by moving sensors on their faces in steps down
/// to 0.1 mm. Deterministic for one seed on machines with the same arithmetic.
class LayoutSearch {
 public:
  LayoutSearch(const ConvexBody& body, const std::vector<std::size_t>& facets, Rules rules, std::uint64_t seed);

  /// A first layout with sensors as far apart as possible; none where there is no space for them.
  std::optional<MountPoints> spread() const;
  /// Precondition: spread() returns a layout. Calls `tick` periodically.
  MountPoints best(const LayoutEvaluator& evaluator, int starts, const std::function<void()>& tick) const;

 private:
  MountPoints scattered(std::uint64_t seed) const;
  bool has_room(const MountPoints& mount_points, std::size_t except, const MountPoint& mount_point) const;
  double exchange(MountPoints& mount_points, const LayoutEvaluator& evaluator, const std::function<void()>& tick) const;
  void polish(MountPoints& mount_points, const LayoutEvaluator& evaluator, const std::function<void()>& tick) const;

  const ConvexBody& body_;
  Rules rules_;
  std::uint64_t seed_;
  std::vector<std::vector<Vector2>> insets_;  // by facet of the body; empty: no positions there
  std::vector<MountPoint> grid_;
  double step_m_ = 0.0;
};

}  // namespace pharos::layout
