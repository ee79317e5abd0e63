// SPDX-License-Identifier: Apache-2.0
// The figures of `pharos evaluate` for TUM files, computed by an independent method: quaternions in plain arithmetic
// instead of matrices and logarithms, Horn's eigenvector instead of a singular value decomposition.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using Point = std::array<double, 3>;
using Turn = std::array<double, 4>;  // w, x, y, z

struct Stamped {
  double time_s = 0.0;
  Turn q{1.0, 0.0, 0.0, 0.0};
  Point t{};
};

Turn times(const Turn& a, const Turn& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}
Turn back(const Turn& q) { return {q[0], -q[1], -q[2], -q[3]}; }
Point turned(const Turn& q, const Point& p) {
  const Turn r = times(times(q, {0.0, p[0], p[1], p[2]}), back(q));
  return {r[1], r[2], r[3]};
}
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point plus(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
double square(const Point& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; }
double angle_rad(const Turn& q) { return 2.0 * std::atan2(std::hypot(q[1], q[2], q[3]), std::abs(q[0])); }

Turn axis_angle(const Point& v) {
  const double angle = std::sqrt(square(v));
  if (angle == 0.0) return {1.0, 0.0, 0.0, 0.0};
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * v[0], s * v[1], s * v[2]};
}

// A tumbling path, and the same with errors in another world frame.
struct Recordings {
  std::vector<Stamped> truth, estimate;

  explicit Recordings(bool other_world) {
    std::mt19937 random(17);
    std::normal_distribution<double> normal;
    const auto noise = [&](double sigma) {
      return Point{sigma * normal(random), sigma * normal(random), sigma * normal(random)};
    };
    const Turn world = other_world ? axis_angle({0.4, -1.1, 0.7}) : Turn{1.0, 0.0, 0.0, 0.0};
    const Point offset = other_world ? Point{2.0, -1.0, 0.5} : Point{};
    for (int k = 0; k < 240; ++k) {
      const double s = 0.1 * k;
      Stamped pose{s,
                   times(axis_angle({0.0, 0.0, 0.3 * s}), axis_angle({0.2 * std::sin(0.5 * s), 0.1, 0.0})),
                   {std::sin(0.4 * s), 0.5 * std::cos(0.7 * s), 3.0 + 0.02 * s * s}};
      truth.push_back(pose);
      pose.q = times(world, times(pose.q, axis_angle(noise(0.004))));
      pose.t = plus(offset, turned(world, plus(pose.t, noise(0.01))));
      estimate.push_back(pose);
    }
  }
};

std::string tum_of(const std::vector<Stamped>& poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const Stamped& p : poses) {
    std::array<char, 320> line;
    std::snprintf(line.data(), line.size(), "%.6f %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", p.time_s, p.t[0],
                  p.t[1], p.t[2], p.q[1], p.q[2], p.q[3], p.q[0]);
    text += line.data();
  }
  return text;
}

