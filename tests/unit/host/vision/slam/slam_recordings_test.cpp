// SPDX-License-Identifier: Apache-2.0
// Real pictures: a drive along a street, 1.2 m from pair to pair.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "host/cameras/rig_file.hpp"
#include "host/device/pair_names.hpp"
#include "host/images/grey_image.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tests/support/real_data.hpp"

namespace pharos::slam {
namespace {

constexpr const char* kDrive = "open/slam/kitti_1";
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::vector<Pose<frame::Camera, frame::Target>> read_truth(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<Pose<frame::Camera, frame::Target>> poses;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream row(line);
    double time_s = 0.0, x = 0.0, y = 0.0, z = 0.0, w = 0.0;
    Vector3 t;
    row >> time_s >> t.x() >> t.y() >> t.z() >> x >> y >> z >> w;
    poses.push_back({Quaternion(w, x, y, z).normalized().toRotationMatrix(), t});
  }
  return poses;
}

std::vector<std::uint8_t> eight_bits(const host::GreyImage& image) {
  std::vector<std::uint8_t> out;
  for (const std::uint16_t value : image.pixels) out.push_back(static_cast<std::uint8_t>(value >> 8U));
  return out;
}

// The truth turns by 0.7 deg otherwise than the pictures do.
TEST(SlamOfADrive, IsFollowedWithoutAWordAboutTheScene) {
  PHAROS_NEEDS_DATA(kDrive);
  const auto folder = test::real_data(kDrive);
  const auto truth = read_truth(folder / "truth.tum");
  const auto pairs = host::pair_names((folder / "image_l").string(), (folder / "image_r").string(), 10.0);
  ASSERT_EQ(pairs.size(), truth.size());
  const host::RigFile rig = host::read_rig_file((folder / "rig.toml").string());
  const auto slam = make_slam(rig, "rig.toml", {});
  for (const host::PairName& pair : pairs) {
    const host::GreyImage left = host::read_grey_image(pair.left), right = host::read_grey_image(pair.right);
    const auto a = eight_bits(left), b = eight_bits(right);
    slam->push(pair.time_s, {a.data(), left.width_px, left.height_px}, {b.data(), right.width_px, right.height_px});
  }
  slam->finish();
  EXPECT_EQ(slam->report().scene, Scene::kStatic);
  EXPECT_GE(slam->report().tracked, 50);
  const auto trajectory = slam->trajectory();
  double path_m = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (k > 0) path_m += (truth[k].inverse().t - truth[k - 1].inverse().t).norm();
    if (!trajectory[k].placed) continue;
    EXPECT_LT(kDegrees * rotation_angle_between(trajectory[k].placed->pose.R, truth[k].R), 1.5) << k;
  }
  ASSERT_TRUE(trajectory.back().placed);
  EXPECT_LT((trajectory.back().placed->pose.t - truth.back().t).norm(), 0.03 * path_m);
}

}  // namespace
}  // namespace pharos::slam
