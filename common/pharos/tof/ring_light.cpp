// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_light.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/edge_profile.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

using Vector10 = Eigen::Matrix<double, 10, 1>;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using RowsByProfile = Eigen::Matrix<double, 10, 5>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

// Of the unknowns, after the ring's seven: logarithm of the blur, brightness of the outer and the inner wall.
constexpr int kBlurAt = 7;
constexpr int kWallsAt = 8;

constexpr int kLightSteps = 3;
// Pixel and lens together blur an edge by this much (1 sigma): a pixel's own width is 0.29 px, lenses double or treble
// that. The deviation is of its logarithm.
constexpr double kRingBlur_px = 0.6;
constexpr double kRingBlurSigma = 0.5;
// A wall's light over that of the face by the cosine law: another paint, another finish.
constexpr double kWallLightSigma = 0.5;
// Pixels farther within the ring than this are its face only; so far beyond an edge, or its wall's foot, there is none
// of the ring's light.
constexpr double kFace_px = 3.0;
constexpr double kBeyond_px = 3.0;
// A wall as bright as this fraction of the face is one surface with it.
constexpr double kWallLikeFace = 0.9;
// Residuals larger than this many deviations count as much as one of that size (Huber).
constexpr double kLightHuber = 2.0;
// Per px of an edge: a pixel that says less of its place does not count for the noise that neighbours share.
constexpr double kMinSlope = 0.05;
// Pixels of a sector's face below which its light is that of the whole ring.
constexpr double kMinSectorSquare = 4.0;
// Scatter over the face's light before anything is fitted.
constexpr double kFirstScatter = 0.2;
constexpr std::size_t kMinLightPixels = 200;

class RingLightFitter {
 public:
  RingLightFitter(const RingModel& model, const RingPrior& prior, const RingKnowledge& known,
                  RingLightWorkspace& workspace)
      : model_(model), prior_(prior), known_(known), work_(workspace) {}

  std::optional<RingLight> fit(double margin_px) {
    work_.blur_px = kRingBlur_px;
    walls_ = {1.0, 1.0};
    step_.setZero();
    Matrix10 covariance = Matrix10::Zero();
    double sigma = 0.0;
    for (RingDirection& one : work_.directions) {
      one.light = 0.0;
      one.moved_px = {0.0, 0.0};
    }
    if (!pass(sigma) || !take_light()) return std::nullopt;
    sigma = kFirstScatter * work_.directions[0].light;
    for (int k = 0; k < kLightSteps; ++k) {
      if (!solve(sigma, covariance)) return std::nullopt;
    }
    return RingLight{step_, covariance.topLeftCorner<7, 7>(), plane_bias(margin_px), used_};
  }

 private:
  // Depth of what is beyond the edge that the pixel is nearer to; 0 where that is not known to lie behind the ring.
  double base_of(const RingPixel& pixel, const RingDirection& one) const {
    const std::size_t e = work_.beyond_px(pixel, 0) > work_.beyond_px(pixel, 1) ? 0 : 1;
    double base = one.base_m[e];
    if (one.foot_px[e] > 0.0 || base == 0.0) base = std::min(base, -work_.base_m);
    return base < -prior_.min_step_m ? base : 0.0;
  }

  struct Observed {
    double layer = 0.0;
    EdgeProfile::Value profile;
    std::array<double, 2> by_edge{};
    std::array<double, 2> by_wall{};
  };

  // Across the direction's bar: place from its middle, with the wall of the side where one is in sight.
  bool observe(const RingPixel& pixel, Observed& seen) const {
    const RingDirection& one = work_.directions[pixel.direction];
    for (std::size_t e = 0; e < 2; ++e) {
      if (one.foot_px[e] > 0.0 && one.wall[e] > kWallLikeFace && work_.beyond_px(pixel, e) > -kFace_px) return false;
      if (work_.beyond_px(pixel, e) > one.foot_px[e] + kBeyond_px) return false;
    }
    const double base = base_of(pixel, one);
    if (!(base < 0.0)) return false;
    seen.layer = static_cast<double>(pixel.light) * std::max(-1.0, 1.0 - double{pixel.height_m} / base);
    const double outer = work_.beyond_px(pixel, 0) - one.moved_px[0],
                 inner = -work_.beyond_px(pixel, 1) - one.moved_px[1];
    const std::size_t side = one.foot_px[0] >= one.foot_px[1] ? 0 : 1;
    const EdgeProfile across{0.5 * (inner - outer), work_.blur_px, side == 0 ? one.foot_px[0] : -one.foot_px[1]};
    seen.profile = across.at(0.5 * (inner + outer), walls_[side] * one.wall[side]);
    // An edge that moves outwards moves the middle and half of the width.
    seen.by_edge = {0.5 * (seen.profile.by_half - seen.profile.by_place),
                    0.5 * (-seen.profile.by_half - seen.profile.by_place)};
    seen.by_wall = {0.0, 0.0};
    seen.by_wall[side] = seen.profile.by_wall * one.wall[side];
    return true;
  }

