// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/patch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace pharos::slam {
namespace {

constexpr int kHalf_px = 4;  // of the square compared: 9x9
constexpr int kSide_px = 2 * kHalf_px + 1;
constexpr int kSteps = 8;
constexpr float kEnough_px = 0.01F;
constexpr float kMaxMove_px = 1.5F;  // a larger one means another corner
// Squared grey values a pixel, over the square: with less the position is undetermined.
constexpr float kMinSlopes = 81.0F;
constexpr float kMaxDissimilarity = 0.2F;  // of the square's own variance
constexpr float kMinContrast = 0.4F, kMaxContrast = 2.5F;
constexpr double kMinArea = 0.4, kMaxArea = 2.5;  // ratio of a pixel's areas in the two images

using Matrix2d = Eigen::Matrix2d;

// Jacobian from a step in the keyframe's image to one in the frame's, px.
std::optional<Matrix2d> step_of(const Patch& patch, const Pose<frame::Camera, frame::Camera>& T_frame_keyframe,
                                const StereoCamera& camera) {
  const double step_px = kHalf_px * patch.scale_px;
  std::array<Vector2, 3> places;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vector2 off(k == 1 ? step_px : 0.0, k == 2 ? step_px : 0.0);
    const double disparity = patch.disparity_px + patch.disparity_slope.dot(off);
    if (!(disparity > 0.0)) return std::nullopt;
    const Vector3 p = T_frame_keyframe * camera.back_project(patch.pixel + off, camera.depth_m(disparity));
    if (!(p.z() > 1e-3)) return std::nullopt;
    places[k] = camera.project(p).head<2>();
  }
  Matrix2d step;
  step << (places[1] - places[0]) / step_px, (places[2] - places[0]) / step_px;
  return step;
}

// The patch as predicted in the frame: grey values minus their mean, and their gradient along u and v.
struct Template {
  std::array<float, kSide_px * kSide_px> value, along_u, along_v;
  float variance = 0.0F;
};

bool sample(const Patch& patch, const Matrix2d& to_patch, Template& out) {
  constexpr int kRing_px = kHalf_px + 1;
  constexpr int kWide = 2 * kRing_px + 1;
  const double reach_u = kRing_px * (std::abs(to_patch(0, 0)) + std::abs(to_patch(0, 1))) + 0.5;
  const double reach_v = kRing_px * (std::abs(to_patch(1, 0)) + std::abs(to_patch(1, 1))) + 0.5;
  if (std::max(reach_u, reach_v) >= Patch::kReach_px) return false;
  std::array<float, kWide * kWide> wide;
  std::size_t at = 0;
  for (int y = -kRing_px; y <= kRing_px; ++y) {
    for (int x = -kRing_px; x <= kRing_px; ++x) {
      const double u = Patch::kReach_px + patch.off_middle_px.x() + to_patch(0, 0) * x + to_patch(0, 1) * y;
      const double v = Patch::kReach_px + patch.off_middle_px.y() + to_patch(1, 0) * x + to_patch(1, 1) * y;
      const auto whole_u = static_cast<int>(u), whole_v = static_cast<int>(v);
      const auto fu = static_cast<float>(u - whole_u), fv = static_cast<float>(v - whole_v);
      const std::uint8_t* row = patch.pixels.data() + whole_v * Patch::kSide_px + whole_u;
      const auto a = static_cast<float>(row[0]), b = static_cast<float>(row[1]);
      const auto c = static_cast<float>(row[Patch::kSide_px]), d = static_cast<float>(row[Patch::kSide_px + 1]);
      const float top = a + fu * (b - a), bottom = c + fu * (d - c);
      wide[at++] = top + fv * (bottom - top);
    }
  }
  float sum = 0.0F;
  for (std::size_t k = 0; k < out.value.size(); ++k) {
    const std::size_t middle = (k / kSide_px + 1) * kWide + k % kSide_px + 1;
    out.value[k] = wide[middle];
    out.along_u[k] = 0.5F * (wide[middle + 1] - wide[middle - 1]);
    out.along_v[k] = 0.5F * (wide[middle + kWide] - wide[middle - kWide]);
    sum += wide[middle];
  }
  const float mean = sum / static_cast<float>(out.value.size());
  out.variance = 0.0F;
  for (float& value : out.value) {
    value -= mean;
    out.variance += value * value;
  }
  return true;
}

