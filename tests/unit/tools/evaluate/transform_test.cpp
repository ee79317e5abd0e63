// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/support/input_error.hpp"
#include "tools/evaluate/known_transform.hpp"

namespace pharos::evaluate {
namespace {

Alignment transform_in(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) / "known_transform.csv";
  std::ofstream(path) << text;
  return read_transform(path.string());
}

// psi_0 of section 4.3 of paper 002.
TEST(KnownTransform, ReadsPaperTwosOwnForm) {
  const Alignment alignment =
      transform_in("phi_x_rad,phi_y_rad,phi_z_rad,x_mm,y_mm,z_mm\n-1.4620,1.3741,-1.0023,6.8050e2,6.2403e2,2.8839e3\n");
  const Vector3 phi(-1.4620, 1.3741, -1.0023);
  EXPECT_TRUE(alignment.world.R.isApprox(rotation_exp(-phi), 1e-12));
  EXPECT_TRUE(alignment.world.t.isApprox(Vector3(0.68050, 0.62403, 2.8839), 1e-12));
  EXPECT_TRUE(alignment.body.R.isIdentity());
}

TEST(KnownTransform, ReadsAPoseAndARowOfEvaluateItself) {
  EXPECT_TRUE(transform_in("qw,qx,qy,qz,tx_m,ty_m,tz_m\n0,1,0,0,1,2,3\n")
                  .world.R.isApprox(Matrix3(Vector3(1, -1, -1).asDiagonal()), 1e-12));
  const Alignment both = transform_in(
      "align,world_qw,world_qx,world_qy,world_qz,world_tx_m,world_ty_m,world_tz_m,body_qw,body_qx,body_qy,body_qz,"
      "body_tx_m,body_ty_m,body_tz_m\nhand-eye,1,0,0,0,1,2,3,0,0,1,0,4,5,6\n");
  EXPECT_EQ(both.world.t, Vector3(1, 2, 3));
  EXPECT_EQ(both.body.t, Vector3(4, 5, 6));
}

TEST(KnownTransform, RefusesOtherForms) {
  EXPECT_THROW(transform_in("qw,qx,qy,qz,tx_m,ty_m,tz_m\n"), host::InputError);
  EXPECT_THROW(transform_in("qw,qx,qy,qz,tx_m,ty_m,tz_m\n0.5,0,0,0,1,2,3\n"), host::InputError);
  EXPECT_THROW(transform_in("qw,qx,qy,qz,tx_m,ty_m,tz_m\n1,0,0,0,1,2,3\n1,0,0,0,1,2,3\n"), host::InputError);
  EXPECT_THROW(transform_in("qw,qx,qy,qz,tx_m,ty_m\n1,0,0,0,1,2\n"), host::InputError);
}

}  // namespace
}  // namespace pharos::evaluate