  // All pixels once: sums about the present profile, and the scatter for the next time. `sigma`: 0 for the first time,
  // when only the face's light is wanted.
  bool pass(double& sigma) {
    for (RingDirectionSums& one : work_.sums) {
      one.normal.setZero();
      one.right.setZero();
      one.with_light.setZero();
      one.light_square = one.light_right = 0.0;
    }
    std::array<SectorSums, 2> shared;
    std::size_t count = 0;
    Observed seen;
    for (const RingPixel& pixel : work_.pixels) {
      if (!observe(pixel, seen)) continue;
      const RingDirection& one = work_.directions[pixel.direction];
      RingDirectionSums& sums = work_.sums[pixel.direction];
      const double residual = seen.layer - one.light * seen.profile.value;
      const double size = std::fabs(residual);
      work_.sizes[count++] = static_cast<float>(size);
      const double weight = sigma > 0.0 && size > kLightHuber * sigma ? kLightHuber * sigma / size : 1.0;
      sums.light_square += weight * seen.profile.value * seen.profile.value;
      sums.light_right += weight * residual * seen.profile.value;
      if (!(sigma > 0.0)) continue;
      Vector5 row;
      row << seen.by_edge[0], seen.by_edge[1], seen.profile.by_blur, seen.by_wall[0], seen.by_wall[1];
      row *= one.light;
      add_outer<5>(sums.normal, row, weight);
      sums.right += weight * residual * row;
      sums.with_light += weight * seen.profile.value * row;
      for (std::size_t e = 0; e < 2; ++e) {
        if (std::fabs(seen.by_edge[e]) < kMinSlope) continue;
        shared[e].add(one.plan.x(), one.plan.y(), row[static_cast<int>(e)] * row[static_cast<int>(e)],
                      weight * residual / row[static_cast<int>(e)]);
      }
    }
    used_ = static_cast<std::int32_t>(count);
    if (count < kMinLightPixels) return false;
    inflation_ = 0.5 * (shared[0].variance_inflation(4) + shared[1].variance_inflation(4));
    const auto middle = work_.sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(work_.sizes.begin(), middle, work_.sizes.begin() + static_cast<std::ptrdiff_t>(count));
    sigma = std::max(1e-3 * prior_.amplitude, kMedianToSigma * double{*middle});
    return true;
  }

  // The sectors' light from the last pass alone, before edges and blur are fitted.
  bool take_light() {
    double square = 0.0, right = 0.0;
    for (const RingDirectionSums& sums : work_.sums) {
      square += sums.light_square;
      right += sums.light_right;
    }
    if (!(square > 0.0) || !(right > 0.0)) return false;
    for (RingDirection& one : work_.directions) one.light = right / square;
    return true;
  }

  // Expands the directions' sums to the unknowns and eliminates the sectors' light.
  void expand(Matrix10& normal, Vector10& right) {
    for (std::size_t s = 0; s < kRingSectors; ++s) {
      Vector10 with_light = Vector10::Zero();
      double square = 0.0, light_right = 0.0;
      for (std::size_t k = s * kDirectionsTogether; k < (s + 1) * kDirectionsTogether; ++k) {
        const RingDirectionSums& sums = work_.sums[k];
        if (!(sums.light_square > 0.0)) continue;
        const RowsByProfile rows = rows_of(work_.directions[k]);
        const RowsByProfile half = rows.lazyProduct(sums.normal);
        normal += half.lazyProduct(rows.transpose());
        right += rows.lazyProduct(sums.right);
        with_light += rows.lazyProduct(sums.with_light);
        square += sums.light_square;
        light_right += sums.light_right;
      }
      sector_with_light_[s] = with_light;
      sector_square_[s] = square;
      sector_right_[s] = light_right;
      if (!(square > kMinSectorSquare)) continue;
      add_outer<10>(normal, with_light, -1.0 / square);
      right -= (light_right / square) * with_light;
    }
  }

  // The sectors' light that goes with a change of the other unknowns.
  void change_light(const Vector10& change) {
    for (std::size_t s = 0; s < kRingSectors; ++s) {
      if (!(sector_square_[s] > kMinSectorSquare)) continue;
      const double by = (sector_right_[s] - sector_with_light_[s].dot(change)) / sector_square_[s];
      for (std::size_t k = s * kDirectionsTogether; k < (s + 1) * kDirectionsTogether; ++k) {
        double& light = work_.directions[k].light;
        light = std::clamp(light + by, 0.5 * light, 2.0 * light);
      }
    }
  }

  static RowsByProfile rows_of(const RingDirection& one) {
    RowsByProfile rows = RowsByProfile::Zero();
    rows.col(0).head<7>() = one.row[0];
    rows.col(1).head<7>() = one.row[1];
    for (int k = 2; k < 5; ++k) rows(5 + k, k) = 1.0;
    return rows;
  }