// Position along u and v, contrast, brightness, and the slopes of brightness along u and v, grey values a pixel.
constexpr int kUnknowns = 6;
using Vector6f = Eigen::Matrix<float, kUnknowns, 1>;
using Matrix6f = Eigen::Matrix<float, kUnknowns, kUnknowns>;

// J^T r and r^T r of r = I(start + position) - contrast T - brightness - slope_u x - slope_v y.
bool compare(const Template& patch, ImageView<const std::uint8_t> image, const Vector2& start, const Vector6f& at,
             Vector6f& gradient, float& residual_variance) {
  const Vector2 place = start + at.head<2>().cast<double>();
  const double u = place.x() - kHalf_px, v = place.y() - kHalf_px;
  if (!(u >= 0.0 && v >= 0.0 && u + kSide_px < image.width_px && v + kSide_px < image.height_px)) return false;
  const auto whole_u = static_cast<int>(u), whole_v = static_cast<int>(v);
  const auto fu = static_cast<float>(u - whole_u), fv = static_cast<float>(v - whole_v);
  gradient.setZero();
  residual_variance = 0.0F;
  for (int y = 0; y < kSide_px; ++y) {
    const std::uint8_t* top = image.row(whole_v + y) + whole_u;
    const std::uint8_t* bottom = image.row(whole_v + y + 1) + whole_u;
    const std::size_t row = static_cast<std::size_t>(y) * kSide_px;
    std::array<float, kSide_px + 1> between;
    for (std::size_t x = 0; x < between.size(); ++x) {
      between[x] = static_cast<float>(top[x]) + fv * static_cast<float>(bottom[x] - top[x]);
    }
    const auto off_v = static_cast<float>(y - kHalf_px);
    for (std::size_t x = 0; x < kSide_px; ++x) {
      const float seen = between[x] + fu * (between[x + 1] - between[x]);
      const float off_u = static_cast<float>(x) - kHalf_px;
      const float r = seen - at[2] * patch.value[row + x] - at[3] - at[4] * off_u - at[5] * off_v;
      gradient[0] += patch.along_u[row + x] * r;
      gradient[1] += patch.along_v[row + x] * r;
      gradient[2] -= patch.value[row + x] * r;
      gradient[3] -= r;
      gradient[4] -= off_u * r;
      gradient[5] -= off_v * r;
      residual_variance += r * r;
    }
  }
  return true;
}

Matrix6f squares_of(const Template& patch) {
  constexpr float kCount = kSide_px * kSide_px, kSquares = kCount * kHalf_px * (kHalf_px + 1) / 3.0F;
  Eigen::Matrix3f texture = Eigen::Matrix3f::Zero(), light_texture = Eigen::Matrix3f::Zero();
  for (std::size_t k = 0; k < patch.value.size(); ++k) {
    const auto off_u = static_cast<float>(k % kSide_px) - kHalf_px;
    const std::size_t row = k / kSide_px;
    const auto off_v = static_cast<float>(row) - kHalf_px;
    const Eigen::Vector3f of_texture(patch.along_u[k], patch.along_v[k], -patch.value[k]),
        of_light(-1.0F, -off_u, -off_v);
    texture.noalias() += of_texture * of_texture.transpose();
    light_texture.noalias() += of_light * of_texture.transpose();
  }
  // Brightness and its slopes are orthogonal over the square: the sums of x, y and x y are zero.
  const Eigen::Vector3f light(kCount, kSquares, kSquares);
  Matrix6f H;
  H << texture, light_texture.transpose(), light_texture, light.asDiagonal().toDenseMatrix();
  return H;
}

}  // namespace

