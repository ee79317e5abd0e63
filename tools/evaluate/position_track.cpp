// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/position_track.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::evaluate {
namespace {

constexpr std::size_t kHeaderPeek = 4096;
constexpr double kLargestCoordinate_m = 1e6;
constexpr double kUnitTolerance = 0.01;

using host::TableReader;

Matrix3 symmetric(const std::array<double, 6>& v) {
  Matrix3 m;
  m << v[0], v[1], v[2], v[1], v[3], v[4], v[2], v[4], v[5];
  return m;
}

class PositionTable {
 public:
  PositionTable(host::ByteSource source, bool poses)
      : poses_(poses),
        table_(std::move(source),
               poses ? std::vector<std::string>{"time_s", "tx_m", "ty_m", "tz_m", "qw", "qx", "qy", "qz"}
                     : std::vector<std::string>{"time_s", "x_m", "y_m", "z_m"}),
        status_(table_.find_optional("status")),
        sigma_(table_.find_optional("sigma_pos_mm")),
        sigma_rotation_(table_.find_optional("sigma_rot_deg")) {
    for (const char* name : {"cov_xx_m2", "cov_xy_m2", "cov_xz_m2", "cov_yy_m2", "cov_yz_m2", "cov_zz_m2"}) {
      if (const auto column = table_.find_optional(name)) covariance_.push_back(*column);
    }
  }

  PositionTrack read() {
    PositionTrack track;
    while (table_.next()) {
      ++track.rows;
      const bool answered = !table_.empty(1) && (!status_ || table_.text(*status_) == "ok");
      if (answered) {
        track.samples.push_back(sample());
      } else {
        ++track.refused;
      }
    }
    std::stable_sort(track.samples.begin(), track.samples.end(),
                     [](const PositionSample& a, const PositionSample& b) { return a.time_s < b.time_s; });
    return track;
  }

 private:
  PositionSample sample() const {
    PositionSample s;
    s.time_s = table_.number(0);
    s.position_m = {table_.number(1), table_.number(2), table_.number(3)};
    if (s.position_m.cwiseAbs().maxCoeff() > kLargestCoordinate_m) {
      table_.fail_row("the position is beyond 1000 km; give metres");
    }
    if (poses_) {
      const Quaternion q(table_.number(4), table_.number(5), table_.number(6), table_.number(7));
      if (!(std::abs(q.norm() - 1.0) <= kUnitTolerance)) table_.fail_row("the quaternion must have length 1");
      s.R_world_body = q.normalized().toRotationMatrix();
    }
    if (covariance_.size() == 6 && !table_.empty(covariance_[0])) {
      std::array<double, 6> v{};
      for (std::size_t k = 0; k < v.size(); ++k) v[k] = table_.number(covariance_[k]);
      s.covariance_m2 = symmetric(v);
    } else if (sigma_ && !table_.empty(*sigma_)) {
      const double sigma_m = table_.number(*sigma_) / kMmPerM;
      s.covariance_m2 = Matrix3(sigma_m * sigma_m / 3.0 * Matrix3::Identity());
    }
    if (poses_ && sigma_rotation_ && !table_.empty(*sigma_rotation_)) {
      const double sigma_rad = table_.number(*sigma_rotation_) / kDegPerRad;
      s.attitude_covariance_rad2 = Matrix3(sigma_rad * sigma_rad / 3.0 * Matrix3::Identity());
    }
    return s;
  }

  bool poses_;
  TableReader table_;
  std::optional<std::size_t> status_, sigma_, sigma_rotation_;
  std::vector<std::size_t> covariance_;
};

bool has_column(std::string_view header, const std::string& name) {
  return ("," + std::string(header) + ",").find("," + name + ",") != std::string::npos;
}

std::string_view header_of(host::ByteSource& source) {
  const std::string_view head = source.peek(kHeaderPeek);
  return head.substr(0, head.find_first_of("\r\n"));
}

}  // namespace

std::optional<double> normalised_square(const PositionSample& estimate, const Vector3& lever_m,
                                        const Vector3& error_m) {
  if (!estimate.covariance_m2) return std::nullopt;
  Matrix3 covariance = *estimate.covariance_m2;
  if (estimate.R_world_body && estimate.attitude_covariance_rad2) {
    const Matrix3 by_turn = -skew(*estimate.R_world_body * lever_m);
    covariance += by_turn * *estimate.attitude_covariance_rad2 * by_turn.transpose();
  }
  const Eigen::LLT<Matrix3> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return error_m.dot(factor.solve(error_m));
}

std::optional<Vector3> position_at(const std::vector<PositionSample>& samples, double time_s, double max_gap_s) {
  const auto after = std::lower_bound(samples.begin(), samples.end(), time_s,
                                      [](const PositionSample& s, double t) { return s.time_s < t; });
  if (after == samples.end() || after == samples.begin()) return std::nullopt;
  const PositionSample& a = *(after - 1);
  const PositionSample& b = *after;
  const double step_s = b.time_s - a.time_s;
  if (step_s > max_gap_s || !(step_s > 0.0)) return std::nullopt;
  return a.position_m + (time_s - a.time_s) / step_s * (b.position_m - a.position_m);
}

bool is_position_table(const std::string& path) {
  host::ByteSource source(path);
  const std::string_view header = header_of(source);
  return has_column(header, "x_m") && !has_column(header, "qw");
}

PositionTrack read_position_track(const std::string& path) {
  host::ByteSource source(path);
  const bool poses = has_column(header_of(source), "qw");
  return PositionTable(std::move(source), poses).read();
}

}  // namespace pharos::evaluate
