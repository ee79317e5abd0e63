// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace pharos::host {

/// The straight line under a cloud of delays: delay = offset + drift x time + latency, where latency is never negative.
///
/// Of all lines below every point, the one with the least sum of distances: the edge of the lower convex hull that
/// spans the mean time. Moon, Skelly, Towsley, "Estimation and removal of clock skew from network delay measurements",
/// IEEE INFOCOM 1999. The points are the smallest delays of half-second bins over the last minute, so that a fit has at
/// most 120 points, and bursts and stalls, which only add latency, have no effect. A smallest delay far below the
/// second smallest of its bin, compared with the other bins, is a false time: the second is used instead. A bin of one
/// point counts only while no bin has two.
class LowerEnvelope {
 public:
  struct Line {
    double at_s = 0.0;  // time of the newest bin
    double delay_ns = 0.0;
    double drift_ns_per_s = 0.0;
    /// Median height of the bins' points above the line, ns: how well defined the floor is.
    double scatter_ns = 0.0;
    double span_s = 0.0;  // from the first bin to the last
    double value(double time_s) const { return delay_ns + drift_ns_per_s * (time_s - at_s); }
  };

  void add(double time_s, double delay_ns);
  /// Empty without points. Computed anew only where a bin's two smallest delays have changed since the last call: a
  /// tenth of all points do that.
  const std::optional<Line>& fit();
  void clear() {
    bins_.clear();
    line_.reset();
  }

 private:
  struct Point {
    double time_s = 0.0;
    double delay_ns = 0.0;
  };
  struct Bin {
    std::int64_t number = 0;
    Point minimum;
    std::optional<Point> second;
  };

  std::vector<Point> points() const;
  std::optional<Line> fitted() const;

  std::deque<Bin> bins_;      // by number
  std::optional<Line> line_;  // of the bins as they are; empty: to be computed
};

}  // namespace pharos::host
