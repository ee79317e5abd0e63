// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/mounting_file.hpp"

#include <cmath>

#include "host/files/atomic_file.hpp"
#include "host/mounting/mounting_covariance.hpp"
#include "host/support/exact_number.hpp"
#include "host/support/toml_text.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {
namespace {

// Sensors on one spacecraft, features on one target.
constexpr Range kPosition_m{-1000.0, 1000.0};
constexpr Range kQuaternion{-1.001, 1.001};
// A quaternion written with four decimals has a length that is wrong by 1e-4.
constexpr double kLengthTolerance = 1e-3;
// Of two clocks that nobody set: more is an epoch that differs, not a delay.
constexpr Range kTimeOffset_s{-1e5, 1e5};
constexpr Range kTimeSigma_s{0.0, 1e5};
// A source whose poses are alike for longer has a slow error.
constexpr Range kNoiseTime_s{0.0, 10.0};
constexpr Range kScaleSigma{0.0, 1.0};
// Beyond a hundred times its noise a source needs another covariance, not a slow error.
constexpr Range kSlowRatio{0.0, 100.0};
constexpr Range kSlowTime_s{0.1, 1e6};
// Squares of 10 km: no covariance of a mounting has more, and products of sums stay finite.
constexpr Range kCovariance{-1e8, 1e8};

constexpr const char* kHead =
    "# T_vehicle_sensor, T_target_feature: p_parent = R p_child + position. Covariances: rotation (rad) before\n"
    "# translation (m) of delta in R_true = exp([delta]x) R, t_true = t + delta, in the parent frame.\n"
    "# Vehicle time = the source's time + time_offset_s.\n";

void require_name(const TomlTable& table, const std::string& name) {
  const bool valid = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
  if (name.empty() || name.size() > kMaxSourceName || !valid) {
    table.fail("name", "must be 1 to 32 of the characters a-z 0-9 _ -");
  }
}

MountingOrigin read_origin(const TomlTable& table, std::string_view key) {
  const std::string word = table.choice(key, {"given", "estimated", "prior"});
  if (word == "given") return MountingOrigin::kGiven;
  return word == "estimated" ? MountingOrigin::kEstimated : MountingOrigin::kPrior;
}

Matrix6 read_matrix(const TomlTable& table, std::string_view key) {
  const std::vector<std::vector<double>> rows = table.rows(key, 6, kCovariance);
  if (rows.size() != 6) table.fail(key, "must have 6 rows, not " + std::to_string(rows.size()));
  Matrix6 matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return matrix;
}

MountingPose read_pose(const TomlTable& table) {
  MountingPose pose;
  pose.origin = read_origin(table, "origin");
  pose.rotation_wxyz = table.vector<4>("rotation_wxyz", kQuaternion);
  const auto& [w, x, y, z] = pose.rotation_wxyz;
  if (!(std::abs(std::sqrt(w * w + x * x + y * y + z * z) - 1.0) <= kLengthTolerance)) {
    table.fail("rotation_wxyz", "is no rotation: the four numbers' squares must add up to 1");
  }
  pose.position_m = table.vector<3>("position_m", kPosition_m);
  const bool given = pose.origin == MountingOrigin::kGiven;
  if (given && !table.has("covariance")) return pose;
  if (!table.has("covariance")) table.fail("covariance", "is missing: only a pose that is given may do without");
  const Matrix6 read = read_matrix(table, "covariance");
  if (const auto error = covariance_error(read, given)) table.fail("covariance", *error);
  pose.covariance = 0.5 * (read + read.transpose());
  return pose;
}

void read_time_offset(const TomlTable& table, SourceMounting& source) {
  source.time_offset_origin = read_origin(table, "time_offset_origin");
  source.time_offset_s = table.number("time_offset_s", kTimeOffset_s);
  source.time_offset_sigma_s = table.number("time_offset_sigma_s", kTimeSigma_s);
  if (source.time_offset_origin != MountingOrigin::kGiven && !(source.time_offset_sigma_s > 0.0)) {
    table.fail("time_offset_sigma_s", "must be positive unless the offset is given");
  }
}

std::optional<SlowError> read_slow_error(const TomlTable& source) {
  if (!source.has("slow_error")) return std::nullopt;
  const TomlTable table = source.table("slow_error");
  SlowError slow;
  slow.rotation_ratio = table.number("rotation_ratio", kSlowRatio);
  slow.position_ratio = table.number("position_ratio", kSlowRatio);
  slow.time_constant_s = table.number("time_constant_s", kSlowTime_s);
  return slow;
}

SourceMounting read_source(const TomlTable& table) {
  SourceMounting source;
  source.name = table.text("name");
  require_name(table, source.name);
  source.kind = *source_kind(table.choice("kind", {"lighthouse", "tof", "ring2", "slam"}));
  read_time_offset(table, source);
  source.scale_sigma = table.number_or("scale_sigma", 0.0, kScaleSigma);
  source.noise_time_s = table.number_or("noise_time_s", 0.0, kNoiseTime_s);
  source.slow_error = read_slow_error(table);
  source.unobservable = table.texts("unobservable");
  source.T_vehicle_sensor = read_pose(table.table("T_vehicle_sensor"));
  if (table.has("T_target_feature")) source.T_target_feature = read_pose(table.table("T_target_feature"));
  if (table.has("cross_covariance")) source.cross_covariance = read_matrix(table, "cross_covariance");
  if (const auto error = joint_covariance_error(source)) table.fail("cross_covariance", *error);
  return source;
}

Mounting read_mounting(const TomlTable& root) {
  Mounting mounting;
  mounting.rig = root.text_or("rig", "");
  const std::vector<TomlTable> tables = root.tables("source");
  if (tables.size() > kMaxMountedSources) root.fail("source", "more than 16 sources");
  for (const TomlTable& table : tables) {
    const SourceMounting source = read_source(table);
    if (mounting.find(source.name) != nullptr) table.fail("name", "source \"" + source.name + "\" comes twice");
    mounting.sources.push_back(source);
  }
  root.reject_unknown();
  if (mounting.sources.empty()) root.fail("source", "is missing: a mounting has one [[source]] or more");
  return mounting;
}

std::string matrix_text(const char* key, const Matrix6& matrix) {
  std::string out = std::string(key) + " = [\n";
  for (int i = 0; i < 6; ++i) {
    std::array<double, 6> row{};
    for (int j = 0; j < 6; ++j) row[static_cast<std::size_t>(j)] = matrix(i, j);
    out += "  " + exact_list(row) + ",\n";
  }
  return out + "]\n";
}

std::string pose_text(const char* name, const MountingPose& pose) {
  std::string out = std::string("\n[source.") + name + "]\norigin = \"" + std::string(word_of(pose.origin)) + "\"\n";
  out += "rotation_wxyz = " + exact_list(pose.rotation_wxyz) + "\nposition_m = " + exact_list(pose.position_m) + "\n";
  return pose.covariance.isZero(0.0) ? out : out + matrix_text("covariance", pose.covariance);
}

std::string slow_error_text(const SlowError& slow) {
  return "\n[source.slow_error]\nrotation_ratio = " + exact_number(slow.rotation_ratio) +
         "\nposition_ratio = " + exact_number(slow.position_ratio) +
         "\ntime_constant_s = " + exact_number(slow.time_constant_s) + "\n";
}

std::string source_text(const SourceMounting& source) {
  std::string out =
      "\n[[source]]\nname = \"" + source.name + "\"\nkind = \"" + std::string(word_of(source.kind)) + "\"\n";
  out += "time_offset_s = " + exact_number(source.time_offset_s) + "\n";
  out += "time_offset_sigma_s = " + exact_number(source.time_offset_sigma_s) + "\n";
  out += "time_offset_origin = \"" + std::string(word_of(source.time_offset_origin)) + "\"\n";
  if (source.noise_time_s != 0.0) out += "noise_time_s = " + exact_number(source.noise_time_s) + "\n";
  if (source.scale_sigma != 0.0) out += "scale_sigma = " + exact_number(source.scale_sigma) + "\n";
  if (!source.unobservable.empty()) out += "unobservable = " + toml_strings(source.unobservable) + "\n";
  if (!source.cross_covariance.isZero(0.0)) out += matrix_text("cross_covariance", source.cross_covariance);
  out += pose_text("T_vehicle_sensor", source.T_vehicle_sensor);
  if (source.T_target_feature) out += pose_text("T_target_feature", *source.T_target_feature);
  if (source.slow_error) out += slow_error_text(*source.slow_error);
  return out;
}

}  // namespace

Mounting read_mounting_file(const std::string& path) { return read_mounting(TomlTable::parse_file(path)); }

Mounting parse_mounting(std::string_view text, const std::string& name) {
  return read_mounting(TomlTable::parse_text(text, name));
}

std::string mounting_text(const Mounting& mounting) {
  std::string out = kHead;
  if (!mounting.rig.empty()) out += "rig = " + toml_string(mounting.rig) + "\n";
  for (const SourceMounting& source : mounting.sources) out += source_text(source);
  return out;
}

void write_mounting_file(const std::string& path, const Mounting& mounting) {
  write_file(path, mounting_text(mounting));
}

}  // namespace pharos::host