std::optional<Patch> cut_patch(KeyframeId keyframe, const Feature& feature, const std::vector<PyramidLevel>& pyramid) {
  if (!feature.stereo() || pyramid.empty()) return std::nullopt;
  const ImageView<const std::uint8_t> image = pyramid[static_cast<std::size_t>(feature.level)].image;
  const LevelPlaces places(pyramid, feature.level);
  const Vector2 place = places.on_level(feature.pixel);
  const auto u = static_cast<int>(std::lround(place.x())), v = static_cast<int>(std::lround(place.y()));
  constexpr int kReach = Patch::kReach_px;
  if (u < kReach || v < kReach || u + kReach >= image.width_px || v + kReach >= image.height_px) return std::nullopt;
  Patch patch;
  patch.keyframe = keyframe;
  patch.level = feature.level;
  patch.scale_px = places.scale();
  patch.pixel = feature.pixel;
  patch.disparity_px = feature.pixel.x() - feature.right_u_px;
  patch.disparity_slope = feature.disparity_slope;
  patch.off_middle_px = place - Vector2(u, v);
  auto out = patch.pixels.begin();
  for (int row = v - kReach; row <= v + kReach; ++row) {
    out = std::copy_n(image.row(row) + u - kReach, Patch::kSide_px, out);
  }
  return patch;
}

std::optional<FoundPatch> find_patch(const Patch& patch, const Pose<frame::Camera, frame::Camera>& T_frame_keyframe,
                                     const StereoCamera& camera, const Feature& feature,
                                     const std::vector<PyramidLevel>& pyramid) {
  const LevelPlaces places(pyramid, feature.level);
  const double scale = places.scale();
  const auto step = step_of(patch, T_frame_keyframe, camera);
  if (!step) return std::nullopt;
  const Matrix2d to_patch = scale / patch.scale_px * step->inverse();
  const double area = to_patch.determinant();
  Template seen;
  if (!(area > kMinArea && area < kMaxArea) || !sample(patch, to_patch, seen)) return std::nullopt;
  const Matrix6f H = squares_of(seen);
  const float slopes = 0.5F * (H(0, 0) + H(1, 1) - std::hypot(H(0, 0) - H(1, 1), 2.0F * H(0, 1)));
  if (!(slopes > kMinSlopes)) return std::nullopt;
  const Eigen::LDLT<Matrix6f> solver(H);
  const ImageView<const std::uint8_t> image = pyramid[static_cast<std::size_t>(feature.level)].image;
  const Vector2 start = places.on_level(feature.pixel);
  Vector6f off = Vector6f::Zero(), gradient;
  off[2] = 1.0F;
  float residual_variance = 0.0F, moved = kMaxMove_px;
  for (int k = 0; k < kSteps && moved > kEnough_px; ++k) {
    if (!compare(seen, image, start, off, gradient, residual_variance)) return std::nullopt;
    const Vector6f move = solver.solve(gradient);
    off -= move;
    moved = move.head<2>().norm();
    if (!(off.head<2>().norm() < kMaxMove_px)) return std::nullopt;
  }
  if (moved > 5.0F * kEnough_px || !(off[2] > kMinContrast && off[2] < kMaxContrast) ||
      residual_variance > kMaxDissimilarity * off[2] * off[2] * seen.variance) {
    return std::nullopt;
  }
  const auto spare = static_cast<float>(seen.value.size() - kUnknowns);
  // Along the direction of the smaller gradient.
  const double variance = static_cast<double>(residual_variance / spare / slopes);
  return FoundPatch{feature.pixel + scale * off.head<2>().cast<double>(),
                    std::min(kCornerSigma_px, std::sqrt(kPatchSigma_px * kPatchSigma_px + variance))};
}

}  // namespace pharos::slam
