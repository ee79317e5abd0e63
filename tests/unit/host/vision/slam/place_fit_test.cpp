// SPDX-License-Identifier: Apache-2.0
// A place seen again: corners that are all found to one side, and the patches of its points.
#include <gtest/gtest.h>

#include "host/vision/slam/loop_closing.hpp"
#include "host/vision/slam/loop_evidence.hpp"
#include "host/vision/slam/mapping.hpp"
#include "host/vision/slam/pyramid_copy.hpp"
#include "simulated_wall.hpp"

namespace pharos::slam {
namespace {

using namespace test;

constexpr double kTurn_rad = 0.25;
const Vector2 kCornersOff_px{0.7, 0.4};

class PlaceSeenAgain : public ::testing::Test {
 protected:
  PlaceSeenAgain() {
    add(turned_pose(0.0), first_, Vector2::Zero());
    add(there_pose_, later_, kCornersOff_px);
  }

  // A keyframe that sees the grid of places; its points are its own.
  void add(const CameraFromTarget& pose, const std::vector<std::uint8_t>& image, const Vector2& corners_off_px) {
    Frame frame;
    frame.pose = pose;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Vector2 seen = kCamera.project(pose * places_[k]).head<2>();
      Feature feature = wall_.feature(pose, seen);
      feature.pixel += corners_off_px;
      feature.right_u_px += corners_off_px.x();
      feature.descriptor = descriptors_[k];
      frame.features.push_back(feature);
    }
    frame.grid = FeatureGrid(frame.features, kCamera.width_px, kCamera.height_px);
    frame.points.assign(frame.features.size(), kNone);
    const KeyframeId id = map_.add_keyframe(frame, {}).id;
    add_stereo_points(map_, id, kCamera);
    add_patches(map_, id, pyramid_of(image));
  }

  std::vector<Vector3> places_on_the_wall() const {
    std::vector<Vector3> out;
    for (int v = 100; v <= 380; v += 35) {
      for (int u = 180; u <= 460; u += 35) out.push_back(wall_.hit(turned_pose(0.0), Vector2(u, v)));
    }
    return out;
  }
  std::vector<Descriptor> one_each() {
    std::vector<Descriptor> out;
    for (std::size_t k = 0; k < places_.size(); ++k) out.push_back(descriptor_of(random_));
    return out;
  }
  PlaceFit fit(const std::vector<PyramidLevel>& pyramid) const {
    return fit_place(map_, map_.keyframes.at(1), there_pose_, 0, kCamera, pyramid);
  }
  double error_m(const PlaceFit& found) const { return (found.pose.pose.inverse().t - there_pose_.inverse().t).norm(); }

  std::mt19937_64 random_{3};
  Wall wall_;
  CameraFromTarget there_pose_ = turned_pose(kTurn_rad);
  std::vector<std::uint8_t> first_ = wall_.seen(turned_pose(0.0)), later_ = wall_.seen(there_pose_);
  std::vector<Vector3> places_ = places_on_the_wall();
  std::vector<Descriptor> descriptors_ = one_each();
  Map map_;
};

TEST_F(PlaceSeenAgain, ItsPatchesTellThePoseThatItsCornersMiss) {
  const PlaceFit corners = fit({}), patches = fit(pyramid_of(later_));
  EXPECT_TRUE(corners.aligned.empty());
  EXPECT_GT(patches.aligned.size(), places_.size() / 2);
  EXPECT_EQ(patches.pose.inliers, corners.pose.inliers) << "as many as fit as corners";
  EXPECT_GT(error_m(corners), 0.003);
  // A patch is stated to be located to a tenth of a pixel, the corners are off by 0.8.
  EXPECT_LT(error_m(patches), kPatchSigma_px / kCornersOff_px.norm() * error_m(corners));
}

// Observations at the aligned positions bind the two keyframes; both keep their own points and patches.
TEST_F(PlaceSeenAgain, ALoopIsClosedByAlignedObservationsAndFusesNothing) {
  const PlaceFit found = fit(pyramid_of(later_));
  const std::size_t points = map_.points.size(), features = map_.keyframes.at(1).features.size();
  const KeyframeDatabase words(Vocabulary::train({{descriptors_}}, 8, 3, 1));
  LoopCloser(kCamera, map_, words).correct({1, 0, found.pose.pose, {}, found.seen, {{1, found.aligned}}});
  const Keyframe& here = map_.keyframes.at(1);
  EXPECT_EQ(map_.points.size(), points);
  ASSERT_EQ(here.features.size(), features + found.aligned.size());
  ASSERT_EQ(here.points.size(), here.features.size());
  for (std::size_t k = features; k < here.features.size(); ++k) {
    EXPECT_TRUE(map_.points.at(here.points[k]).seen_by.contains(0));
    EXPECT_FALSE(here.features[k].is_corner());
  }
  EXPECT_TRUE(here.neighbours.contains(0));
}

// A dozen in each of two keyframes are enough.
TEST_F(PlaceSeenAgain, ALoopIsClosedByTheAlignedObservationsOfAllItsKeyframes) {
  const CameraFromTarget next_pose = turned_pose(0.9 * kTurn_rad);
  const std::vector<std::uint8_t> next_image = wall_.seen(next_pose);
  add(next_pose, next_image, kCornersOff_px);
  const PlaceFit found = fit(pyramid_of(later_));
  const PlaceFit next = fit_place(map_, map_.keyframes.at(2), next_pose, 0, kCamera, pyramid_of(next_image));
  std::map<KeyframeId, std::vector<AlignedPoint>> aligned{{1, found.aligned}, {2, next.aligned}};
  for (auto& [id, points] : aligned) {
    ASSERT_GT(points.size(), 12U);
    points.resize(12);
  }
  const std::size_t points = map_.points.size();
  const KeyframeDatabase words(Vocabulary::train({{descriptors_}}, 8, 3, 1));
  LoopCloser(kCamera, map_, words).correct({1, 0, found.pose.pose, {}, found.seen, aligned});
  EXPECT_EQ(map_.points.size(), points) << "nothing is fused";
  for (const auto& [id, observed] : aligned) {
    for (const auto& [point, feature] : observed) EXPECT_TRUE(map_.points.at(point).seen_by.contains(id)) << id;
  }
}

TEST_F(PlaceSeenAgain, ACopyOfThePyramidOutlivesTheImage) {
  std::vector<std::uint8_t> image = later_;
  PyramidCopy copy(pyramid_of(image));
  image.assign(image.size(), 0);
  const PyramidCopy moved = std::move(copy);
  EXPECT_EQ(error_m(fit(moved.levels())), error_m(fit(pyramid_of(later_))));
}

}  // namespace
}  // namespace pharos::slam
