// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/arc.hpp"

namespace pharos::ellipse {

/// Whether `point` lies in the arc's search region: between the tangents of its ends, on the far side of its chord. The
/// rest of any convex curve through the arc must lie there (paper 000, figure 4 (a)).
bool in_search_region(const Arc& arc, PointF point);

/// Whether the line between the arcs' middles intersects first one's chord, then the other's: p1 p2 = p1 p1' + p1' p2'
/// + p2' p2 (paper 000, figure 4 (b)-(d)).
bool face_to_face(const Arc& one, const Arc& other);

/// Two arcs may belong to one ellipse: they curve around the same side of brightness, each lies in the other's search
/// region, and they face each other.
bool may_pair(const Arc& one, const Arc& other);

}  // namespace pharos::ellipse
