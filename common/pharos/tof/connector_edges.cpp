// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_edges.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/face_shape.hpp"
#include "pharos/tof/median.hpp"
#include "pharos/tof/outline_scatter.hpp"
#include "pharos/tof/top_height.hpp"

namespace pharos::tof {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

// Of the unknowns: centre (0, 1), turn (2), half sides (3, 4), brightness (5), walls of either pair of sides (6, 7),
// the logarithm of the blur (8).
constexpr int kBrightness = 5;
constexpr int kWalls = 6;
constexpr int kBlur = 8;

constexpr int kRounds = 6;
// A box of a few cells does not tell its turn, and from half-way between two sides' directions a descent takes more
// rounds than these to leave: below this half side, px, the best of several turns is taken.
constexpr double kTurnTold_px = 6.0;
constexpr int kStartTurns = 3;  // over a right angle
// Pixel and lens together blur an edge by this much (1 sigma): a pixel's own width is 0.29 px, lenses double or treble
// that. The deviation is of its logarithm.
constexpr double kBlur_px = 0.6;
constexpr double kBlurSigma = 0.4;
// Pixels farther inside than this are not of an edge, px.
constexpr double kRim_px = 2.0;
// And so far outside, beyond the wall, px.
constexpr double kOutside_px = 2.5;
constexpr std::size_t kMaxFacePixels = 3000;
// A pixel darker than this fraction of the ring and without depth is dark background.
constexpr double kDarkFraction = 0.3;
// And of the top: brighter, it may as well be a pixel of the top that lost its depth.
constexpr double kDarkOfTop = 0.5;
// Foil's relief is noise of the layer in proportion to a pixel's light. Up to so much of the top's light it is within
// what is measured of all pixels.
constexpr double kBrightOfTop = 1.5;
// Pixels with depth that the noise is measured from.
constexpr std::size_t kMinMeasuredPixels = 12;
// Residuals larger than this many deviations count as much as one of that size (Huber).
constexpr double kHuber = 1.5;
// And in the sums along the outline, which tell what neighbouring pixels share.
constexpr double kOutlier = 3.0;
// A wall's brightness over the cosine law's is that of the ring's walls to within this.
constexpr double kWallSigma = 0.3;
// Sides differ by this fraction (1 sigma): the paper's limits of 0.7 and 1.5 are 2.5 such deviations.
constexpr double kSquareSigma = 0.15;
// Foil of uneven height, rounded corners and painted rims shift the rectangle as a whole: averaging does not reduce
// that. Root mean square over the simulated classes.
constexpr double kSilhouetteSigma_px = 0.1;
// Deviation of a box's centre in the depths, px: used where its edges are not fitted.
constexpr double kCoarseSigma_px = 0.8;
// Of a fit that follows the box: sides over those of the box, either way, and movement of the centre in pixels.
constexpr double kMaxSideChange = 1.5;
constexpr double kMaxMove_px = 2.5;
// Scatter of the pixels over the top's brightness: beyond it there is no rectangle.
constexpr double kMaxScatter = 0.5;

class FaceFitter {
 public:
  FaceFitter(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
             const RaisedBox& box)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        ring_(ring.model),
        axes_(axes_of(ring.model.normal)),
        plane_(ring.model.plane()),
        dark_counts_(kDarkFraction * ring.amplitude),
        wall_light_(ring.walls),
        box_(box) {}

  ConnectorFace fit() {
    ConnectorFace face;
    face.rectangle = box_.rectangle;
    measure_top(face);
    metres_per_px_ = ring_.centre_m.z() / camera_.intrinsics.fx_px;
    const double coarse = kCoarseSigma_px * metres_per_px_ / std::max(0.3, -ring_.normal.z());
    face.covariance = coarse * coarse * Matrix2::Identity();
    if (!prepare(face)) return face;
    take_pixels(face);
    return refine_from_turns(face) ? best_ : face;
  }

 private:
  void measure_top(ConnectorFace& face) {
    const TopHeight top = top_height_of(frame_, camera_, rays_, ring_, box_);
    face.height_m = top.height_m;
    face.sigma_height_m = top.sigma_height_m;
    base_m_ = top.base_m;
    if (top.light > 0.0) {
      dark_counts_ = std::min(dark_counts_, kDarkOfTop * top.light);
      bright_counts_ = kBrightOfTop * top.light;
    }
  }

