// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/contours.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::ellipse {
namespace {

// Shorter lines contain no information about an ellipse.
constexpr std::uint32_t kMinContourPoints = 5;
// Next point: within 60 deg of the edge's direction, its gradient within 60 deg of this one's.
constexpr float kMinAlignment = 0.5F;

struct Step {
  float u = 0.0F, v = 0.0F;
};

float dot(Step a, Step b) { return a.u * b.u + a.v * b.v; }

Step gradient_of(const EdgePoint& p) { return {static_cast<float>(p.gradient_u), static_cast<float>(p.gradient_v)}; }

// The plane's number of the best neighbour `ahead` (+1) or behind (-1) along the edge; 0 where the line ends.
std::uint16_t neighbour(const EllipseWorkspace& workspace, ImageView<const std::uint16_t> places, const EdgePoint& p,
                        float ahead) {
  const Step gradient = gradient_of(p);
  const float length = std::sqrt(dot(gradient, gradient));
  const Step along{-gradient.v * ahead / length, gradient.u * ahead / length};
  std::uint16_t best = 0;
  float minimum = 1e9F;
  for (std::int32_t dv = -1; dv <= 1; ++dv) {
    const std::uint16_t* row = places.row(p.row + dv) + p.column;  // no edge point lies on the border
    for (std::int32_t du = -1; du <= 1; ++du) {
      const std::uint16_t place = row[du];
      if (place == 0) continue;
      const EdgePoint& q = workspace.edges[place - 1U];
      const Step step{q.u_px - p.u_px, q.v_px - p.v_px};
      const float squared = dot(step, step), forward = dot(step, along);
      if (forward <= 0.0F || forward * forward < kMinAlignment * kMinAlignment * squared || squared >= minimum)
        continue;
      const Step other = gradient_of(q);
      const float alike = dot(gradient, other);
      if (alike < 0.0F || alike * alike < kMinAlignment * kMinAlignment * length * length * dot(other, other)) continue;
      minimum = squared;
      best = place;
    }
  }
  return best;
}

class Follower {
 public:
  Follower(ImageView<std::uint16_t> places, EllipseWorkspace& workspace) : places_(places), workspace_(workspace) {}

  // Appends the line through `seed` to the order; its points are removed from `places`.
  void follow(std::uint32_t seed) {
    const std::uint32_t begin = count_;
    walk(seed, -1.0F);
    std::reverse(workspace_.order.begin() + begin, workspace_.order.begin() + count_);
    --count_;  // the seed is repeated as the first of the other direction
    walk(seed, 1.0F);
    if (count_ - begin < kMinContourPoints) count_ = begin;
  }
  std::uint32_t count() const { return count_; }

 private:
  void walk(std::uint32_t index, float ahead) {
    for (;;) {
      const EdgePoint& p = workspace_.edges[index];
      workspace_.order[count_++] = static_cast<std::uint16_t>(index);
      places_.at(p.column, p.row) = 0;
      const std::uint16_t next = neighbour(workspace_, places_, p, ahead);
      if (next == 0) return;
      index = next - 1U;
    }
  }

  ImageView<std::uint16_t> places_;
  EllipseWorkspace& workspace_;
  std::uint32_t count_ = 0;
};

// Joins: ends and starts at most this far apart; the line between them and both directions within 40 deg.
constexpr float kMaxGap_px = 5.0F;
constexpr float kMinJoinAlignment = 0.77F;
// Nearer than this the direction of the gap is noise.
constexpr float kTouching_px = 1.5F;
// Directions at ends are averaged over this many points: the last gradient is often disturbed by the end of the line.
constexpr std::uint32_t kContourEndPoints = 6;
constexpr std::uint16_t kNone = 0xFFFF;

class Joiner {
 public:
  Joiner(const EllipseWorkspace& workspace, const Contours& lines) : workspace_(workspace), lines_(lines) {
    for (std::size_t k = 0; k < lines.size(); ++k) next_[k] = previous_[k] = kNone;
  }

  // `places` serves as the map of starts: 1 + line that starts at the pixel.
  void join(ImageView<std::uint16_t> places) {
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const EdgePoint& p = start(k);
      places.at(p.column, p.row) = static_cast<std::uint16_t>(k + 1);
    }
    for (std::size_t k = 0; k < lines_.size(); ++k) join_end(k, places);
  }
  std::uint16_t next(std::size_t k) const { return next_[k]; }
  std::uint16_t previous(std::size_t k) const { return previous_[k]; }

