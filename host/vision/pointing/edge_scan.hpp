// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/rise_fit.hpp"
#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// Steps along a line by one row or column, whichever is closer to perpendicular.
class EdgeScan {
 public:
  EdgeScan(ImageView<const std::uint16_t> image, const Segment& line);

  /// Index of the row or column at a station along the line.
  int index_at(double station) const;
  int direction() const { return step_ > 0.0 ? 1 : -1; }

  /// Where the line crosses the row or column.
  Vector2 crossing(int index) const;
  /// The pixels within `reach_px` across the line; empty where the image ends before.
  std::optional<Profile> profile(int index, double reach_px) const;
  /// The pixel position of a rise at `across` px from the line in this row or column.
  Vector2 place(int index, double across) const;

 private:
  ImageView<const std::uint16_t> image_;
  Segment line_;
  bool along_rows_ = false;
  double slope_ = 1.0;  // distance across the edge from a pixel of a profile to the next
  double step_ = 1.0;
};

/// An edge's rise in one row or column.
struct EdgeSample {
  int index = 0;
  double across = 0.0;
  double contrast = 0.0;
  double dark = 0.0;
  Rise rise;
};

/// Properties of a valid point of an edge.
struct ScanSettings {
  double blur = 1.2;      ///< px
  double contrast = 0.0;  ///< 0: not known yet
  double reach_px = 6.0;
  double max_off_px = 2.5;  ///< from the line: farther ones are of another edge
};

/// The rises of every row or column from one to another; those that are none of this edge are left out.
std::vector<EdgeSample> samples_between(const EdgeScan& scan, const TargetMask& target, int from, int to,
                                        const ScanSettings& settings);

/// From `index` on in steps of `step` until the edge ends; the index of the last good one.
int followed(const EdgeScan& scan, const TargetMask& target, int index, int step, const ScanSettings& settings);

}  // namespace pharos::pointing
