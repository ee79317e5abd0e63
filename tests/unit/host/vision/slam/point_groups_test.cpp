// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/point_groups.hpp"

#include <gtest/gtest.h>

#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

TEST(PointGroups, AreOfNeighboursAndNoneIsSmall) {
  std::mt19937_64 random(1);
  const std::vector<Vector3> points = test::random_points(random, 777);
  const std::vector<std::size_t> groups = point_groups(points, 20);
  std::map<std::size_t, std::vector<Vector3>> members;
  for (std::size_t k = 0; k < points.size(); ++k) members[groups[k]].push_back(points[k]);
  EXPECT_EQ(members.rbegin()->first + 1, members.size());
  for (const auto& [group, places] : members) {
    EXPECT_GE(places.size(), 20U);
    EXPECT_LT(places.size(), 40U);
    Vector3 low = places[0], high = places[0];
    for (const Vector3& place : places) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    EXPECT_LT((high - low).maxCoeff(), 1.0) << "of a box of 1.6 m";
  }
}

TEST(PointGroups, FewPointsAreOneAndEqualOnesAreDividedToo) {
  EXPECT_TRUE(point_groups({}, 20).empty());
  EXPECT_EQ(point_groups(std::vector<Vector3>(39, Vector3::Zero()), 20), std::vector<std::size_t>(39, 0));
  const auto groups = point_groups(std::vector<Vector3>(40, Vector3::Ones()), 20);
  EXPECT_EQ(std::count(groups.begin(), groups.end(), 1U), 20);
}

}  // namespace
}  // namespace pharos::slam