Row evaluated(const Recordings& recordings, const std::string& options) {
  const Folder folder;
  const Outcome run = pharos("evaluate " + folder.write("estimate.tum", tum_of(recordings.estimate)) + " " +
                             folder.write("truth.tum", tum_of(recordings.truth)) + " " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return rows_of(run.out).at(0);
}

// Horn (1987): the unit quaternion of the best rotation from b to a is the eigenvector of the largest eigenvalue of a 4
// x 4 matrix; by iteration.
Turn horn(const std::vector<Point>& a, const std::vector<Point>& b) {
  double s[3][3] = {};
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) s[i][j] += b[k][i] * a[k][j];
    }
  }
  const double n[4][4] = {{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                          {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                          {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
                          {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}};
  double shift = 0.0;  // so that the largest eigenvalue has the largest magnitude
  for (const auto& row : n) {
    for (const double value : row) shift += std::abs(value);
  }
  Turn q{0.5, 0.5, -0.5, 0.5};
  for (int k = 0; k < 5000; ++k) {
    Turn next{};
    double norm = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      next[i] = shift * q[i];
      for (std::size_t j = 0; j < 4; ++j) next[i] += n[i][j] * q[j];
      norm += next[i] * next[i];
    }
    for (std::size_t i = 0; i < 4; ++i) q[i] = next[i] / std::sqrt(norm);
  }
  return q;
}

Point mean(const std::vector<Stamped>& poses) {
  Point sum{};
  for (const Stamped& p : poses) sum = plus(sum, p.t);
  const auto count = static_cast<double>(poses.size());
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

constexpr double kDegPerRad = 57.29577951308232;
constexpr double kClose = 1e-6;  // relative

TEST(EvaluateTum, AttitudeAndPositionErrorsAgree) {
  const Recordings recordings(false);
  double rotation = 0.0, maximum = 0.0, position = 0.0;
  for (std::size_t k = 0; k < recordings.truth.size(); ++k) {
    const Stamped &e = recordings.estimate[k], &t = recordings.truth[k];
    const double angle = angle_rad(times(back(t.q), e.q));
    rotation += angle * angle;
    maximum = std::max(maximum, angle);
    position += square(minus(e.t, t.t));
  }
  const auto count = static_cast<double>(recordings.truth.size());
  const double rotation_deg = std::sqrt(rotation / count) * kDegPerRad, position_mm = 1e3 * std::sqrt(position / count);
  const Row row = evaluated(recordings, "--align none");
  EXPECT_EQ(row.at("compared"), "240");
  EXPECT_NEAR(std::stod(row.at("rot_rms_deg")), rotation_deg, kClose * rotation_deg);
  EXPECT_NEAR(std::stod(row.at("rot_max_deg")), maximum * kDegPerRad, kClose * maximum * kDegPerRad);
  EXPECT_NEAR(std::stod(row.at("pos_rms_mm")), position_mm, kClose * position_mm);
}

TEST(EvaluateTum, AteAgreesWithHornsMethod) {
  const Recordings recordings(true);
  const Point middle_e = mean(recordings.estimate), middle_t = mean(recordings.truth);
  std::vector<Point> e, t;
  for (const Stamped& p : recordings.estimate) e.push_back(minus(p.t, middle_e));
  for (const Stamped& p : recordings.truth) t.push_back(minus(p.t, middle_t));
  const Turn q = horn(e, t);
  double sum = 0.0;
  for (std::size_t k = 0; k < e.size(); ++k) sum += square(minus(e[k], turned(q, t[k])));
  const double ate_mm = 1e3 * std::sqrt(sum / static_cast<double>(e.size()));
  EXPECT_GT(ate_mm, 10.0);
  for (const char* align : {"--align none", "--align se3"}) {
    EXPECT_NEAR(std::stod(evaluated(recordings, align).at("ate_mm")), ate_mm, kClose * ate_mm) << align;
  }
}

// Relative motions over a second, which do not depend on the world frames.
TEST(EvaluateTum, RelativeErrorsAgree) {
  const Recordings recordings(true);
  constexpr std::size_t kSecond = 10;
  double rotation = 0.0, position = 0.0;
  const std::size_t pairs = recordings.truth.size() - kSecond;
  const auto motion = [](const Stamped& a, const Stamped& b) {
    return Stamped{0.0, times(back(a.q), b.q), turned(back(a.q), minus(b.t, a.t))};
  };
  for (std::size_t k = 0; k < pairs; ++k) {
    const Stamped e = motion(recordings.estimate[k], recordings.estimate[k + kSecond]);
    const Stamped t = motion(recordings.truth[k], recordings.truth[k + kSecond]);
    const double angle = angle_rad(times(back(t.q), e.q));
    rotation += angle * angle;
    position += square(minus(e.t, t.t));
  }
  const double rotation_deg = std::sqrt(rotation / static_cast<double>(pairs)) * kDegPerRad;
  const double position_mm = 1e3 * std::sqrt(position / static_cast<double>(pairs));
  const Row row = evaluated(recordings, "--align se3 --rpe 1");
  EXPECT_EQ(row.at("rpe_pairs"), std::to_string(pairs));
  EXPECT_NEAR(std::stod(row.at("rpe_rot_deg")), rotation_deg, kClose * rotation_deg);
  EXPECT_NEAR(std::stod(row.at("rpe_pos_mm")), position_mm, kClose * position_mm);
}

}  // namespace
}  // namespace pharos::cli_test