  Vector3 point(const Vector2& planar, double height) const {
    return ring_.centre_m + planar.x() * axes_.first + planar.y() * axes_.second + height * ring_.normal;
  }
  Vector2 planar(const Vector2& ray, double height) const {
    const double z = (1.0 - height * plane_.q.norm()) * plane_.z_m(ray);
    const Vector3 arm = z * Vector3(ray.x(), ray.y(), 1.0) - ring_.centre_m;
    return {axes_.first.dot(arm), axes_.second.dot(arm)};
  }
  // Pixels' size and walls' slope at the box.
  bool prepare(const ConnectorFace& face) {
    const Vector3 middle = point(face.rectangle.centre_m, face.height_m);
    const auto pixel = project(camera_.intrinsics, middle);
    if (!pixel || !(face.height_m - base_m_ > 0.3 * box_.step_m())) return false;
    middle_px_ = *pixel;
    const Vector2 at = planar(rays_.at(pixel->x(), pixel->y()), face.height_m);
    per_pixel_.col(0) = planar(rays_.at(pixel->x() + 1.0, pixel->y()), face.height_m) - at;
    per_pixel_.col(1) = planar(rays_.at(pixel->x(), pixel->y() + 1.0), face.height_m) - at;
    // In the top's plane, where the wall's foot appears beside its upper edge.
    foot_ = (face.height_m - base_m_) / ring_.normal.dot(middle) *
            Vector2(axes_.first.dot(middle), axes_.second.dot(middle));
    return true;
  }
  double blur_m(const Vector2& direction) const { return blur_px_ * (per_pixel_.transpose() * direction).norm(); }

  // Pixels of the rectangle's surroundings, their places in the top's plane.
  void take_pixels(const ConnectorFace& face) {
    pixels_.clear();
    const double step = face.height_m - base_m_;
    const double reach = face.rectangle.half_sides_m.norm() + foot_.norm();
    const Matrix2 to_pixel = per_pixel_.inverse();
    const double wide = to_pixel.row(0).norm() * reach + kOutside_px,
                 tall = to_pixel.row(1).norm() * reach + kOutside_px;
    const auto clamped = [](double value, std::int32_t size) {
      return static_cast<std::int32_t>(std::clamp(value, 0.0, size - 1.0));
    };
    const std::int32_t right = clamped(middle_px_.x() + wide, frame_.depth.width_px);
    const std::int32_t bottom = clamped(middle_px_.y() + tall, frame_.depth.height_px);
    for (std::int32_t v = clamped(middle_px_.y() - tall, frame_.depth.height_px); v <= bottom; ++v) {
      for (std::int32_t u = clamped(middle_px_.x() - wide, frame_.depth.width_px); u <= right; ++u) {
        const std::uint16_t depth = frame_.depth.at(u, v), light = frame_.intensity.at(u, v);
        if (light == kFullScale) continue;
        const Vector2 ray = rays_.at(u, v);
        double layer = 0.0;
        if (has_depth(depth)) {
          const double over = (plane_.height_m(ray, depth_z_m(camera_, depth)) - base_m_) / step;
          if (over > 2.0) continue;  // something before the satellite
          layer = light * std::max(over, -1.0);
        } else if (light > dark_counts_) {
          continue;
        }
        const double weight = std::min(1.0, bright_counts_ / std::max<double>(light, 1.0));
        if (!pixels_.push_back({planar(ray, face.height_m), static_cast<float>(layer), static_cast<float>(weight)}))
          return;
      }
    }
  }

  FaceSides sides_of(const PlanarRectangle& r) const {
    FaceSides sides;
    sides.first = r.outward(0);
    sides.second = r.outward(1);
    sides.along = {r.half_sides_m.x(), blur_m(sides.first), foot_.dot(sides.first)};
    sides.across = {r.half_sides_m.y(), blur_m(sides.second), foot_.dot(sides.second)};
    return sides;
  }

  // Cosine law: the wall's incidence over the top's.
  Vector2 cosine_ratio(const PlanarRectangle& r) const {
    const double step = box_.step_m();
    return {std::min(1.0, std::fabs(foot_.dot(r.outward(0))) / step),
            std::min(1.0, std::fabs(foot_.dot(r.outward(1))) / step)};
  }

