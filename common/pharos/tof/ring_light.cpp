// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/edge_profile.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

using Vector10 = Eigen::Matrix<double, 10, 1>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

// Of the unknowns, after the ring's seven: logarithm of the blur, brightness of the outer and the inner wall.
constexpr int kBlurAt = 7;
constexpr int kWallsAt = 8;

// Steps before the light from behind is subtracted from the plane, and after.
constexpr int kFirstSteps = 2;
constexpr int kLastSteps = 2;
// Pixel and lens together blur an edge by this much (1 sigma): a pixel's own width is 0.29 px, lenses double or treble
// that. The deviation is of its logarithm.
constexpr double kRingBlur_px = 0.6;
constexpr double kRingBlurSigma = 0.5;
// Pixels farther within the ring than this are its face only; so far beyond an edge, or its wall's foot, there is none
// of the ring's light.
constexpr double kFace_px = 3.0;
constexpr double kBeyond_px = 3.0;
// A wall as bright as this fraction of the face is one surface with it.
constexpr double kWallLikeFace = 0.9;
// Residuals larger than this many deviations count as much as one of that size (Huber).
constexpr double kLightHuber = 2.0;
// Pixels of a sector's face below which its light is that of the whole ring.
constexpr double kMinSectorSquare = 4.0;
// Scatter over the face's light before anything is fitted.
constexpr double kFirstScatter = 0.2;
constexpr std::size_t kMinLightPixels = 200;
// The scatter is that of so many residuals at most: a fortieth of itself is uncertain.
constexpr std::size_t kMaxScatterSizes = 1024;

// Which pixels are fitted, and their light from the ring's height.
class ColumnFiller {
 public:
  ColumnFiller(const RingPixels& pixels, const RingPrior& prior, RingLightColumns& columns)
      : pixels_(pixels), prior_(prior), columns_(columns) {}

  /// How many there are.
  std::size_t fill() {
    std::size_t count = 0;
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      columns_.begin[k] = static_cast<std::uint16_t>(next_);
      for (const RingPixel& pixel : pixels_.of(k)) add(pixel, pixels_.directions[k]);
      columns_.count[k] = static_cast<std::uint16_t>(next_ - columns_.begin[k]);
      count += columns_.count[k];
      while (next_ % kLightLanes != 0) {
        columns_.beyond_px[next_] = kFarBeyond_px;
        columns_.layer[next_++] = 0.0F;
      }
    }
    return count;
  }

 private:
  void add(const RingPixel& pixel, const RingDirection& one) {
    const std::array<double, 2> beyond = {static_cast<double>(pixel.beyond_outer_px),
                                          one.beyond_px(static_cast<double>(pixel.beyond_outer_px), 1)};
    for (std::size_t e = 0; e < 2; ++e) {
      if (one.foot_px[e] > 0.0 && one.wall[e] > kWallLikeFace && beyond[e] > -kFace_px) return;
      if (beyond[e] > one.foot_px[e] + kBeyond_px) return;
    }
    const double base = base_of(one, beyond[0] > beyond[1] ? 0 : 1);
    if (!(base < 0.0)) return;
    columns_.beyond_px[next_] = pixel.beyond_outer_px;
    columns_.layer[next_++] = static_cast<float>(static_cast<double>(pixel.light) *
                                                 std::max(-1.0, 1.0 - static_cast<double>(pixel.height_m) / base));
  }

  // Depth of what is beyond the edge that a pixel is nearer to; 0 where that is not known to lie behind the ring.
  double base_of(const RingDirection& one, std::size_t e) const {
    double base = one.base_m[e];
    if (one.foot_px[e] > 0.0 || base == 0.0) base = std::min(base, -pixels_.base_m);
    return base < -prior_.min_step_m ? base : 0.0;
  }

  const RingPixels& pixels_;
  const RingPrior& prior_;
  RingLightColumns& columns_;
  std::size_t next_ = 0;
};

// Sums of the unknowns beside a sector's light, which is eliminated.
struct LightOfSector {
  Vector10 with = Vector10::Zero();
  double square = 0.0, right = 0.0;

  bool is_known() const { return square > kMinSectorSquare; }
};

// Normal equations of a pass; the lower triangle is filled.
class LightEquations {
 public:
  Matrix10 normal = Matrix10::Zero();
  Vector10 right = Vector10::Zero();
  std::array<LightOfSector, kRingSectors> sectors;
  std::array<SectorSums, 2> shared;

