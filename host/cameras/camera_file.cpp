// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/camera_file.hpp"

#include "host/cameras/file_parts.hpp"
#include "host/support/exact_number.hpp"

namespace pharos::host {
namespace {

// Range of the depth scale: a nanometre to a metre a count.
constexpr Range kScale_m{1e-9, 1.0};
// The zero of depth is within the camera; the origin of raw coordinates may be far from it.
constexpr Range kOrigin_m{-10.0, 10.0};
// Ten times as far as depth cameras see; -8192 is one in millimetres.
constexpr Range kOffset_m{-100.0, 100.0};

CameraFile read(const TomlTable& root) {
  CameraFile file;
  DepthCamera& camera = file.camera;
  camera.intrinsics = read_intrinsics(root);
  camera.depth_scale_m = root.number_or("depth_scale_m", camera.depth_scale_m, kScale_m);
  camera.depth_origin_z_m = root.number_or("depth_origin_z_m", camera.depth_origin_z_m, kOrigin_m);
  camera.scale_m = root.vector_or<3>("scale_m", camera.scale_m, kScale_m);
  camera.offset_m = root.vector_or<3>("offset_m", camera.offset_m, kOffset_m);
  file.calibration = read_record(root);
  root.reject_unknown();
  return file;
}

// Only keys that differ from the defaults: a camera that measures no depth has no depth keys.
std::string depth_text(const DepthCamera& camera) {
  const DepthCamera plain;
  std::string out;
  if (camera.depth_scale_m != plain.depth_scale_m) {
    out += "depth_scale_m = " + exact_number(camera.depth_scale_m) + "  # a count\n";
  }
  if (camera.depth_origin_z_m != plain.depth_origin_z_m) {
    out += "depth_origin_z_m = " + exact_number(camera.depth_origin_z_m) + "\n";
  }
  if (camera.scale_m != plain.scale_m) out += "scale_m = " + exact_list(camera.scale_m) + "  # ABCY16: x, y, z\n";
  if (camera.offset_m != plain.offset_m) out += "offset_m = " + exact_list(camera.offset_m) + "\n";
  return out;
}

}  // namespace

CameraFile read_camera_file(const std::string& path) { return read(TomlTable::parse_file(path)); }

CameraFile parse_camera(std::string_view text, const std::string& name) {
  return read(TomlTable::parse_text(text, name));
}

std::string camera_text(const CameraFile& file) {
  std::string out = intrinsics_text(file.camera.intrinsics) + depth_text(file.camera);
  if (file.calibration) out += record_text(*file.calibration);
  return out;
}

}  // namespace pharos::host
