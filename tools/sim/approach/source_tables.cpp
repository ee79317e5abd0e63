// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "host/mounting/source_table.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/approach/approach_writer.hpp"
#include "tools/sim/output_files.hpp"

namespace pharos::sim {
namespace {

using host::RowWriter;
using host::SensorFromFeature;
using host::SourceKind;

std::vector<std::string> pose_columns(const std::string& prefix) {
  std::vector<std::string> names;
  for (const char* name : {"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"}) names.push_back(prefix + name);
  return names;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<std::string> columns_of(SourceKind kind) {
  std::vector<std::string> columns;
  if (kind == SourceKind::kRing2) {
    columns = {"problem",       "theta_deg",     "gamma_deg", "nx",        "ny",       "nz",
               "cx_m",          "cy_m",          "cz_m",      "sigma_deg", "status",   "sigma_position_mm",
               "alt_theta_deg", "alt_gamma_deg", "alt_cx_m",  "alt_cy_m",  "alt_cz_m", "delta_chi2",
               "time_s"};
  } else if (kind == SourceKind::kTof) {
    columns = {"frame", "tx_m", "ty_m", "tz_m",          "alpha_deg",    "beta_deg", "gamma_deg", "qw",
               "qx",    "qy",   "qz",   "sigma_rot_deg", "sigma_pos_mm", "status",   "flags"};
    append(columns, pose_columns("alt_"));
    append(columns, {"delta_chi2", "time_s"});
  } else {
    columns = {"time_s"};
    if (kind == SourceKind::kLighthouse) columns.emplace_back("station");
    append(columns, pose_columns(""));
    append(columns, {"sigma_rot_deg", "sigma_pos_mm", "status"});
    if (kind == SourceKind::kLighthouse) {
      columns.emplace_back("flags");
      append(columns, pose_columns("alt_"));
      columns.emplace_back("delta_chi2");
    }
  }
  columns.emplace_back("arrival_s");
  append(columns, {host::upper_covariance_columns().begin(), host::upper_covariance_columns().end()});
  return columns;
}

void write_vector(RowWriter& rows, const Vector3& v) { rows.number(v.x()).number(v.y()).number(v.z()); }

void write_quaternion(RowWriter& rows, const Matrix3& R) {
  const Quaternion q = canonical_quaternion(R);
  rows.number(q.w()).number(q.x()).number(q.y()).number(q.z());
}

void write_second(RowWriter& rows, const ApproachMeasurement& m) {
  if (!m.second) {
    rows.none(8);
    return;
  }
  write_quaternion(rows, m.second->R);
  write_vector(rows, m.second->t);
  rows.number(m.delta_chi2);
}

const char* status_of(const ApproachMeasurement& m) {
  if (!m.seen) return "refused_not_seen";
  return m.second ? "ambiguous" : "ok";
}

double sigma_deg(const ApproachMeasurement& m) {
  return std::sqrt(m.covariance.topLeftCorner<3, 3>().trace()) * kDegPerRad;
}
double sigma_mm(const ApproachMeasurement& m) {
  return std::sqrt(m.covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM;
}

// theta, gamma of n = Rx(theta) Ry(gamma) (0,0,-1).
void write_tilts(RowWriter& rows, const Vector3& n) {
  rows.number(std::atan2(n.y(), -n.z()) * kDegPerRad).number(-std::asin(n.x()) * kDegPerRad);
}

void write_ring2(RowWriter& rows, const ApproachMeasurement& m, std::int64_t number) {
  rows.integer(number);
  if (!m.seen) {
    rows.none(9).text(status_of(m)).none(7).number(m.time_s);
    return;
  }
  const Vector3 n = m.pose.R.col(2);
  write_tilts(rows, n);
  write_vector(rows, n);
  write_vector(rows, m.pose.t);
  rows.number(sigma_deg(m)).text(status_of(m)).number(sigma_mm(m));
  if (m.second) {
    write_tilts(rows, m.second->R.col(2));
    write_vector(rows, m.second->t);
    rows.number(m.delta_chi2);
  } else {
    rows.none(6);
  }
  rows.number(m.time_s);
}

// Angles of diag(1,-1,-1) R = Rx(alpha) Ry(beta) Rz(gamma).
void write_tof(RowWriter& rows, const ApproachMeasurement& m, std::int64_t number) {
  rows.text(padded_number(static_cast<std::size_t>(number), 4));
  if (!m.seen) {
    rows.none(12).text(status_of(m)).none(9).number(m.time_s);
    return;
  }
  const Matrix3 A = Vector3(1.0, -1.0, -1.0).asDiagonal() * m.pose.R;
  write_vector(rows, m.pose.t);
  rows.number(std::atan2(-A(1, 2), A(2, 2)) * kDegPerRad).number(std::asin(A(0, 2)) * kDegPerRad);
  if (m.has_turn) {
    rows.number(std::atan2(-A(0, 1), A(0, 0)) * kDegPerRad);
    write_quaternion(rows, m.pose.R);
  } else {
    rows.none(5);
  }
  rows.number(sigma_deg(m)).number(sigma_mm(m)).text(status_of(m)).none();
  write_second(rows, m);
  rows.number(m.time_s);
}

void write_pose_row(RowWriter& rows, const ApproachMeasurement& m, bool lighthouse) {
  rows.number(m.time_s);
  if (lighthouse) rows.integer(0);
  if (m.seen) {
    write_quaternion(rows, m.pose.R);
    write_vector(rows, m.pose.t);
    rows.number(sigma_deg(m)).number(sigma_mm(m));
  } else {
    rows.none(9);
  }
  rows.text(status_of(m));
  if (!lighthouse) return;
  rows.none();
  write_second(rows, m);
}

void write_last(RowWriter& rows, const ApproachMeasurement& m) {
  rows.number(m.arrival_s);
  if (!m.seen) {
    rows.none(host::upper_covariance_columns().size()).end_row();
    return;
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) rows.number(m.covariance(i, j));
  }
  rows.end_row();
}

}  // namespace

void write_source_table(const std::filesystem::path& path, SourceKind kind,
                        const std::vector<ApproachMeasurement>& measurements) {
  TableFile file(path, columns_of(kind));
  std::int64_t number = 0;
  for (const ApproachMeasurement& m : measurements) {
    if (kind == SourceKind::kLighthouse && !m.seen) continue;  // no light, no row
    if (kind == SourceKind::kRing2) {
      write_ring2(file.rows(), m, number++);
    } else if (kind == SourceKind::kTof) {
      write_tof(file.rows(), m, number++);
    } else {
      write_pose_row(file.rows(), m, kind == SourceKind::kLighthouse);
    }
    write_last(file.rows(), m);
  }
  file.rows().flush();
}

}  // namespace pharos::sim
