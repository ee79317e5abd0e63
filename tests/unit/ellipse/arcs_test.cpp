// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/arcs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pharos/ellipse/arc_pair.hpp"
#include "pharos/ellipse/polygon.hpp"
#include "pharos/ellipse/smooth.hpp"

namespace pharos::ellipse {
namespace {

constexpr double kPi = std::numbers::pi;

// Edge points along a circle from one angle to another; bright inside runs with falling angle.
void append_arc(std::vector<EdgePoint>& points, double cx, double cy, double radius, double from, double to) {
  const int count = static_cast<int>(std::abs(to - from) * radius);
  const double towards = to > from ? 1.0 : -1.0;  // gradient: outwards where the angle rises
  for (int k = 0; k <= count; ++k) {
    const double angle = from + (to - from) * k / count;
    const double c = std::cos(angle), s = std::sin(angle);
    points.push_back({static_cast<float>(cx + radius * c), static_cast<float>(cy + radius * s),
                      static_cast<std::int16_t>(towards * 1000.0 * c), static_cast<std::int16_t>(towards * 1000.0 * s),
                      0, 0});
  }
}

std::unique_ptr<EllipseWorkspace> arcs_of(const std::vector<EdgePoint>& points) {
  auto workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  for (const EdgePoint& p : points) workspace->ordered.push_back(p);
  auto contours = std::make_unique<Contours>();
  contours->push_back({0, static_cast<std::uint32_t>(points.size())});
  find_arcs(*contours, *workspace);
  return workspace;
}

TEST(Arcs, TheBendChangesWhereSignsDiffer) {
  EXPECT_TRUE(bend_changes(0.3F, -0.2F));
  EXPECT_TRUE(bend_changes(-0.1F, 0.4F));
  EXPECT_FALSE(bend_changes(0.3F, 0.2F));
  EXPECT_FALSE(bend_changes(-0.3F, -0.5F));
  EXPECT_FALSE(bend_changes(0.0F, 0.5F));
}

TEST(Arcs, AWholeCircleIsOneArcThatTurnsOnce) {
  std::vector<EdgePoint> points;
  append_arc(points, 100.0, 100.0, 40.0, 0.0, -2.0 * kPi);
  const auto workspace = arcs_of(points);
  ASSERT_EQ(workspace->arcs.size(), 1U);
  // Directions at the ends are means of four points: 1.5 px short at each.
  EXPECT_NEAR(workspace->arcs[0].turn_rad, -2.0 * kPi, 2.0 * 1.5 / 40.0 + 0.02);
  EXPECT_TRUE(workspace->arcs[0].seed);
}

TEST(Arcs, AnSIsTwoArcsOfOppositeBend) {
  std::vector<EdgePoint> points;
  append_arc(points, 100.0, 100.0, 40.0, kPi, 2.0 * kPi);  // over the top, left to right
  std::vector<EdgePoint> back;
  append_arc(back, 180.0, 100.0, 40.0, kPi, 0.0);  // then under, left to right
  points.insert(points.end(), back.begin() + 1, back.end());
  const auto workspace = arcs_of(points);
  ASSERT_EQ(workspace->arcs.size(), 2U);
  EXPECT_GT(workspace->arcs[0].turn_rad, 2.0F);
  EXPECT_LT(workspace->arcs[1].turn_rad, -2.0F);
}

TEST(Arcs, ACornerEndsAnArc) {
  std::vector<EdgePoint> points;
  append_arc(points, 100.0, 100.0, 40.0, 0.0, 0.5 * kPi);
  std::vector<EdgePoint> next;
  append_arc(next, 140.0, 140.0, 40.0, kPi, 1.5 * kPi);  // its tangent there is turned by 90 deg
  points.insert(points.end(), next.begin() + 1, next.end());
  EXPECT_EQ(arcs_of(points)->arcs.size(), 2U);
}

TEST(Arcs, StraightAndShortOnesGo) {
  std::vector<EdgePoint> line, few;
  for (int k = 0; k < 100; ++k) line.push_back({static_cast<float>(k), 50.0F, 0, 1000, 0, 0});
  EXPECT_TRUE(arcs_of(line)->arcs.empty());
  append_arc(few, 100.0, 100.0, 4.0, 0.0, 1.5);
  EXPECT_TRUE(arcs_of(few)->arcs.empty());
}

TEST(Polygon, KeepsEveryPointWithinTheTolerance) {
  std::vector<EdgePoint> points;
  append_arc(points, 0.0, 0.0, 60.0, 0.0, 4.0);
  auto vertices = std::make_unique<Vertices>();
  approximate_polygon(points, 0.7F, *vertices);
  EXPECT_EQ(vertices->back(), points.size() - 1);
  for (std::size_t k = 1; k < vertices->size(); ++k) {
    const EdgePoint &a = points[(*vertices)[k - 1]], &b = points[(*vertices)[k]];
    const auto chord = static_cast<double>(std::hypot(b.u_px - a.u_px, b.v_px - a.v_px));
    EXPECT_LT(chord, 2.0 * std::sqrt(8.0 * 60.0 * 0.7));
    EXPECT_LE(60.0 - std::sqrt(60.0 * 60.0 - 0.25 * chord * chord), 0.71);  // sagitta
  }
}

Arc arc_between(double from, double to) {
  std::vector<EdgePoint> points;
  append_arc(points, 200.0, 200.0, 80.0, from, to);
  const auto workspace = arcs_of(points);
  EXPECT_EQ(workspace->arcs.size(), 1U);
  return workspace->arcs.empty() ? Arc{} : workspace->arcs[0];
}

TEST(ArcPair, TwoArcsOfOneCircleMayPair) {
  const Arc one = arc_between(0.0, 1.4);
  EXPECT_TRUE(may_pair(one, arc_between(2.5, 4.0)));
  EXPECT_TRUE(may_pair(one, arc_between(1.5, 2.5)));  // next to one another
  EXPECT_TRUE(may_pair(arc_between(2.5, 4.0), one));
}

TEST(ArcPair, ArcsThatBendAwayOrLieOutsideMayNot) {
  const Arc one = arc_between(0.0, 1.4);
  std::vector<EdgePoint> points;
  append_arc(points, 400.0, 400.0, 80.0, 3.6, 5.0);  // beyond the first one's tangents, bent towards it
  EXPECT_FALSE(may_pair(one, arcs_of(points)->arcs[0]));
  EXPECT_FALSE(may_pair(one, arc_between(4.0, 2.5)));  // brightness on its other side
  Arc copy = one;                                      // the same direction, behind the chord
  for (PointF* p : {&copy.start, &copy.middle, &copy.finish}) {
    p->u += 60.0F;
    p->v += 60.0F;
  }
  EXPECT_FALSE(may_pair(one, copy));
}

TEST(Smooth, KeepsEvenImagesAndSpreadsAPointAsABinomial) {
  std::vector<std::uint16_t> flat(32 * 32, 1000), scratch(32 * 32), out(32 * 32);
  const ImageView<std::uint16_t> view(flat.data(), 32, 32), to(out.data(), 32, 32);
  const int shift = smooth(view, {scratch.data(), 32, 32}, to);
  EXPECT_EQ(shift, 6);  // 1000 needs 10 of 16 bits
  for (const std::uint16_t value : out) EXPECT_EQ(value, 1000U << 6);
  std::fill(flat.begin(), flat.end(), std::uint16_t{0});
  view.at(16, 16) = 65535;
  EXPECT_EQ(smooth(view, {scratch.data(), 32, 32}, to), 0);
  EXPECT_NEAR(to.at(16, 16), 65535.0 * 36.0 / 256.0, 8.0);
  EXPECT_NEAR(to.at(17, 15), 65535.0 * 16.0 / 256.0, 8.0);
  EXPECT_NEAR(to.at(18, 16), 65535.0 * 6.0 / 256.0, 8.0);
  EXPECT_LE(to.at(19, 16), 8);
}

// Four times the rounded mean of two neighbours, rows first, borders repeated: to the last bit, at every width.
TEST(Smooth, IsFourMeansOfTwoNeighboursEachWay) {
  const auto filtered = [](std::vector<std::uint32_t> line) {
    line.insert(line.begin(), 2, line.front());
    line.insert(line.end(), 2, line.back());
    for (int pass = 0; pass < 4; ++pass) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) line[k] = (line[k] + line[k + 1] + 1) / 2;
      line.pop_back();
    }
    return line;
  };
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{8, 9}, std::pair{257, 8}, std::pair{511, 12}}) {
    const auto pixels = static_cast<std::size_t>(width * height);
    std::vector<std::uint16_t> image(pixels), scratch(pixels), out(pixels);
    for (std::uint16_t& value : image) value = static_cast<std::uint16_t>(random());
    image[0] = 65535;  // no shift
    smooth({image.data(), width, height}, {scratch.data(), width, height}, {out.data(), width, height});
    std::vector<std::vector<std::uint32_t>> rows;
    for (int v = 0; v < height; ++v)
      rows.push_back(filtered({image.begin() + v * width, image.begin() + (v + 1) * width}));
    for (int u = 0; u < width; ++u) {
      std::vector<std::uint32_t> column;
      for (const auto& row : rows) column.push_back(row[static_cast<std::size_t>(u)]);
      column = filtered(column);
      for (int v = 0; v < height; ++v) {
        ASSERT_EQ(out[static_cast<std::size_t>(v * width + u)], column[static_cast<std::size_t>(v)]) << u << ", " << v;
      }
    }
  }
}

}  // namespace
}  // namespace pharos::ellipse