  // Fits from the box's turn, or from several; the fit whose pixels are least off goes to best_.
  bool refine_from_turns(const ConnectorFace& face) {
    const bool is_told = face.rectangle.half_sides_m.maxCoeff() > kTurnTold_px * metres_per_px_;
    double least = 0.0, unit = 0.0;
    for (int k = 0; k < (is_told ? 1 : kStartTurns); ++k) {
      ConnectorFace one = face;
      one.rectangle.angle_rad += k * 0.5 * kPi / kStartTurns;
      blur_px_ = kBlur_px;
      if (!refine(one) || !follows_box(one)) continue;
      one.covariance += (shared_ - 1.0) * (one.covariance - one.common_variance_m2 * Matrix2::Identity());
      if (unit == 0.0) unit = sigma_;
      const double loss = mean_loss(static_cast<std::size_t>(one.edge_points), unit);
      if (least > 0.0 && loss >= least) continue;
      least = loss;
      compare_with_disc({pixels_.data(), pixels_.size()}, sides_of(one.rectangle), {brightness_, sigma_}, one);
      best_ = one;
    }
    return least > 0.0;
  }
  // Huber's, of the last round's residuals.
  double mean_loss(std::size_t used, double unit) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < used; ++i) {
      const double size = residuals_[i] / unit;
      sum += size < kHuber ? size * size : kHuber * (2.0 * size - kHuber);
    }
    return sum / static_cast<double>(used);
  }

  bool refine(ConnectorFace& face) {
    PlanarRectangle& r = face.rectangle;
    Vector2 walls = wall_light_.ratio * cosine_ratio(r);
    const double wall_sigma = std::sqrt(kWallSigma * kWallSigma + wall_light_.variance);
    double brightness = starting_brightness(r);
    if (!(brightness > 0.0)) return false;
    double sigma = 0.3 * brightness;
    OutlineScatter scatter;
    for (int round = 0; round < kRounds; ++round) {
      Matrix9 normal = Matrix9::Zero();
      Vector9 right = Vector9::Zero();
      std::size_t used = 0, measured = 0;
      const FaceSides sides = sides_of(r);
      for (const FacePixel& p : pixels_) {
        Vector9 row;
        double residual = 0.0;
        if (!observe(p, r, sides, walls, brightness, row, residual)) continue;
        const double size = std::fabs(residual);
        residuals_[used] = size;
        if (p.is_measured()) std::swap(residuals_[measured++], residuals_[used]);  // these come first
        ++used;
        if (round + 1 == kRounds) add_to(scatter, p, r, sides, row, residual, sigma);
        const double weight = size > kHuber * sigma ? kHuber * sigma / size : 1.0;
        add_outer<9>(normal, row, weight);
        right += weight * residual * row;
      }
      if (used < 24 || measured < kMinMeasuredPixels) return false;
      sigma = std::max(1e-3 * brightness, kMedianToSigma * median(residuals_.data(), measured));
      const double unit = 1.0 / (sigma * sigma);
      normal *= unit;
      right *= unit;
      const Vector2 cosine = cosine_ratio(r);
      for (int k = 0; k < 2; ++k) {
        const double known = 1.0 / std::pow(wall_sigma * cosine[k] + 0.02, 2);
        normal(kWalls + k, kWalls + k) += known;
        right[kWalls + k] += known * (wall_light_.ratio * cosine[k] - walls[k]);
      }
      const double blurred = std::log(blur_px_ / kBlur_px);
      normal(kBlur, kBlur) += 1.0 / (kBlurSigma * kBlurSigma);
      right[kBlur] -= blurred / (kBlurSigma * kBlurSigma);
      // Nearly square, as far as the pixels do not tell.
      const double half = 0.5 * (r.half_sides_m.x() + r.half_sides_m.y());
      const double tight = 1.0 / (kSquareSigma * kSquareSigma * half * half);
      const double excess = r.half_sides_m.x() - r.half_sides_m.y();
      normal(3, 3) += tight;
      normal(4, 4) += tight;
      normal(3, 4) -= tight;
      normal(4, 3) -= tight;
      right[3] -= tight * excess;
      right[4] += tight * excess;
      const auto inverse = positive_inverse<9>(normal);
      if (!inverse) return false;
      const Vector9 change = *inverse * right;
      if (!change.allFinite()) return false;
      r.centre_m += limited(change.head<2>(), metres_per_px_);
      r.angle_rad += std::clamp(change[2], -0.2, 0.2);
      for (int k = 0; k < 2; ++k) {
        const double side = r.half_sides_m[k];
        r.half_sides_m[k] = std::clamp(side + change[3 + k], 0.7 * side, 1.4 * side);
        walls[k] = std::clamp(walls[k] + change[kWalls + k], 0.0, 1.2);
      }
      blur_px_ = kBlur_px * std::exp(std::clamp(blurred + change[kBlur], -0.8, 0.8));
      brightness = std::clamp(brightness + change[kBrightness], 0.5 * brightness, 2.0 * brightness);
      face.edge_points = static_cast<std::int32_t>(used);
      face.covariance = inverse->topLeftCorner<2, 2>();
    }
    const double common = kSilhouetteSigma_px * metres_per_px_;
    face.common_variance_m2 = common * common;
    face.covariance = kFaceCorrelation * face.covariance + common * common * Matrix2::Identity();
    shared_ = std::max(1.0, scatter.ratio(sigma) / kFaceCorrelation);
    brightness_ = brightness;
    sigma_ = sigma;
    // An edge falls by 0.4 of the brightness over a blur's deviation.
    face.edge_rms_px = sigma / brightness * blur_px_ / 0.4;
    return sigma < kMaxScatter * brightness;
  }

  void add_to(OutlineScatter& scatter, const FacePixel& p, const PlanarRectangle& r, const FaceSides& sides,
              const Vector9& row, double residual, double sigma) const {
    const Vector2 off = p.place_m - r.centre_m;
    const Vector2 at = Vector2(sides.first.dot(off), sides.second.dot(off)).cwiseQuotient(r.half_sides_m);
    const int axis = std::fabs(at.x()) > std::fabs(at.y()) ? 0 : 1;
    scatter.add(axis + (at[axis] > 0.0 ? 2 : 0), at[1 - axis], row[3 + axis],
                std::clamp(residual, -kOutlier * sigma, kOutlier * sigma));
  }

  static Vector2 limited(const Vector2& by, double most) {
    const double size = by.norm();
    return size > most ? Vector2(most / size * by) : by;
  }

  double starting_brightness(const PlanarRectangle& r) {
    std::size_t count = 0;
    for (const FacePixel& p : pixels_) {
      const Vector2 off = p.place_m - r.centre_m;
      if (std::fabs(r.outward(0).dot(off)) < 0.8 * r.half_sides_m.x() &&
          std::fabs(r.outward(1).dot(off)) < 0.8 * r.half_sides_m.y()) {
        residuals_[count++] = static_cast<double>(p.layer);
      }
    }
    return count > 0 ? median(residuals_.data(), count) : 0.0;
  }

  // A pixel's residual and derivatives; false where it is not about the sides.
  bool observe(const FacePixel& p, const PlanarRectangle& r, const FaceSides& sides, const Vector2& walls,
               double brightness, Vector9& row, double& residual) const {
    const Vector2 off = p.place_m - r.centre_m;
    const double s = sides.first.dot(off), t = sides.second.dot(off);
    const double inside_s = (r.half_sides_m.x() - std::fabs(s)) / sides.along.blur_m * blur_px_;
    const double inside_t = (r.half_sides_m.y() - std::fabs(t)) / sides.across.blur_m * blur_px_;
    if (inside_s > kRim_px && inside_t > kRim_px) return false;
    if (inside_s < -kOutside_px - std::fabs(sides.along.foot_m) / sides.along.blur_m * blur_px_ ||
        inside_t < -kOutside_px - std::fabs(sides.across.foot_m) / sides.across.blur_m * blur_px_) {
      return false;
    }
    const EdgeProfile::Value x = sides.along.at(s, walls[0]), y = sides.across.at(t, walls[1]);
    const double cover = x.value * y.value;
    const double by_s = brightness * x.by_place * y.value, by_t = brightness * x.value * y.by_place;
    row << -by_s * sides.first.x() - by_t * sides.second.x(), -by_s * sides.first.y() - by_t * sides.second.y(),
        by_s * t - by_t * s, brightness * x.by_half * y.value, brightness * x.value * y.by_half, cover,
        brightness * x.by_wall * y.value, brightness * x.value * y.by_wall,
        brightness * (x.by_blur * y.value + x.value * y.by_blur);
    const double weight = static_cast<double>(p.weight);
    row *= weight;
    residual = weight * (static_cast<double>(p.layer) - brightness * cover);
    return true;
  }

  bool follows_box(const ConnectorFace& face) const {
    const PlanarRectangle &r = face.rectangle, &start = box_.rectangle;
    const double cell_px = 2.0 * metres_per_px_;
    if ((r.centre_m - start.centre_m).norm() > kMaxMove_px * metres_per_px_ / std::max(0.3, -ring_.normal.z())) {
      return false;
    }
    const double ratio = std::sqrt(r.area_m2() / start.area_m2());
    const double allowed = kMaxSideChange + cell_px / (2.0 * start.half_sides_m.minCoeff());
    return ratio < allowed && ratio * allowed > 1.0 && face.edge_points > 0 &&
           std::sqrt(face.covariance.trace()) < kCoarseSigma_px * metres_per_px_;
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& ring_;
  PlaneAxes axes_;
  DepthPlane plane_;
  double dark_counts_;
  double bright_counts_ = 1e9;
  WallLight wall_light_;
  const RaisedBox& box_;
  double base_m_ = 0.0;
  double metres_per_px_ = 0.0;
  double blur_px_ = kBlur_px, brightness_ = 0.0, sigma_ = 0.0;
  double shared_ = 1.0;  // variance by noise that pixels share, over what kFaceCorrelation says
  Vector2 middle_px_ = Vector2::Zero();
  Matrix2 per_pixel_ = Matrix2::Identity();  // d place in the top's plane / d pixel
  Vector2 foot_ = Vector2::Zero();
  StaticVector<FacePixel, kMaxFacePixels> pixels_;
  std::array<double, kMaxFacePixels> residuals_;
  ConnectorFace best_;
};

}  // namespace

ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const RaisedBox& box) {
  return FaceFitter(frame, camera, rays, ring, box).fit();
}

}  // namespace pharos::tof
