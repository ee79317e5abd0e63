// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/slam_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "host/files/atomic_file.hpp"
#include "host/images/canvas.hpp"
#include "host/preview/slam_drawing.hpp"
#include "host/runtime/process_usage.hpp"
#include "host/support/exact_number.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/slam/spin.hpp"

namespace pharos::tools {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

nlohmann::ordered_json spin_json(const slam::Spin& spin) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const auto list = [](const Vector3& v, double scale) {
    return std::vector<double>{scale * v.x(), scale * v.y(), scale * v.z()};
  };
  nlohmann::ordered_json json;
  json["rate_deg_s"] = kDegrees * spin.rate();
  json["sigma_rate_deg_s"] = kDegrees * spin.sigma_rate_rad_s();
  json["axis_camera"] = list(spin.axis(), 1.0);
  json["sigma_axis_deg"] = kDegrees * spin.sigma_axis_rad();
  json["rate_camera_deg_s"] = list(spin.rate_rad_s, kDegrees);
  for (int row = 0; row < 3; ++row) {
    json["covariance_deg2_s2"].push_back(list(spin.covariance.row(row), kDegrees * kDegrees));
  }
  json["turned_deg"] = kDegrees * spin.turned_rad;
  json["residual_rms_deg"] = kDegrees * spin.residual_rms_rad;
  return json;
}

// Roots of the covariances' traces: of the last pose and of the least certain one.
void add_sigmas(nlohmann::ordered_json& json, const std::vector<slam::TrackedFrame>& trajectory) {
  double last_rad = -1.0, max_rad = 0.0, last_m = 0.0, max_m = 0.0;
  for (const slam::TrackedFrame& frame : trajectory) {
    if (!frame.placed) continue;
    const Matrix6& covariance = frame.placed->covariance;
    last_rad = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
    last_m = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
    max_rad = std::max(max_rad, last_rad);
    max_m = std::max(max_m, last_m);
  }
  if (last_rad < 0.0) return;
  constexpr double kDegrees = 180.0 / std::numbers::pi, kMillimetres = 1e3;
  json["sigma_rot_deg"] = {{"last", kDegrees * last_rad}, {"most", kDegrees * max_rad}};
  json["sigma_pos_mm"] = {{"last", kMillimetres * last_m}, {"most", kMillimetres * max_m}};
}

}  // namespace

std::vector<std::uint8_t> eight_bits(const host::GreyImage& image) {
  std::vector<std::uint8_t> out;
  out.reserve(image.pixels.size());
  for (const std::uint16_t value : image.pixels) out.push_back(static_cast<std::uint8_t>(value >> 8U));
  return out;
}

void write_map_ply(const std::string& path, const std::vector<slam::SlamPoint>& points) {
  std::ostringstream file;
  file << "ply\nformat ascii 1.0\ncomment metres, in the left camera's frame at the first frame\nelement vertex "
       << points.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nproperty int observers\nend_header\n";
  for (const slam::SlamPoint& point : points) {
    for (int k = 0; k < 3; ++k) file << host::exact_number(point.position_m[k]) << ' ';
    file << point.observers << '\n';
  }
  host::write_file(path, file.str());
}

void note_quarter(std::size_t done, std::size_t all, RunFigures& figures) {
  if (4 * done / all == 4 * (done - 1) / all) return;
  figures.memory.push_back({done, host::process_usage().resident_kib});
}

void write_slam_report(const std::string& path, const slam::SlamSystem& system, const RunFigures& figures) {
  const slam::SlamReport report = system.report();
  nlohmann::ordered_json json;
  json["frames"] = report.frames;
  json["tracked"] = report.tracked;
  json["lost"] = report.lost;
  json["ambiguous_place"] = report.ambiguous_place;
  json["relocalised"] = report.relocalised;
  json["repeated"] = report.repeated;
  json["dark"] = report.dark;
  json["saturated"] = report.saturated;
  json["unreadable"] = figures.unreadable;
  json["without_partner"] = figures.without_partner;
  json["scene"] = name_of(report.scene);
  json["steady_rotation"] = report.steady_rotation;
  json["keyframes"] = report.keyframes;
  json["keyframes_made"] = report.keyframes_made;
  json["points"] = report.points;
  json["loops"] = report.loops;
  json["loops_refused"] = report.loops_refused;
  json["loops_taken_back"] = report.loop_candidates.taken_back;
  const slam::LoopCounts& candidates = report.loop_candidates;
  json["loop_candidates"] = candidates.candidates;
  json["loop_candidates_refused"] = {{"geometry", candidates.geometry},
                                     {"trajectory", candidates.trajectory},
                                     {"one_surface", candidates.one_surface},
                                     {"neighbours", candidates.neighbours},
                                     {"rival", candidates.rival}};
  json["features_median"] = report.features_median;
  json["inliers_median"] = report.inliers_median;
  json["tracking_median_ms"] = report.tracking_median_ms;
  json["tracking_p95_ms"] = report.tracking_p95_ms;
  json["mapping_median_ms"] = report.mapping_median_ms;
  json["loop_max_ms"] = report.loop_max_ms;
  json["light_median_ms"] = median(figures.light_ms);
  json["to_pose_median_ms"] = median(figures.to_pose_ms);
  add_sigmas(json, system.trajectory());
  for (const MemoryAt& at : figures.memory) {
    json["memory"].push_back({{"pair", at.pair}, {"resident_mib", static_cast<double>(at.resident_kib) / 1024.0}});
  }
  std::int64_t peak_kib = host::process_usage().peak_resident_kib;  // the kernel updates it with a delay
  for (const MemoryAt& at : figures.memory) peak_kib = std::max(peak_kib, at.resident_kib);
  json["memory_peak_mib"] = static_cast<double>(peak_kib) / 1024.0;
  if (const auto spin = system.spin()) json["spin"] = spin_json(*spin);
  host::write_file(path, json.dump(2) + '\n');
}

void write_slam_overlay(const std::string& folder, const std::string& stem, const slam::SlamSystem& system) {
  const ImageView<const std::uint8_t> image = system.last_image(), mask = system.last_mask();
  std::vector<std::uint16_t> grey;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) grey.push_back(static_cast<std::uint16_t>(image.at(u, v) * 257));
  }
  host::Canvas canvas({grey.data(), image.width_px, image.height_px}, host::Canvas::zoom_for(image.width_px));
  for (std::int32_t v = 0; v < mask.height_px; ++v) {
    for (std::int32_t u = 0; u < mask.width_px; ++u) {
      if (mask.at(u, v) == 0) canvas.tint(u, v, host::colours::kBlue, 0.15);
    }
  }
  host::slam_drawing(system).draw(canvas);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw host::InputError(folder + ": cannot be made: " + error.message());
  canvas.write_png((std::filesystem::path(folder) / (stem + "_slam.png")).string());
}

}  // namespace pharos::tools
