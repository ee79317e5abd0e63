// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "host/table/pose_table.hpp"
#include "host/table/target_file.hpp"
#include "pharos/pose/precision.hpp"
#include "tests/support/temporary_file.hpp"
#include "tools/layout/layout_search.hpp"

namespace pharos::layout {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::string kScenarios = PHAROS_SOURCE_DIR "/tools/sim/scenarios/";
constexpr Sight kSight{pose::kVisibleIncidence_rad, 0.0};

ConvexBody read(const std::string& text) { return read_body(pharos::test::TemporaryFile(text).path()); }

const std::string kCubeVertices = "0 0 0\n0.1 0 0\n0.1 0.1 0\n0 0.1 0\n0 0 0.1\n0.1 0 0.1\n0.1 0.1 0.1\n0 0.1 0.1\n";
const std::string kCubeFaces = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const std::string kCube = "OFF\n8 6 12\n" + kCubeVertices + kCubeFaces;

void expect_refused(const std::string& text, const std::string& why) {
  EXPECT_THAT([&] { read(text); }, ThrowsMessage<host::InputError>(HasSubstr(why))) << text;
}

std::vector<LighthouseFromBody> manoeuvre_poses() {
  std::vector<LighthouseFromBody> poses;
  for (const host::PoseRow& row : host::read_poses(kScenarios + "manoeuvre_poses.csv", "pose")) {
    poses.push_back(*row.T_lighthouse_body);
  }
  return poses;
}

TEST(ReadBody, KnowsTheFacesOfACube) {
  const ConvexBody cube = read(kCube);
  ASSERT_EQ(cube.facets.size(), 6u);
  Vector3 sum = Vector3::Zero();
  for (const Facet& facet : cube.facets) {
    sum += facet.normal;
    ASSERT_EQ(facet.corners.size(), 4u);
    EXPECT_NEAR(facet.u.cross(facet.v).dot(facet.normal), 1.0, 1e-12);
    EXPECT_GT(facet.normal.dot(facet.origin - Vector3(0.05, 0.05, 0.05)), 0.0);
  }
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST(ReadBody, JoinsTrianglesOfOneFaceAndPassesOverComments) {
  const ConvexBody cube = read("OFF # a cube\n8 7 0\n" + kCubeVertices +
                               "3 0 3 2  255 0 0\n3 0 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  EXPECT_EQ(cube.facets.size(), 6u);
}

TEST(ReadBody, RefusesWhatIsNoClosedConvexBody) {
  expect_refused("", "the file ends");
  expect_refused("PLY\n", "starts with the word OFF");
  expect_refused("OFF\n8 6 12\n0 0 zero\n", "line 3: 'zero' is no number");
  expect_refused("OFF\n8 6 12\n" + kCubeVertices + "4 0 3 2 8\n", "not from 0 to 7");
  expect_refused("OFF\n8 6 12\n" + kCubeVertices + "4 0 3 2 1\n", "the file ends");
  expect_refused("OFF\n999999999 6 12\n", "number of vertices");
  expect_refused("OFF\n8 5 12\n" + kCubeVertices + "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n",
                 "not closed");
  expect_refused("OFF\n8 6 12\n" + kCubeVertices + "4 0 1 2 3\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n",
                 "turn one of them over");
  expect_refused("OFF\n8 6 12\n" + kCubeVertices + "4 1 2 3 0\n4 7 6 5 4\n4 4 5 1 0\n4 5 6 2 1\n4 6 7 3 2\n4 7 4 0 3\n",
                 "inwards");
  std::string millimetres = kCube;
  for (std::size_t at = 0; (at = millimetres.find("0.1", at)) != std::string::npos;) millimetres.replace(at, 3, "100");
  expect_refused(millimetres, "give metres");
  // A cube with its top pushed in.
  expect_refused(
      "OFF\n9 9 0\n" + kCubeVertices +
          "0.05 0.05 0.05\n4 0 3 2 1\n3 4 5 8\n3 5 6 8\n3 6 7 8\n3 7 4 8\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n",
      "not convex");
}

TEST(Statistic, IsMeanWorstOrPercentile) {
  const std::vector<double> values = {4, 1, 3, 2};
  EXPECT_EQ(statistic(values, {Objective::Kind::kMean, 0}), 2.5);
  EXPECT_EQ(statistic(values, {Objective::Kind::kWorst, 0}), 4.0);
  EXPECT_EQ(statistic(values, {Objective::Kind::kPercentile, 50}), 2.0);
  EXPECT_EQ(statistic(values, {Objective::Kind::kPercentile, 100}), 4.0);
}

TEST(LayoutSearch, KeepsItsRulesAndRepeatsItself) {
  const ConvexBody body = read_body(kScenarios + "target12.off");
  std::vector<LighthouseFromBody> poses = manoeuvre_poses();
  poses.resize(20);
  const Rules rules{8, 0.02, 0.005};
  const auto facets = seen_facets(body, poses, kSight.incidence_rad);
  EXPECT_EQ(facets.size(), 5u) << "nobody sees the bottom";
  const LayoutSearch search(body, facets, rules, 7);
  const MountPoints start = *search.spread();
  const Objective mean;
  const LayoutEvaluator evaluator(poses, kSight, mean, 0.5,
                                  score_of(dops_of(target_of(body, start), poses, kSight), mean));
  const MountPoints mount_points = search.best(evaluator, 2, [] {});
  EXPECT_LE(evaluator(target_of(body, mount_points)), evaluator(target_of(body, start)));
  const Target target = target_of(body, mount_points);
  ASSERT_EQ(target.size(), 8u);
  for (std::size_t i = 0; i < target.size(); ++i) {
    const Facet& facet = body.facets[mount_points[i].facet];
    EXPECT_EQ(target[i].normal, facet.normal);
    EXPECT_NEAR(facet.normal.dot(target[i].position_m - facet.origin), 0.0, 2e-5);
    for (std::size_t k = 0; k < facet.corners.size(); ++k) {
      const Vector2 a = facet.corners[k];
      const Vector2 side = (facet.corners[(k + 1) % facet.corners.size()] - a).normalized();
      const Vector2 d = mount_points[i].xy - a;
      EXPECT_GE(side.x() * d.y() - side.y() * d.x(), rules.edge_m - 1e-9);
    }
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((target[i].position_m - target[j].position_m).norm(), rules.spacing_m - 2e-5);
    }
  }
  const Target again = target_of(body, LayoutSearch(body, facets, rules, 7).best(evaluator, 2, [] {}));
  for (std::size_t i = 0; i < target.size(); ++i) EXPECT_EQ(target[i].position_m, again[i].position_m);
}

TEST(LayoutSearch, BeatsThePublishedTargetByAFifthOnItsOwnBody) {
  const ConvexBody body = read_body(kScenarios + "target12.off");
  const std::vector<LighthouseFromBody> poses = manoeuvre_poses();
  const Objective mean;
  const Dops present_dops = dops_of(host::read_target(kScenarios + "target12.csv").target, poses, kSight);
  const Score present = score_of(present_dops, mean);
  EXPECT_NEAR(LayoutEvaluator(poses, kSight, mean, 0.5, present)(host::read_target(kScenarios + "target12.csv").target),
              1.0, 1e-12);
  const LayoutSearch search(body, seen_facets(body, poses, kSight.incidence_rad), Rules{}, 1);
  const MountPoints mount_points = search.best(LayoutEvaluator(poses, kSight, mean, 0.5, present), 1, [] {});
  const Score found = score_of(dops_of(target_of(body, mount_points), poses, kSight), mean);
  EXPECT_EQ(found.measured, poses.size());
  EXPECT_EQ(present.measured, poses.size());
  EXPECT_LE(found.adop_deg_per_rad, 0.8 * present.adop_deg_per_rad);
  EXPECT_LE(found.pdop_m_per_rad, 0.8 * present.pdop_m_per_rad);
}

TEST(LayoutSearch, HasNoAnswerWithoutRoom) {
  const ConvexBody body = read_body(kScenarios + "target12.off");
  EXPECT_FALSE(LayoutSearch(body, {0, 1, 2, 3, 4, 5}, Rules{12, 0.1, 0.003}, 1).spread());
  EXPECT_FALSE(LayoutSearch(body, {0, 1, 2, 3, 4, 5}, Rules{12, 0.01, 0.2}, 1).spread());
  EXPECT_FALSE(LayoutSearch(body, {}, Rules{}, 1).spread());
}

TEST(SeenFacets, AreNoneForABodyBehindTheStation) {
  const ConvexBody body = read_body(kScenarios + "target12.off");
  LighthouseFromBody behind;
  behind.t = {0.0, 0.0, -3.0};
  EXPECT_TRUE(seen_facets(body, {behind}, kSight.incidence_rad).empty());
}

}  // namespace
}  // namespace pharos::layout