 private:
  const EdgePoint& point(std::uint32_t position) const { return workspace_.edges[workspace_.order[position]]; }
  const EdgePoint& start(std::size_t k) const { return point(lines_[k].begin); }
  const EdgePoint& finish(std::size_t k) const { return point(lines_[k].end - 1); }

  static Step between(const EdgePoint& from, const EdgePoint& to) { return {to.u_px - from.u_px, to.v_px - from.v_px}; }
  static Step unit(Step s) {
    const float length = std::sqrt(dot(s, s));
    return length > 0.0F ? Step{s.u / length, s.v / length} : Step{};
  }
  std::uint32_t reach(std::size_t k) const { return std::min(kContourEndPoints, lines_[k].end - lines_[k].begin) - 1; }
  Step start_direction(std::size_t k) const { return unit(between(start(k), point(lines_[k].begin + reach(k)))); }
  Step finish_direction(std::size_t k) const { return unit(between(point(lines_[k].end - 1 - reach(k)), finish(k))); }

  void join_end(std::size_t k, ImageView<const std::uint16_t> places) {
    const EdgePoint& end = finish(k);
    const Step direction = finish_direction(k);
    constexpr auto kReach = static_cast<std::int32_t>(kMaxGap_px);
    float minimum = kMaxGap_px * kMaxGap_px;
    std::uint16_t best = kNone;
    for (std::int32_t v = end.row - kReach; v <= end.row + kReach; ++v) {
      for (std::int32_t u = end.column - kReach; u <= end.column + kReach; ++u) {
        if (!places.contains(u, v) || places.at(u, v) == 0) continue;
        const auto other = static_cast<std::uint16_t>(places.at(u, v) - 1U);
        if (other == k || previous_[other] != kNone) continue;
        const Step gap = between(end, start(other));
        const float squared = dot(gap, gap);
        if (squared >= minimum || dot(direction, start_direction(other)) < kMinJoinAlignment) continue;
        if (squared > kTouching_px * kTouching_px && dot(unit(gap), direction) < kMinJoinAlignment) continue;
        minimum = squared;
        best = other;
      }
    }
    if (best == kNone) return;
    next_[k] = best;
    previous_[best] = static_cast<std::uint16_t>(k);
  }

  const EllipseWorkspace& workspace_;
  const Contours& lines_;
  std::array<std::uint16_t, kMaxContours> next_;
  std::array<std::uint16_t, kMaxContours> previous_;
};

// Copies the lines chained from `first` into the ordered points: one contour.
void copy_chain(const Contours& lines, const Joiner& joiner, std::size_t first, std::array<bool, kMaxContours>& copied,
                EllipseWorkspace& workspace, Contours& contours) {
  const auto begin = static_cast<std::uint32_t>(workspace.ordered.size());
  for (std::size_t k = first; k != kNone && !copied[k]; k = joiner.next(k)) {
    copied[k] = true;
    for (std::uint32_t position = lines[k].begin; position < lines[k].end; ++position) {
      workspace.ordered.push_back(workspace.edges[workspace.order[position]]);
    }
  }
  contours.push_back({begin, static_cast<std::uint32_t>(workspace.ordered.size())});
}

}  // namespace

void follow_contours(ImageView<const std::uint16_t> magnitude, std::uint16_t high, ImageView<std::uint16_t> places,
                     EllipseWorkspace& workspace, Contours& contours) {
  Contours& lines = contours;
  lines.clear();
  Follower follower(places, workspace);
  for (std::uint32_t k = 0; k < workspace.edges.size(); ++k) {
    const EdgePoint& p = workspace.edges[k];
    if (places.at(p.column, p.row) == 0 || magnitude.at(p.column, p.row) < high) continue;
    const std::uint32_t begin = follower.count();
    follower.follow(k);
    if (follower.count() == begin) continue;
    if (!lines.push_back({begin, follower.count()})) ++workspace.counters.contours_dropped;
  }
  for (const EdgePoint& p : workspace.edges) places.at(p.column, p.row) = 0;  // points that were not followed
  Contours joined;
  Joiner joiner(workspace, lines);
  joiner.join(places);
  std::array<bool, kMaxContours> copied{};
  workspace.ordered.clear();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (joiner.previous(k) == kNone) copy_chain(lines, joiner, k, copied, workspace, joined);
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {  // rings of lines: any of them may be the first
    if (!copied[k]) copy_chain(lines, joiner, k, copied, workspace, joined);
  }
  contours = joined;
  workspace.counters.contours = static_cast<std::uint32_t>(contours.size());
}

}  // namespace pharos::ellipse