  bool solve(double& sigma, Matrix10& covariance) {
    Matrix10 normal = Matrix10::Zero();
    Vector10 right = Vector10::Zero();
    const double scatter = sigma;
    if (!pass(sigma)) return false;
    expand(normal, right);
    const double unit = 1.0 / (scatter * scatter * inflation_);
    normal *= unit;
    right *= unit;
    const double blurred = std::log(work_.blur_px / kRingBlur_px);
    normal(kBlurAt, kBlurAt) += 1.0 / (kRingBlurSigma * kRingBlurSigma);
    right[kBlurAt] -= blurred / (kRingBlurSigma * kRingBlurSigma);
    for (int e = 0; e < 2; ++e) {
      normal(kWallsAt + e, kWallsAt + e) += 1.0 / (kWallLightSigma * kWallLightSigma);
      right[kWallsAt + e] += (1.0 - walls_[static_cast<std::size_t>(e)]) / (kWallLightSigma * kWallLightSigma);
    }
    normal.topLeftCorner<7, 7>() += known_.information;
    right.head<7>() += known_.right - known_.information.lazyProduct(step_);
    const auto inverse = positive_inverse<10>(normal);
    if (!inverse) return false;
    const Vector10 change = inverse->lazyProduct(right);
    if (!change.allFinite()) return false;
    change_light(change);
    step_ += change.head<7>();
    for (RingDirection& one : work_.directions) one.moved_px = {one.row[0].dot(step_), one.row[1].dot(step_)};
    work_.blur_px = kRingBlur_px * std::exp(std::clamp(blurred + change[kBlurAt], -1.0, 1.0));
    for (std::size_t e = 0; e < 2; ++e) {
      walls_[e] = std::clamp(walls_[e] + change[kWallsAt + static_cast<int>(e)], 0.0, 1.5);
    }
    covariance = *inverse;
    return true;
  }

  // Light times height, counts m, that comes from beyond an edge: the surroundings from the foot of a wall in sight on,
  // and the wall up to there.
  double moment_from_behind(const RingDirection& one, std::size_t e, double beyond_px) const {
    const double base =
        one.foot_px[e] > 0.0 || one.base_m[e] == 0.0 ? std::min(one.base_m[e], -work_.base_m) : one.base_m[e];
    const double behind = blurred_step(beyond_px - one.foot_px[e], work_.blur_px).value;
    double light = one.base_light[e] * behind;
    if (one.foot_px[e] > 0.0) {
      const double wall = walls_[e] * one.wall[e] * one.light;
      const double edge = blurred_step(beyond_px, work_.blur_px).value;
      const double ramp = std::clamp(1.0 - beyond_px / one.foot_px[e], 0.0, 1.0);
      light += wall * (edge - behind - ramp * edge);
    }
    return base * light;
  }

  Vector3 plane_bias(double margin_px) const {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    const double scale = 1.0 / (prior_.amplitude * prior_.amplitude);
    for (const RingPixel& pixel : work_.pixels) {
      const RingDirection& one = work_.directions[pixel.direction];
      const double outer = work_.beyond_px(pixel, 0) - one.moved_px[0],
                   inner = work_.beyond_px(pixel, 1) + one.moved_px[1];
      if (outer > -margin_px || inner > -margin_px || pixel.light == 0) continue;
      const double light = pixel.light;
      const double bias = (moment_from_behind(one, 0, outer) + moment_from_behind(one, 1, inner)) / light;
      const double r = model_.radius_m[0] + double{pixel.beyond_outer_px} / one.per_m[0];
      const Vector3 row(1.0, r * one.plan.x(), r * one.plan.y());
      const double weight = std::clamp(light * light * scale, 0.25, 4.0);
      normal += weight * row * row.transpose();
      right += weight * bias * row;
    }
    const auto inverse = positive_inverse<3>(normal);
    return inverse ? Vector3(*inverse * right) : Vector3(Vector3::Zero());
  }

  const RingModel& model_;
  const RingPrior& prior_;
  const RingKnowledge& known_;
  RingLightWorkspace& work_;
  std::array<double, 2> walls_{1.0, 1.0};
  Vector7 step_ = Vector7::Zero();
  std::array<Vector10, kRingSectors> sector_with_light_;
  std::array<double, kRingSectors> sector_square_{}, sector_right_{};
  double inflation_ = 1.0;
  std::int32_t used_ = 0;
};

}  // namespace

std::optional<RingLight> fit_ring_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                        const RingModel& model, const RingPrior& prior, const RingKnowledge& known,
                                        double margin_px, RingLightWorkspace& workspace) {
  if (!gather_ring_pixels(frame, camera, rays, model, prior, workspace)) return std::nullopt;
  return RingLightFitter(model, prior, known, workspace).fit(margin_px);
}

}  // namespace pharos::tof
