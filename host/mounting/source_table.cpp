// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/source_table.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "host/mounting/mounting_covariance.hpp"
#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

constexpr double kQuaternionTolerance = 0.01;
constexpr double kMaxPosition_m = 1e6;
constexpr std::int64_t kLargestFrame = 9'000'000'000'000'000'000;
// Names of 16 and more digits are nanoseconds, as those of recorded images.
constexpr std::int64_t kSmallestTime_ns = 1'000'000'000'000'000;
constexpr double kNs_s = 1e-9;
const std::array<const char*, 6> kComponents{"rx", "ry", "rz", "tx", "ty", "tz"};

std::array<std::string, 21> make_covariance_columns() {
  std::array<std::string, 21> names;
  std::size_t at = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j) {
      const char* unit = j < 3 ? "_rad2" : (i < 3 ? "_rad_m" : "_m2");
      names[at++] = std::string("cov_") + kComponents[i] + '_' + kComponents[j] + unit;
    }
  }
  return names;
}

Matrix3 about_x(double angle_rad) { return rotation_exp({angle_rad, 0.0, 0.0}); }
Matrix3 about_y(double angle_rad) { return rotation_exp({0.0, angle_rad, 0.0}); }
const Matrix3 kHalfTurnAboutX = Vector3(1.0, -1.0, -1.0).asDiagonal();

std::vector<std::string> required_columns(SourceKind kind) {
  if (kind == SourceKind::kRing2) return {"theta_deg", "gamma_deg", "cx_m", "cy_m", "cz_m", "sigma_deg", "status"};
  return {"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m", "sigma_rot_deg", "sigma_pos_mm", "status"};
}

std::vector<std::string> second_columns(SourceKind kind) {
  if (kind == SourceKind::kRing2) return {"alt_theta_deg", "alt_gamma_deg", "alt_cx_m", "alt_cy_m", "alt_cz_m"};
  return {"alt_qw", "alt_qx", "alt_qy", "alt_qz", "alt_tx_m", "alt_ty_m", "alt_tz_m"};
}

std::vector<std::string> covariance_names() {
  return {upper_covariance_columns().begin(), upper_covariance_columns().end()};
}

const std::vector<std::string>& centre_columns() {
  static const std::vector<std::string> names = {"centre_cov_xx_m2", "centre_cov_xy_m2", "centre_cov_xz_m2",
                                                 "centre_cov_yy_m2", "centre_cov_yz_m2", "centre_cov_zz_m2"};
  return names;
}

}  // namespace

const std::array<std::string, 21>& upper_covariance_columns() {
  static const std::array<std::string, 21> names = make_covariance_columns();
  return names;
}

struct SourceTable::State {
  State(const std::string& path, SourceKind source_kind, const SourceTableChoice& chosen)
      : table(ByteSource(path), required_columns(source_kind)),
        kind(source_kind),
        choice(chosen),
        time(table.find_optional("time_s")),
        frame(time ? std::nullopt : table.find_optional(kind == SourceKind::kRing2 ? "problem" : "frame")),
        arrival(table.find_optional("arrival_s")),
        station(kind == SourceKind::kLighthouse ? table.find_optional("station") : std::nullopt),
        alpha(kind == SourceKind::kTof ? table.find_optional("alpha_deg") : std::nullopt),
        beta(alpha ? table.find_optional("beta_deg") : std::nullopt),
        sigma_position(kind == SourceKind::kRing2 ? table.find_optional("sigma_position_mm") : std::nullopt),
        delta_chi2(table.find_optional("delta_chi2")),
        second(group(second_columns(kind))),
        covariance(group(covariance_names())),
        centre(kind == SourceKind::kRing2 ? group(centre_columns()) : std::vector<std::size_t>()) {
    if (!time && !frame) throw InputError(table.name() + ": line 1: no column time_s; add the times");
  }

  // Indices of columns that a table has all or none of; empty where one is missing.
  std::vector<std::size_t> group(const std::vector<std::string>& names) {
    std::vector<std::size_t> found;
    for (const std::string& name : names) {
      const std::optional<std::size_t> column = table.find_optional(name);
      if (!column) return {};
      found.push_back(*column);
    }
    return found;
  }

  bool has(const std::vector<std::size_t>& columns) const { return !columns.empty() && !table.empty(columns[0]); }

  bool is_wanted() {
    if (!station || table.empty(*station)) return true;
    const std::int64_t number = table.integer(*station, 0, 1'000'000);
    if (choice.station) return number == *choice.station;
    if (!seen_station) seen_station = number;
    if (*seen_station != number) table.fail(*station, "rows of several stations, each in its own frame; choose one");
    return true;
  }

  double time_of_row() const {
    if (time) return table.number(*time);
    const std::int64_t number = table.integer(*frame, 0, kLargestFrame);
    if (number >= kSmallestTime_ns) return static_cast<double>(number) * kNs_s;
    if (!choice.rate_hz) {
      table.fail(*frame, "no column time_s, and no name of 16 digits (ns); add the times, or give a rate of frames");
    }
    return static_cast<double>(number) / *choice.rate_hz;
  }

  SensorFromFeature quaternion_pose(const std::vector<std::size_t>& c) const {
    const Quaternion q(table.number(c[0]), table.number(c[1]), table.number(c[2]), table.number(c[3]));
    if (!(std::abs(q.norm() - 1.0) <= kQuaternionTolerance)) {
      table.fail(c[0], "the quaternion has length " + std::to_string(q.norm()) + "; it must be 1");
    }
    return {q.normalized().toRotationMatrix(), {table.number(c[4]), table.number(c[5]), table.number(c[6])}};
  }

