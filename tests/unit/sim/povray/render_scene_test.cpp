// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/render_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "host/support/exact_number.hpp"
#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tools/sim/povray/scene_text.hpp"

namespace pharos::sim {
namespace {

std::string glowing_ball(const Vector3& centre_m, double radius_m, double light) {
  return "sphere { " + povray_vector(centre_m) + ", " + host::exact_number(radius_m) + " pigment { rgb " +
         host::exact_number(light) + " } finish { emission 1 ambient 0 diffuse 0 } }\n";
}

struct Blob {
  double u_px = 0.0;
  double v_px = 0.0;
  double area_px2 = 0.0;
};

Blob blob_in(const LinearImage& image, double light) {
  Blob blob;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      const double fraction = static_cast<double>(image.at(u, v)) / light;
      blob.area_px2 += fraction;
      blob.u_px += fraction * u;
      blob.v_px += fraction * v;
    }
  }
  blob.u_px /= blob.area_px2;
  blob.v_px /= blob.area_px2;
  return blob;
}

TEST(RenderScene, PutsAPointWhereThePinholeHasIt) {
  // Principal point far from the centre, unequal focal lengths, a camera with another position and direction.
  const Lens lens{160, 120, 300.0, 280.0, 61.3, 70.8, {}};
  const Matrix3 R_world_camera = rotation_exp({0.2, -0.4, 0.7});
  const Vector3 t_world_camera(0.5, -1.0, 2.0);
  const Vector3 ball_camera(0.12, -0.09, 3.0);
  const Vector3 ball_world = R_world_camera * ball_camera + t_world_camera;
  const LinearImage image = render_scene(
      povray_preamble() + povray_camera(lens, R_world_camera, t_world_camera) + glowing_ball(ball_world, 0.06, 0.5),
      {.width_px = 160, .height_px = 120, .rays_per_side = 9, .antialias_threshold = 0.0});
  const Blob blob = blob_in(image, 0.5);
  // A small sphere's image is an ellipse whose centre is (radius/range)^2 farther out than its centre's image.
  EXPECT_NEAR(blob.u_px, 61.3 + 300.0 * 0.12 / 3.0 * (1.0 + 4e-4), 0.02);
  EXPECT_NEAR(blob.v_px, 70.8 - 280.0 * 0.09 / 3.0 * (1.0 + 4e-4), 0.02);
  EXPECT_NEAR(blob.area_px2, std::numbers::pi * 300.0 * 280.0 * 4e-4, 0.5);
}

TEST(RenderScene, LightIsLinear) {
  const Lens lens = centred_lens(8, 8, 10.0);
  const auto light_of = [&](double light) {
    const LinearImage image =
        render_scene(povray_preamble() + povray_camera(lens, Matrix3::Identity(), Vector3::Zero()) +
                         glowing_ball({0, 0, 5}, 4.0, light),
                     {.width_px = 8, .height_px = 8, .rays_per_side = 1});
    return static_cast<double>(image.at(4, 4));
  };
  EXPECT_NEAR(light_of(0.01), 0.01, 2e-5);
  EXPECT_NEAR(light_of(0.8), 0.8, 2e-5);
}

TEST(RenderScene, SaysWhatIsWrongWithAScene) {
  try {
    render_scene("sphere { <0, 0, 0>, 1 pigmint }", {.width_px = 8, .height_px = 8});
    FAIL() << "no error";
  } catch (const host::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("pigmint"));
  }
}

TEST(RenderScene, SaysWhatToInstallWherePovrayIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string message;
  try {
    render_scene("", {.width_px = 8, .height_px = 8});
  } catch (const host::InputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, testing::HasSubstr("install povray"));
}

}  // namespace
}  // namespace pharos::sim
