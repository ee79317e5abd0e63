// SPDX-License-Identifier: Apache-2.0
// Two independent renderers give the same image of a scene.
#include "tools/sim/stereo_tumbling/povray_panels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "pharos/geometry/rotation.hpp"
#include "tools/sim/povray/render_scene.hpp"
#include "tools/sim/povray/scene_text.hpp"
#include "tools/sim/stereo_tumbling/cast_panels.hpp"
#include "tools/sim/stereo_tumbling/satellite_scene.hpp"

namespace pharos::sim {
namespace {

constexpr int kRaysPerSide = 4;
// The centre of the satellite, 8 mm a pixel, its edge and a panel.
const Lens kLens{160, 120, 640.0, 630.0, 20.0, 70.0, {}};

struct Both {
  LinearImage povray, rays;
};

Both rendered(const Lighting& lighting) {
  const std::string folder = testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  const PanelScene scene = moved(satellite_scene(1), rotation_exp({0.35, 0.4, 0.1}), {0.1, 0.0, 5.0});
  const Pose<frame::Rig, frame::Camera> T_scene_camera{rotation_exp({0.01, -0.02, 0.03}), Vector3(-0.25, 0.05, 0.0)};
  write_texture_files(scene, folder);
  const std::string text = povray_preamble() + povray_camera(kLens, T_scene_camera.R, T_scene_camera.t) +
                           povray_panels(scene, lighting, folder, 0.0);
  const RayGrid rays = RayGrid::inside_pixels(kLens, kRaysPerSide);
  Both both{render_scene(text, {kLens.width_px, kLens.height_px, kRaysPerSide, 0.0, 1}),
            cast_panels(scene, lighting, kLens, rays, kRaysPerSide, T_scene_camera)};
  std::filesystem::remove_all(folder);
  return both;
}

struct Difference {
  double mean = 0.0, mean_absolute = 0.0, ninety_nine = 0.0;
  double light = 0.0;
};

Difference difference(const Both& both) {
  Difference out;
  std::vector<double> sizes;
  for (std::size_t k = 0; k < both.rays.light.size(); ++k) {
    const double d = static_cast<double>(both.povray.light[k]) - static_cast<double>(both.rays.light[k]);
    const double fraction = 1.0 / static_cast<double>(both.rays.light.size());
    out.mean += fraction * d;
    out.mean_absolute += fraction * std::abs(d);
    out.light += fraction * static_cast<double>(both.rays.light[k]);
    sizes.push_back(std::abs(d));
  }
  std::sort(sizes.begin(), sizes.end());
  out.ninety_nine = sizes[sizes.size() * 99 / 100];
  return out;
}

// The two sample different positions within a pixel: creases of the foil differ, means do not.
void expect_alike(const Lighting& lighting) {
  const Difference found = difference(rendered(lighting));
  EXPECT_GT(found.light, 0.2 * (lighting.ambient + lighting.diffuse));
  EXPECT_LT(std::abs(found.mean), 0.002 * found.light);
  EXPECT_LT(found.mean_absolute, 0.01 * found.light);
  EXPECT_LT(found.ninety_nine, 0.1 * found.light);
}

TEST(PovrayPanels, ShowWhatOwnRaysShowByTheLamp) { expect_alike({0.1, 0.9, Vector3(0.5, -1.0, -1.0)}); }

TEST(PovrayPanels, ShowWhatOwnRaysShowInAmbientLight) { expect_alike({0.1, 0.0, Vector3::Zero()}); }

}  // namespace
}  // namespace pharos::sim