  // DESIGN: n = Rx(theta) Ry(gamma) (0,0,-1) is the ring's z axis.
  SensorFromFeature ring_pose(const std::vector<std::size_t>& c) const {
    const Matrix3 R = about_x(table.number(c[0]) * kRadPerDeg) * about_y(table.number(c[1]) * kRadPerDeg);
    return {R * kHalfTurnAboutX, {table.number(c[2]), table.number(c[3]), table.number(c[4])}};
  }

  SensorFromFeature pose_of(const std::vector<std::size_t>& c) const {
    return kind == SourceKind::kRing2 ? ring_pose(c) : quaternion_pose(c);
  }

  void read_pose(SourceRow& row) const {
    const bool turn_missing = kind == SourceKind::kTof && table.empty(0);
    row.has_turn = kind != SourceKind::kRing2 && !turn_missing;
    if (kind == SourceKind::kRing2) {
      row.pose = ring_pose({0, 1, 2, 3, 4});
    } else if (turn_missing) {
      row.pose.R =
          kHalfTurnAboutX * about_x(table.number(*alpha) * kRadPerDeg) * about_y(table.number(*beta) * kRadPerDeg);
      row.pose.t = {table.number(4), table.number(5), table.number(6)};
    } else {
      row.pose = quaternion_pose({0, 1, 2, 3, 4, 5, 6});
    }
    if (!(row.pose.t.cwiseAbs().maxCoeff() < kMaxPosition_m))
      table.fail_row("the position is beyond 1000 km; give metres");
    if (has(second)) row.second = pose_of(second);
    if (row.second && delta_chi2) row.delta_chi2 = table.optional_number(*delta_chi2).value_or(0.0);
  }

  // Sigmas are roots of traces: over three directions, of a rotation without turn over two.
  Matrix6 even_covariance(const SourceRow& row) const {
    Matrix6 out = Matrix6::Zero();
    const std::size_t rotation = kind == SourceKind::kRing2 ? 5 : 7;
    const double tilt_rad = table.number(rotation) * kRadPerDeg;
    const Vector3 normal = row.pose.R.col(2);
    const Matrix3 turned =
        row.has_turn ? Matrix3::Identity() : Matrix3(Matrix3::Identity() - normal * normal.transpose());
    out.topLeftCorner<3, 3>() = turned * (tilt_rad * tilt_rad / (row.has_turn ? 3.0 : 2.0));
    if (has(centre)) {
      Matrix3 position;
      std::size_t at = 0;
      for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) position(i, j) = position(j, i) = table.number(centre[at++]);
      }
      out.bottomRightCorner<3, 3>() = position;
      return out;
    }
    if (kind == SourceKind::kRing2 && !sigma_position) table.fail_row("no covariance of the centre: no such column");
    const double sigma_m = table.number(sigma_position ? *sigma_position : 8) / kMmPerM;
    out.bottomRightCorner<3, 3>() = Matrix3::Identity() * (sigma_m * sigma_m / 3.0);
    return out;
  }

  Matrix6 full_covariance() const {
    Matrix6 out;
    std::size_t at = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) out(i, j) = out(j, i) = table.number(covariance[at++]);
    }
    return out;
  }

  SourceRow row() const {
    SourceRow out;
    out.time_s = time_of_row();
    if (arrival) out.arrival_s = table.optional_number(*arrival);
    read_pose(out);
    out.covariance = has(covariance) ? full_covariance() : even_covariance(out);
    if (const auto error = covariance_error(out.covariance, true)) table.fail_row("the covariance " + *error);
    return out;
  }

  bool is_refused() const {
    const std::string_view status = table.text(kind == SourceKind::kRing2 ? 6 : 9);
    if (status != "ok" && status != "ambiguous") return true;
    if (kind == SourceKind::kTof && alpha && beta) return table.empty(4);
    return table.empty(kind == SourceKind::kRing2 ? 2 : 0);
  }

  TableReader table;
  SourceKind kind;
  SourceTableChoice choice;
  std::optional<std::size_t> time, frame, arrival, station, alpha, beta, sigma_position, delta_chi2;
  std::vector<std::size_t> second, covariance, centre;
  std::optional<std::int64_t> seen_station;
  std::size_t rows = 0, refused = 0;
};

SourceTable::SourceTable(const std::string& path, SourceKind kind, const SourceTableChoice& choice)
    : state_(std::make_unique<State>(path, kind, choice)) {}
SourceTable::SourceTable(SourceTable&&) noexcept = default;
SourceTable& SourceTable::operator=(SourceTable&&) noexcept = default;
SourceTable::~SourceTable() = default;

std::optional<SourceRow> SourceTable::next() {
  while (state_->table.next()) {
    if (!state_->is_wanted()) continue;
    ++state_->rows;
    if (!state_->is_refused()) return state_->row();
    ++state_->refused;
  }
  return std::nullopt;
}

std::size_t SourceTable::rows() const { return state_->rows; }
std::size_t SourceTable::refused() const { return state_->refused; }
std::size_t SourceTable::line_number() const { return state_->table.line_number(); }
const std::string& SourceTable::name() const { return state_->table.name(); }

}  // namespace pharos::host
