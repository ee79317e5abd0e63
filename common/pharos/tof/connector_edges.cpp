// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_edges.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/layer_intensity.hpp"

namespace pharos::tof {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr int kSides = 4;
constexpr int kPointsPerSide = 24;
// Corners are rounded in the image: the part of a side between them.
constexpr double kUsedFraction = 0.75;
constexpr int kSideSearch_px = 4;
constexpr int kSideRounds = 3;
constexpr double kSideGate = 3.0;
constexpr double kMinSideStrength = 0.3;
// A pixel darker than this fraction of the ring and without depth is dark background.
constexpr double kDarkSideFraction = 0.3;
constexpr int kMinPerSide = 4;
// Maximum ratio of a face's sides; anything longer is not a connector.
constexpr double kMaxSlender = 1.6;
// Neighbouring profiles share pixels: the variance of their mean is wider by this factor (measured on white noise).
constexpr double kCorrelation = 2.0;
// Walls brighter than the cosine law, foil of uneven height and rounded corners shift the rectangle as a whole:
// averaging does not reduce that. Root mean square over the simulated classes.
constexpr double kSilhouetteSigma_px = 0.1;
// Deviation of a region's centroid, px: used where its edges are not seen.
constexpr double kCentroidSigma_px = 0.8;

struct SidePoint {
  int side = 0;
  Vector2 planar_m = Vector2::Zero();
  double strength = 0.0;
};
using SidePoints = StaticVector<SidePoint, static_cast<std::size_t>(kSides* kPointsPerSide)>;

Vector2 outward(const PlanarRectangle& rectangle, int side) {
  const double angle = rectangle.angle_rad + 0.5 * kPi * side;
  return {std::cos(angle), std::sin(angle)};
}
double half_side(const PlanarRectangle& rectangle, int side) { return rectangle.half_sides_m[side % 2]; }

class FaceFitter {
 public:
  FaceFitter(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        ring_(ring.model),
        axes_(axes_of(ring.model.normal)),
        plane_(ring.model.plane()),
        dark_counts_(kDarkSideFraction * ring.amplitude) {}

  ConnectorFace fit(const RegionReport& region) {
    ConnectorFace face;
    // A square of the region's area about its centroid: protrusions affect the smallest rectangle more than these.
    const double half = 0.5 * std::sqrt(region.area_m2);
    face.rectangle = {region.centroid_m, region.rectangle.angle_rad, Vector2(half, half)};
    measure_heights(region, face);
    metres_per_px_ = ring_.centre_m.z() / camera_.intrinsics.fx_px;
    const double coarse = kCentroidSigma_px * metres_per_px_;
    face.covariance = coarse * coarse * Matrix2::Identity();
    ConnectorFace refined = face;
    for (int round = 0; round < kSideRounds; ++round) {
      find_points(refined);
      if (!improve(refined)) return face;
    }
    // A rectangle that diverged from its region followed other edges.
    const Vector2 moved = refined.rectangle.centre_m - face.rectangle.centre_m;
    if (moved.norm() > 2.0 * metres_per_px_ + 0.25 * face.rectangle.half_sides_m.maxCoeff()) return face;
    const Vector2& sides = refined.rectangle.half_sides_m;
    if (sides.maxCoeff() > kMaxSlender * sides.minCoeff() || refined.edge_rms_px > 1.0) return face;
    return refined;
  }

  // Position at which the square of half side `half`, its sides along the axes, has the greatest mean height.
  Vector2 highest_place(const RegionReport& region, double half) const {
    constexpr int kSteps = 8;  // to either side
    constexpr int kGrid = 5;
    const double reach = std::max(half, region.rectangle.half_sides_m.maxCoeff());
    Vector2 best = region.centroid_m;
    double best_height = -kMaxHeight_m;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const Vector2 place = region.rectangle.centre_m + reach / kSteps * Vector2(i, j);
        double sum = 0.0;
        for (int k = 0; k < kGrid * kGrid; ++k) {
          const Vector2 off(k % kGrid - kGrid / 2, k / kGrid - kGrid / 2);
          double height = 0.0;
          const bool seen = height_at(place + 0.4 * half * off, region.height_m, height);
          sum += seen ? std::clamp(height, -kMaxHeight_m, 0.0) : -kMaxHeight_m;
        }
        if (sum <= best_height * kGrid * kGrid) continue;
        best_height = sum / (kGrid * kGrid);
        best = place;
      }
    }
    return best;
  }

