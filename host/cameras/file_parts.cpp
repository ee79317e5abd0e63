// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/file_parts.hpp"

#include <algorithm>

#include "host/support/exact_number.hpp"
#include "host/support/toml_text.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kLargestSide_px = 32768;
// A telescope of 30 m focal length on pixels of 3 um has 1e7; the principal point of a cropped image may be outside of
// it (no file of ours describes such a one); narrow fields of view have large coefficients.
constexpr Range kFocalLength_px{1.0, 1e9};
constexpr Range kPrincipalPoint_px{-1e6, 1e6};  // then held against the image
constexpr Range kDistortion{-1e12, 1e12};
// Two cameras with nine values each, and their relative pose.
constexpr std::size_t kMaxParameters = 24;
constexpr std::int64_t kMaxCounted = 1'000'000'000;

// Whether k1, k2, k3 map greater angles to greater radii, as every lens does, out to the corner that is nearest to the
// principal point: d/dr of r (1 + k1 r^2 + k2 r^4 + k3 r^6).
bool is_monotonic(const PinholeCamera& camera) {
  const double x = std::min(camera.cx_px, camera.width_px - camera.cx_px) / camera.fx_px;
  const double y = std::min(camera.cy_px, camera.height_px - camera.cy_px) / camera.fy_px;
  const double corner = x * x + y * y;
  constexpr int kSteps = 32;
  for (int i = 1; i <= kSteps; ++i) {
    const double r2 = corner * i / kSteps;
    const double k1 = camera.distortion[0], k2 = camera.distortion[1], k3 = camera.distortion[4];
    if (1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3)) <= 0.0) return false;
  }
  return true;
}

}  // namespace

PinholeCamera read_intrinsics(const TomlTable& table) {
  PinholeCamera intrinsics;
  intrinsics.width_px = static_cast<std::int32_t>(table.integer("width_px", 1, kLargestSide_px));
  intrinsics.height_px = static_cast<std::int32_t>(table.integer("height_px", 1, kLargestSide_px));
  intrinsics.fx_px = table.number("fx_px", kFocalLength_px);
  intrinsics.fy_px = table.number("fy_px", kFocalLength_px);
  intrinsics.cx_px = table.number("cx_px", kPrincipalPoint_px);
  intrinsics.cy_px = table.number("cy_px", kPrincipalPoint_px);
  if (intrinsics.cx_px < 0.0 || intrinsics.cx_px > intrinsics.width_px)
    table.fail("cx_px", "lies outside of the image");
  if (intrinsics.cy_px < 0.0 || intrinsics.cy_px > intrinsics.height_px)
    table.fail("cy_px", "lies outside of the image");
  intrinsics.distortion = table.vector<5>("distortion", kDistortion);
  if (!is_monotonic(intrinsics)) {
    table.fail("distortion", "folds the image: within it a ray further from the axis is seen nearer to it");
  }
  return intrinsics;
}

std::string intrinsics_text(const PinholeCamera& intrinsics) {
  std::string out = "width_px = " + std::to_string(intrinsics.width_px) + "\n";
  out += "height_px = " + std::to_string(intrinsics.height_px) + "\n";
  out += "fx_px = " + exact_number(intrinsics.fx_px) + "\n";
  out += "fy_px = " + exact_number(intrinsics.fy_px) + "\n";
  out += "cx_px = " + exact_number(intrinsics.cx_px) + "\n";
  out += "cy_px = " + exact_number(intrinsics.cy_px) + "\n";
  return out + "distortion = " + exact_list(intrinsics.distortion) + "  # k1, k2, p1, p2, k3\n";
}

std::optional<CalibrationRecord> read_record(const TomlTable& root) {
  if (!root.has("calibration")) return std::nullopt;
  const TomlTable table = root.table("calibration");
  CalibrationRecord record;
  record.images = table.integer("images", 0, kMaxCounted);
  record.points = table.integer("points", 0, kMaxCounted);
  record.rms_px = table.number("rms_px", kNotNegative);
  record.parameters = table.texts("parameters");
  if (record.parameters.size() > kMaxParameters) table.fail("parameters", "more than two cameras have");
  record.covariance = table.rows("covariance", record.parameters.size());
  if (record.covariance.size() != record.parameters.size()) {
    table.fail("covariance", "must have a row for each of the parameters");
  }
  record.unobservable = table.texts("untold");
  return record;
}

std::string record_text(const CalibrationRecord& record) {
  std::string out = "\n[calibration]\nimages = " + std::to_string(record.images) + "\n";
  out += "points = " + std::to_string(record.points) + "\n";
  out += "rms_px = " + exact_number(record.rms_px) + "\n";
  out += "parameters = " + toml_strings(record.parameters) + "\ncovariance = [\n";
  for (const std::vector<double>& row : record.covariance) out += "  " + exact_list(row) + ",\n";
  return out + "]\nuntold = " + toml_strings(record.unobservable) + "\n";
}

}  // namespace pharos::host
