// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/square_shift.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace pharos::slam {
namespace {

// Squared grey values a pixel, over the square: with less the position is undetermined.
constexpr float kMinSlopes = 121.0F;

class LeftSquare {
 public:
  LeftSquare(ImageView<const std::uint8_t> left, int u, int v) {
    Eigen::Matrix4f H = Eigen::Matrix4f::Zero();
    std::size_t k = 0;
    for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
      const std::uint8_t* row = left.row(v + dv) + u;
      for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du, ++k) {
        value_[k] = static_cast<float>(row[du]);
        slope_[k] = 0.5F * static_cast<float>(row[du + 1] - row[du - 1]);
        const auto x = static_cast<float>(du), y = static_cast<float>(dv);
        const Shift J(1.0F, slope_[k], slope_[k] * x, slope_[k] * y);
        H.noalias() += J * J.transpose();
      }
    }
    slopes_ = H(1, 1);
    solver_.compute(H);
  }
  bool is_determined() const { return slopes_ > kMinSlopes; }

  // Correction of the shift; empty where the square extends beyond the image.
  std::optional<Shift> step(ImageView<const std::uint8_t> right, int v, double column, const Shift& shift) const {
    Shift g = Shift::Zero();
    std::size_t k = 0;
    const auto last = static_cast<float>(right.width_px - 2);
    for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
      const std::uint8_t* row = right.row(v + dv);
      const auto y = static_cast<float>(dv);
      const float middle = static_cast<float>(column) + shift[1] + shift[3] * y, step = 1.0F + shift[2];
      if (!(middle - kSquareRadius_px * step >= 0.0F && middle + kSquareRadius_px * step < last)) return std::nullopt;
      float sum = 0.0F, sloped = 0.0F, sloped_x = 0.0F;
      for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du, ++k) {
        const auto x = static_cast<float>(du);
        const float place = middle + step * x;
        const auto whole = static_cast<int>(place);
        const auto at = static_cast<float>(row[whole]), after = static_cast<float>(row[whole + 1]);
        const float off = value_[k] - (at + (place - static_cast<float>(whole)) * (after - at)) - shift[0];
        sum += off;
        sloped += slope_[k] * off;
        sloped_x += slope_[k] * x * off;
      }
      g += Shift(sum, sloped, sloped_x, y * sloped);
    }
    return solver_.solve(g);
  }

 private:
  static constexpr int kSide_px = 2 * kSquareRadius_px + 1;
  std::array<float, static_cast<std::size_t>(kSide_px*kSide_px)> value_, slope_;
  float slopes_ = 0.0F;
  Eigen::LDLT<Eigen::Matrix4f> solver_;
};

}  // namespace

std::optional<Shift> square_shift(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v,
                                  double column) {
  constexpr int kSteps = 8;
  constexpr float kEnough_px = 0.005F, kMaxShift_px = 1.0F, kMaxStretch = 0.3F;
  const LeftSquare square(left, u, v);
  if (!square.is_determined()) return std::nullopt;
  Shift shift = Shift::Zero();
  for (int k = 0; k < kSteps; ++k) {
    const auto move = square.step(right, v, column, shift);
    if (!move) return std::nullopt;
    shift += *move;
    if (!(std::abs(shift[1]) < kMaxShift_px && shift.tail<2>().cwiseAbs().maxCoeff() < kMaxStretch)) {
      return std::nullopt;
    }
    if (std::abs((*move)[1]) < kEnough_px) break;
  }
  return shift;
}

}  // namespace pharos::slam