 private:
  Vector3 point(const Vector2& planar, double height) const {
    return ring_.centre_m + planar.x() * axes_.first + planar.y() * axes_.second + height * ring_.normal;
  }
  Vector2 planar(const Vector2& pixel, double height) const {
    const Vector2 ray = rays_.at(pixel.x(), pixel.y());
    const double z = (1.0 - height * plane_.q.norm()) * plane_.z_m(ray);
    const Vector3 arm = z * Vector3(ray.x(), ray.y(), 1.0) - ring_.centre_m;
    return {axes_.first.dot(arm), axes_.second.dot(arm)};
  }
  // Height of the pixel at a plan position, NaN-free: false where it has none.
  bool height_at(const Vector2& plan, double height, double& result) const {
    const auto pixel = project(camera_.intrinsics, point(plan, height));
    if (!pixel) return false;
    const auto u = static_cast<std::int32_t>(std::lround(pixel->x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel->y()));
    if (!frame_.depth.contains(u, v) || !has_depth(frame_.depth.at(u, v))) return false;
    result = plane_.height_m(rays_.at(u, v), depth_z_m(camera_, frame_.depth.at(u, v)));
    return true;
  }

  // The face's height from its interior, the base's from a frame around it (median: a neighbour may stand there).
  void measure_heights(const RegionReport& region, ConnectorFace& face) {
    face.height_m = region.height_m;
    constexpr int kGrid = 9;
    std::array<double, kGrid * kGrid> heights{};
    std::size_t count = 0;
    const PlanarRectangle& r = face.rectangle;
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double s = 0.6 * (2.0 * i / (kGrid - 1) - 1.0) * r.half_sides_m.x();
        const double t = 0.6 * (2.0 * j / (kGrid - 1) - 1.0) * r.half_sides_m.y();
        double height = 0.0;
        if (height_at(r.centre_m + s * outward(r, 0) + t * outward(r, 1), region.height_m, height)) {
          heights[count++] = height;
        }
      }
    }
    if (count > 8) {
      face.height_m = median(heights.data(), count);
      double spread = 0.0;
      for (std::size_t i = 0; i < count; ++i) heights[i] = std::fabs(heights[i] - face.height_m);
      spread = kMedianToSigma * median(heights.data(), count);
      // Noise is correlated between samples: a seventh of them count.
      face.sigma_height_m = 1.25 * spread / std::sqrt(std::max(1.0, static_cast<double>(count) / 7.0));
    } else {
      face.sigma_height_m = 0.25 * kMaxHeight_m;
    }
    constexpr int kAround = 64;
    std::array<double, kAround> feet{};
    std::size_t found = 0;
    for (int k = 0; k < kAround; ++k) {
      const double angle = kTwoPi * k / kAround;
      const Vector2 place = r.centre_m + 1.9 * r.half_sides_m.maxCoeff() * Vector2(std::cos(angle), std::sin(angle));
      double height = 0.0;
      if (height_at(place, 2.0 * region.height_m, height) && height < face.height_m) feet[found++] = height;
    }
    base_m_ = found > 4 ? median(feet.data(), found) : face.height_m;
  }

  static double median(double* values, std::size_t count) {
    double* middle = values + count / 2;
    std::nth_element(values, middle, values + count);
    return *middle;
  }

  void find_points(const ConnectorFace& face) {
    points_.clear();
    for (int side = 0; side < kSides; ++side) find_side(face, side);
    if (points_.empty()) return;
    std::array<double, kSides * kPointsPerSide> strengths{};
    for (std::size_t i = 0; i < points_.size(); ++i) strengths[i] = points_[i].strength;
    const double minimum = kMinSideStrength * median(strengths.data(), points_.size());
    std::size_t kept = 0;
    for (const SidePoint& p : points_) {
      if (p.strength >= minimum) points_[kept++] = p;
    }
    points_.resize(kept);
  }

  void find_side(const ConnectorFace& face, int side) {
    const PlanarRectangle& r = face.rectangle;
    const Vector2 normal = outward(r, side);
    const Vector2 along(-normal.y(), normal.x());
    const Vector2 middle = r.centre_m + half_side(r, side) * normal;
    const Vector3 normal_3d = normal.x() * axes_.first + normal.y() * axes_.second;
    for (int k = 0; k < kPointsPerSide; ++k) {
      const double t = kUsedFraction * half_side(r, side + 1) * (2.0 * (k + 0.5) / kPointsPerSide - 1.0);
      const Vector3 p = point(middle + t * along, face.height_m);
      const auto pixel = project(camera_.intrinsics, p);
      if (!pixel) continue;
      const Matrix23 slope = project_jacobian(camera_.intrinsics, p);
      const Vector2 direction = (slope * normal_3d).normalized();
      LightProfile light;
      if (!sample_light(frame_, camera_, rays_, plane_, *pixel, direction, kSideSearch_px, dark_counts_, light))
        continue;
      const ProfileEdge edge =
          steepest_of_samples(light_of_layer(light, kSideSearch_px, face.height_m, base_m_), kSideSearch_px, -1.0);
      if (!(edge.strength > 0.0)) continue;
      // Positive where the wall below this side is in sight.
      const double wall_fraction = p.dot(normal_3d) / p.dot(ring_.normal);
      const Vector2 wall_px = slope * ((base_m_ - face.height_m) * ring_.normal);
      const double shift = wall_shift_px(std::min(wall_fraction, kBrightWall), std::fabs(wall_px.dot(direction)));
      points_.push_back({side, planar(*pixel + (edge.offset_px - shift) * direction, face.height_m), edge.strength});
    }
  }

  static Vector5 row_of(const PlanarRectangle& r, const SidePoint& p) {
    const Vector2 normal = outward(r, p.side);
    const Vector2 arm = p.planar_m - r.centre_m;
    Vector5 row = Vector5::Zero();
    row[0] = normal.x();
    row[1] = normal.y();
    row[2] = -Vector2(-normal.y(), normal.x()).dot(arm);
    row[3 + p.side % 2] = 1.0;
    return row;
  }
  static double residual(const PlanarRectangle& r, const SidePoint& p) {
    return outward(r, p.side).dot(p.planar_m - r.centre_m) - half_side(r, p.side);
  }

  bool improve(ConnectorFace& face) const {
    const std::size_t count = points_.size();
    std::array<double, kSides * kPointsPerSide> sizes{};
    std::array<int, kSides> per_side{};
    Vector5 change = Vector5::Zero();
    double gate = 4.0 * metres_per_px_;
    for (int pass = 0; pass < 4; ++pass) {
      Matrix5 normal = Matrix5::Zero();
      Vector5 right = Vector5::Zero();
      double squares = 0.0;
      per_side.fill(0);
      int used = 0;
      for (const SidePoint& p : points_) {
        const Vector5 row = row_of(face.rectangle, p);
        const double left = residual(face.rectangle, p) - row.dot(change);
        if (!(std::fabs(left) < gate)) continue;
        add_outer<5>(normal, row, 1.0);
        right += row * residual(face.rectangle, p);
        squares += left * left;
        ++used;
        ++per_side[static_cast<std::size_t>(p.side)];
      }
      for (const int n : per_side) {
        if (n < kMinPerSide) return false;
      }
      const auto inverse = positive_inverse<5>(normal);
      if (!inverse) return false;
      change = *inverse * right;
      if (!change.allFinite()) return false;
      if (pass == 3) {
        const double variance = squares / std::max(1, used - 5);
        const double common = kSilhouetteSigma_px * metres_per_px_;
        face.covariance =
            kCorrelation * variance * inverse->topLeftCorner<2, 2>() + common * common * Matrix2::Identity();
        face.edge_rms_px = std::sqrt(variance) / metres_per_px_;
        face.edge_points = used;
      }
      for (std::size_t i = 0; i < count; ++i) {
        sizes[i] = std::fabs(residual(face.rectangle, points_[i]) - row_of(face.rectangle, points_[i]).dot(change));
      }
      gate = std::max(0.1 * metres_per_px_, kSideGate * kMedianToSigma * median(sizes.data(), count));
    }
    face.rectangle.centre_m += change.head<2>();
    face.rectangle.angle_rad += change[2];
    face.rectangle.half_sides_m += change.tail<2>();
    return face.rectangle.half_sides_m.minCoeff() > 0.0 && std::fabs(change[2]) < 0.5;
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& ring_;
  PlaneAxes axes_;
  DepthPlane plane_;
  double dark_counts_;
  double base_m_ = 0.0;
  double metres_per_px_ = 0.0;
  SidePoints points_;
};

}  // namespace

ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const RegionReport& region) {
  return FaceFitter(frame, camera, rays, ring).fit(region);
}

ConnectorFace fit_face_within(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                              const RingFit& ring, const RegionReport& region, const ConnectorFace& like) {
  FaceFitter fitter(frame, camera, rays, ring);
  const double half = std::sqrt(like.rectangle.half_sides_m.x() * like.rectangle.half_sides_m.y());
  RegionReport square = region;
  square.centroid_m = fitter.highest_place(region, half);
  square.area_m2 = 4.0 * half * half;
  square.height_m = like.height_m;
  ConnectorFace face;
  constexpr int kTurns = 4;
  for (int turn = 0; turn < kTurns; ++turn) {
    square.rectangle.angle_rad = 0.5 * kPi * turn / kTurns;
    face = fitter.fit(square);
    if (face.edge_points > 0) break;
  }
  return face;
}

}  // namespace pharos::tof