  void add(const RingDirection& one, const RingLightSums& sums, LightOfSector& sector) {
    if (!(sums.light_square > 0.0)) return;
    const Vector7 &a = one.row[0], &b = one.row[1];
    const Vector7 of_a = sums.normal_at(0, 0) * a + sums.normal_at(1, 0) * b,
                  of_b = sums.normal_at(1, 0) * a + sums.normal_at(1, 1) * b;
    const auto wall = static_cast<int>(wall_side(one)) + kWallsAt;
    for (int i = 0; i < 7; ++i) {
      for (int k = 0; k <= i; ++k) normal(i, k) += a[i] * of_a[k] + b[i] * of_b[k];
      normal(kBlurAt, i) += sums.normal_at(2, 0) * a[i] + sums.normal_at(2, 1) * b[i];
      normal(wall, i) += sums.normal_at(3, 0) * a[i] + sums.normal_at(3, 1) * b[i];
    }
    normal(kBlurAt, kBlurAt) += sums.normal_at(2, 2);
    normal(wall, kBlurAt) += sums.normal_at(3, 2);
    normal(wall, wall) += sums.normal_at(3, 3);
    add_rows(one, sums.right, wall, right);
    add_rows(one, sums.with_light, wall, sector.with);
    sector.square += sums.light_square;
    sector.right += sums.light_right;
    for (std::size_t e = 0; e < 2; ++e) {
      const RingLightSums::Shared& part = sums.shared[e];
      shared[e].add_many(one.plan.x(), one.plan.y(), static_cast<int>(part.count + 0.5), part.weights, part.sum,
                         part.squares);
    }
  }

  // Once all directions are in.
  void eliminate_light() {
    for (const LightOfSector& sector : sectors) {
      if (!sector.is_known()) continue;
      for (int i = 0; i < 10; ++i) {
        for (int k = 0; k <= i; ++k) normal(i, k) -= sector.with[i] * sector.with[k] / sector.square;
      }
      right -= (sector.right / sector.square) * sector.with;
    }
    for (int i = 0; i < 10; ++i) {
      for (int k = 0; k < i; ++k) normal(k, i) = normal(i, k);
    }
  }

  double variance_inflation() const {
    return 0.5 * (shared[0].variance_inflation(4) + shared[1].variance_inflation(4));
  }

 private:
  static void add_rows(const RingDirection& one, const std::array<double, RingLightSums::kUnknowns>& values, int wall,
                       Vector10& to) {
    to.head<7>() += values[0] * one.row[0] + values[1] * one.row[1];
    to[kBlurAt] += values[2];
    to[wall] += values[3];
  }
};

class RingLightFitter {
 public:
  RingLightFitter(const RingModel& model, const RingPrior& prior, const RingKnowledge& known,
                  RingLightWorkspace& workspace)
      : model_(model), prior_(prior), known_(known), work_(workspace) {}

  std::optional<RingLight> fit(double margin_px) {
    work_.blur_px = kRingBlur_px;
    for (RingDirection& one : work_.directions) {
      one.light = 0.0;
      one.moved_px = {0.0, 0.0};
    }
    used_ = ColumnFiller(work_, prior_, work_.columns).fill();
    if (used_ < kMinLightPixels || !take_light()) return std::nullopt;
    RingLight result;
    for (int k = 0; k < kFirstSteps + kLastSteps; ++k) {
      if (k == kFirstSteps) result.plane_bias = plane_bias(margin_px);
      if (!solve(known_.offset + known_.by_bias * result.plane_bias, result)) return std::nullopt;
    }
    result.plane_bias = plane_bias(margin_px);
    result.step = step_;
    const Vector3 left = known_.offset + known_.by_bias * result.plane_bias - known_.by_step * step_;
    result.plane_chi2 = left.dot(known_.information * left);
    return result;
  }

