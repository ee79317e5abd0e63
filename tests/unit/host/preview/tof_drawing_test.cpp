// SPDX-License-Identifier: Apache-2.0
#include "host/preview/tof_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "host/images/picture.hpp"
#include "host/preview/preview_picture.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

// A ring of 0.5 and 0.4 m that faces the camera at 3 m: circles of 100 and 80 px about the image's middle.
TEST(TofDrawing, TheRingsCirclesAreWhereTheCameraSeesThem) {
  DepthCamera camera;
  camera.intrinsics.width_px = 640;
  camera.intrinsics.height_px = 480;
  camera.intrinsics.fx_px = camera.intrinsics.fy_px = 600.0;
  camera.intrinsics.cx_px = 319.5;
  camera.intrinsics.cy_px = 239.5;
  tof::TofPose pose;
  pose.flags = tof::kFlagNoConnector;
  pose.ring.fit.model.centre_m = Vector3(0.0, 0.0, 3.0);
  pose.ring.fit.model.radius_m = {0.5, 0.4};
  pose.target.pose.t = Vector3(0.0, 0.0, 3.0);
  AnnotatedImage image;
  image.width_px = 640;
  image.height_px = 480;
  image.pixels.assign(std::size_t{640} * 480, 0);
  image.drawing = tof_drawing(pose, camera);
  const Picture picture = decode_picture(preview_jpeg(image), "preview");
  std::set<int> directions_outer, directions_inner;  // of 36
  for (std::int32_t v = 0; v < 480; ++v) {
    for (std::int32_t u = 0; u < 640; ++u) {
      const std::uint16_t* rgb = &picture.values[3 * (static_cast<std::size_t>(v) * 640 + static_cast<std::size_t>(u))];
      if (rgb[1] < 120 * 257 || rgb[1] < rgb[2] + 30 * 257 || rgb[1] < rgb[0] + 60 * 257) continue;  // green
      const double x = u - 319.5, y = v - 239.5, radius = std::hypot(x, y);
      const int direction = static_cast<int>((std::atan2(y, x) + kPi) / kTwoPi * 36.0) % 36;
      const bool outer = std::abs(radius - 100.0) < 2.5, inner = std::abs(radius - 80.0) < 2.5;
      EXPECT_TRUE(outer || inner) << u << ' ' << v;
      if (outer) directions_outer.insert(direction);
      if (inner) directions_inner.insert(direction);
    }
  }
  EXPECT_EQ(directions_outer.size(), 36u);
  EXPECT_EQ(directions_inner.size(), 36u);
}

TEST(TofDrawing, WhatIsBehindTheCameraIsNotDrawn) {
  DepthCamera camera;
  camera.intrinsics.fx_px = camera.intrinsics.fy_px = 600.0;
  EXPECT_FALSE(place_of(camera.intrinsics, Vector3(0.1, 0.1, -1.0)).has_value());
}

}  // namespace
}  // namespace pharos::host
