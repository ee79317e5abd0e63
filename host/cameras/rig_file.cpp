// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/rig_file.hpp"

#include <cmath>

#include "host/cameras/file_parts.hpp"
#include "host/support/exact_number.hpp"

namespace pharos::host {
namespace {

// Both cameras are on one spacecraft, or one bench.
constexpr Range kPosition_m{-1e4, 1e4};
constexpr double kMaxBaseline_m = 100.0;
constexpr Range kQuaternion{-1.001, 1.001};
// A quaternion written with four decimals has a length that is wrong by 1e-4.
constexpr double kLengthTolerance = 1e-3;
// Smallest distance of two cameras: less than that of any two lenses, and such a pair measures no range.
constexpr double kMinBaseline_m = 1e-6;

double length_of(const std::array<double, 4>& q) {
  return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

RigCamera read_camera(const TomlTable& table) {
  RigCamera camera;
  camera.intrinsics = read_intrinsics(table);
  camera.rotation_wxyz = table.vector<4>("rotation_wxyz", kQuaternion);
  if (std::abs(length_of(camera.rotation_wxyz) - 1.0) > kLengthTolerance) {
    table.fail("rotation_wxyz", "is no rotation: the four numbers' squares must add up to 1");
  }
  camera.position_m = table.vector<3>("position_m", kPosition_m);
  return camera;
}

RigFile read_rig(const TomlTable& root) {
  RigFile file;
  file.left = read_camera(root.table("left"));
  const TomlTable right = root.table("right");
  file.right = read_camera(right);
  file.calibration = read_record(root);
  root.reject_unknown();
  if ((file.left.pose().t - file.right.pose().t).norm() < kMinBaseline_m) {
    right.fail("position_m", "is the left camera's: two cameras in one place see no depth");
  }
  if ((file.left.pose().t - file.right.pose().t).norm() > kMaxBaseline_m) {
    right.fail("position_m", "is more than 100 m from the left camera; positions are in metres");
  }
  return file;
}

std::string camera_table(const char* name, const RigCamera& camera) {
  return std::string("\n[") + name + "]\n" + intrinsics_text(camera.intrinsics) +
         "rotation_wxyz = " + exact_list(camera.rotation_wxyz) + "\nposition_m = " + exact_list(camera.position_m) +
         "\n";
}

}  // namespace

Pose<frame::Rig, frame::Camera> RigCamera::pose() const {
  const auto& [w, x, y, z] = rotation_wxyz;
  return {Quaternion(w, x, y, z).normalized().toRotationMatrix(), Vector3(position_m.data())};
}

RigFile read_rig_file(const std::string& path) { return read_rig(TomlTable::parse_file(path)); }

RigFile parse_rig(std::string_view text, const std::string& name) {
  return read_rig(TomlTable::parse_text(text, name));
}

std::string rig_text(const RigFile& file) {
  std::string out =
      "# Each camera's pose in the rig's frame (x right, y down, z ahead): p_rig = R p_camera + position.\n";
  out += camera_table("left", file.left) + camera_table("right", file.right);
  if (file.calibration) out += record_text(*file.calibration);
  return out;
}

}  // namespace pharos::host
