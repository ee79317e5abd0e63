// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/arc_pair.hpp"

#include <cmath>
#include <optional>

namespace pharos::ellipse {
namespace {

// Maximum distance of a point on the wrong side: edges are accurate to a fraction of this, tangents at ends to some
// degrees.
constexpr float kSlack_px = 1.5F;
constexpr float kSlackOfDistance = 0.10F;
// The chord of an arc that nearly closes is undefined.
constexpr float kMinChord_px = 3.0F;

float cross(PointF a, PointF b) { return a.u * b.v - a.v * b.u; }
PointF between(PointF from, PointF to) { return {to.u - from.u, to.v - from.v}; }
float length(PointF p) { return std::sqrt(p.u * p.u + p.v * p.v); }

bool lies_in(const Arc& arc, const Arc& other) {
  return in_search_region(arc, other.start) && in_search_region(arc, other.middle) &&
         in_search_region(arc, other.finish);
}

// Intersection of the line from `p` along `d` with the arc's chord, as a multiple of d.
std::optional<float> crossing(PointF p, PointF d, const Arc& arc) {
  const PointF chord = between(arc.start, arc.finish);
  const float slope = cross(d, chord);
  if (std::abs(slope) < 1e-3F * length(d) * length(chord)) return std::nullopt;
  return cross(between(p, arc.start), chord) / slope;
}

}  // namespace

bool in_search_region(const Arc& arc, PointF point) {
  const float side = arc.turn_rad < 0.0F ? -1.0F : 1.0F;
  const PointF from_start = between(arc.start, point), from_finish = between(arc.finish, point);
  const auto slack = [](PointF way) { return -(kSlack_px + kSlackOfDistance * length(way)); };
  if (side * cross(arc.start_tangent, from_start) < slack(from_start)) return false;
  if (side * cross(arc.finish_tangent, from_finish) < slack(from_finish)) return false;
  const PointF chord = between(arc.start, arc.finish);
  const float chord_length = length(chord);
  return chord_length < kMinChord_px || side * cross(chord, from_start) >= -kSlack_px * chord_length;
}

bool face_to_face(const Arc& one, const Arc& other) {
  const PointF line = between(one.middle, other.middle);
  const auto first = crossing(one.middle, line, one), second = crossing(one.middle, line, other);
  if (!first || !second) return false;
  const float slack = kSlack_px / length(line);
  return *first >= -slack && *second <= 1.0F + slack && *first <= *second + slack;
}

bool may_pair(const Arc& one, const Arc& other) {
  if ((one.turn_rad < 0.0F) != (other.turn_rad < 0.0F)) return false;
  return lies_in(one, other) && lies_in(other, one) && face_to_face(one, other);
}

}  // namespace pharos::ellipse