 private:
  // The face's light over the whole ring, before edges and blur are fitted.
  bool take_light() {
    double square = 0.0, right = 0.0;
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      const RingLightSums sums = light_sums(work_.directions[k], k, {work_.blur_px, walls_, 0.0}, work_.columns);
      square += sums.light_square;
      right += sums.light_right;
    }
    if (!(square > 0.0) || !(right > 0.0)) return false;
    for (RingDirection& one : work_.directions) one.light = right / square;
    sigma_ = kFirstScatter * right / square;
    return true;
  }

  // Scatter of the last pass, for the weights of the next.
  double scatter() const {
    std::array<float, kMaxScatterSizes> sizes;
    const std::size_t every = 1 + used_ / kMaxScatterSizes;
    std::size_t count = 0, skip = 0;
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      const std::size_t begin = work_.columns.begin[k], end = begin + work_.columns.count[k];
      std::size_t i = begin + skip;
      for (; i < end; i += every) sizes[count++] = work_.columns.size[i];
      skip = i - end;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(count));
    return std::max(1e-3 * prior_.amplitude, kMedianToSigma * static_cast<double>(*middle));
  }

  bool solve(const Vector3& plane_offset, RingLight& result) {
    LightEquations equations;
    const RingProfile profile{work_.blur_px, walls_, kLightHuber * sigma_};
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      equations.add(work_.directions[k], light_sums(work_.directions[k], k, profile, work_.columns),
                    equations.sectors[k / kDirectionsTogether]);
    }
    equations.eliminate_light();
    const double unit = 1.0 / (sigma_ * sigma_ * equations.variance_inflation());
    sigma_ = scatter();
    Matrix10 normal = unit * equations.normal;
    Vector10 right = unit * equations.right;
    add_prior(plane_offset, normal, right);
    const auto inverse = positive_inverse<10>(normal);
    if (!inverse) return false;
    const Vector10 change = inverse->lazyProduct(right);
    if (!change.allFinite()) return false;
    change_light(equations.sectors, change);
    take(change);
    result.covariance = inverse->topLeftCorner<7, 7>();
    result.walls = both_walls(inverse->diagonal().tail<2>());
    return true;
  }

  void add_prior(const Vector3& plane_offset, Matrix10& normal, Vector10& right) const {
    constexpr double kOfBlur = 1.0 / (kRingBlurSigma * kRingBlurSigma), kOfWall = 1.0 / WallLight{}.variance;
    normal(kBlurAt, kBlurAt) += kOfBlur;
    right[kBlurAt] -= kOfBlur * std::log(work_.blur_px / kRingBlur_px);
    for (int e = 0; e < 2; ++e) {
      normal(kWallsAt + e, kWallsAt + e) += kOfWall;
      right[kWallsAt + e] += kOfWall * (1.0 - walls_[static_cast<std::size_t>(e)]);
    }
    const Matrix37 weighted = known_.information.lazyProduct(known_.by_step);
    normal.topLeftCorner<7, 7>() += known_.by_step.transpose().lazyProduct(weighted);
    right.head<7>() += weighted.transpose() * (plane_offset - known_.by_step * step_);
  }

  // One number for both walls: what either adds to what is known beforehand.
  WallLight both_walls(const Vector2& variances) const {
    WallLight both;
    const double before = 1.0 / both.variance;
    double information = before, sum = before * both.ratio;
    for (int e = 0; e < 2; ++e) {
      const double added = std::max(0.0, 1.0 / variances[e] - before);
      information += added;
      sum += added > 0.0 ? walls_[static_cast<std::size_t>(e)] / variances[e] - before * both.ratio : 0.0;
    }
    return {std::clamp(sum / information, 0.0, 1.5), 1.0 / information};
  }

  // The sectors' light that goes with a change of the other unknowns.
  void change_light(const std::array<LightOfSector, kRingSectors>& sectors, const Vector10& change) {
    for (std::size_t s = 0; s < kRingSectors; ++s) {
      if (!sectors[s].is_known()) continue;
      const double by = (sectors[s].right - sectors[s].with.dot(change)) / sectors[s].square;
      for (std::size_t k = s * kDirectionsTogether; k < (s + 1) * kDirectionsTogether; ++k) {
        double& light = work_.directions[k].light;
        light = std::clamp(light + by, 0.5 * light, 2.0 * light);
      }
    }
  }

  void take(const Vector10& change) {
    step_ += change.head<7>();
    for (RingDirection& one : work_.directions) one.moved_px = {one.row[0].dot(step_), one.row[1].dot(step_)};
    const double blurred = std::log(work_.blur_px / kRingBlur_px) + change[kBlurAt];
    work_.blur_px = kRingBlur_px * std::exp(std::clamp(blurred, -1.0, 1.0));
    for (std::size_t e = 0; e < 2; ++e) {
      walls_[e] = std::clamp(walls_[e] + change[kWallsAt + static_cast<int>(e)], 0.0, 1.5);
    }
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
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      const RingDirection& one = work_.directions[k];
      for (const RingPixel& pixel : work_.of(k)) {
        const double outer = static_cast<double>(pixel.beyond_outer_px) - one.moved_px[0],
                     inner = one.beyond_px(static_cast<double>(pixel.beyond_outer_px), 1) + one.moved_px[1];
        if (outer > -margin_px || inner > -margin_px || pixel.light == 0) continue;
        const double light = pixel.light;
        const double bias = (moment_from_behind(one, 0, outer) + moment_from_behind(one, 1, inner)) / light;
        const double r = model_.radius_m[0] + static_cast<double>(pixel.beyond_outer_px) / one.per_m[0];
        const Vector3 row(1.0, r * one.plan.x(), r * one.plan.y());
        const double weight = std::clamp(light * light * scale, 0.25, 4.0);
        add_outer<3>(normal, row, weight);
        right += (weight * bias) * row;
      }
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
  double sigma_ = 0.0;
  std::size_t used_ = 0;
};

}  // namespace

std::optional<RingLight> fit_ring_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                        const RingModel& model, const RingPrior& prior, const RingKnowledge& known,
                                        double margin_px, RingLightWorkspace& workspace) {
  if (!gather_ring_pixels(frame, camera, rays, model, prior, workspace)) return std::nullopt;
  return RingLightFitter(model, prior, known, workspace).fit(margin_px);
}

}  // namespace pharos::tof
