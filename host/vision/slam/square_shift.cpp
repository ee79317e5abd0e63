// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/square_shift.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::slam {
namespace {

constexpr int kSide_px = 2 * kSquareRadius_px + 1;
constexpr std::size_t kPixels = static_cast<std::size_t>(kSide_px) * kSide_px;
using Square = std::array<float, kPixels>;

// Squared grey values a pixel, over the square: with less the position is undetermined.
constexpr float kMinSlopes = 121.0F;
// Standard deviation of the weights about the middle: the surface that is measured is the one there.
constexpr float kNear_px = 4.0F;
// Weight a quarter, in robust sigmas of the residuals; and the least sigma, grey values.
constexpr float kUnlike = 1.5F, kMinSigma = 2.0F;

const Square& weights_about_middle() {
  static const Square weights = [] {
    Square out;
    auto at = out.begin();
    for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
      for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du) {
        *at++ = std::exp(-0.5F * static_cast<float>(du * du + dv * dv) / (kNear_px * kNear_px));
      }
    }
    return out;
  }();
  return weights;
}

// Squares of the residuals, each the mean of a pixel's and its neighbours': surfaces are regions, and where a foreign
// one happens to have the same brightness it is no less foreign.
Square mean_squares(const Square& residuals) {
  Square rows{}, out{};
  const auto sum_of = [](const auto& value, int middle) {
    return value(std::max(0, middle - 1)) + value(middle) + value(std::min(kSide_px - 1, middle + 1));
  };
  for (int v = 0; v < kSide_px; ++v) {
    const float* row = residuals.data() + v * kSide_px;
    for (int u = 0; u < kSide_px; ++u) {
      rows[static_cast<std::size_t>(v * kSide_px + u)] = sum_of([&](int k) { return row[k] * row[k]; }, u);
    }
  }
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) {
      const auto above = [&](int k) { return rows[static_cast<std::size_t>(k * kSide_px + u)]; };
      out[static_cast<std::size_t>(v * kSide_px + u)] = sum_of(above, v) / 9.0F;
    }
  }
  return out;
}

class LeftSquare {
 public:
  LeftSquare(ImageView<const std::uint8_t> left, int u, int v) : weight_(weights_about_middle()) {
    std::size_t k = 0;
    for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
      const std::uint8_t* row = left.row(v + dv) + u;
      for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du, ++k) {
        value_[k] = static_cast<float>(row[du]);
        slope_[k] = 0.5F * static_cast<float>(row[du + 1] - row[du - 1]);
        slopes_ += slope_[k] * slope_[k];
      }
    }
    factorise();
  }
  bool is_determined() const { return slopes_ > kMinSlopes; }

  // Pixels that the last step's shift left unlike count less, by Geman and McClure's weights.
  void reweigh() {
    const Square squares = mean_squares(residual_);
    Square sorted = squares;
    const auto middle = sorted.begin() + kPixels / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    constexpr float kOfMedian = 1.4826F * 1.4826F;
    const float limit = kUnlike * kUnlike * std::max(kMinSigma * kMinSigma, kOfMedian * *middle);
    for (std::size_t k = 0; k < kPixels; ++k) {
      const float like = limit / (limit + squares[k]);
      weight_[k] = weights_about_middle()[k] * like * like;
    }
    factorise();
  }

  // Correction of the shift; empty where the square extends beyond the image.
  std::optional<Shift> step(ImageView<const std::uint8_t> right, int v, double column, const Shift& shift) {
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
        residual_[k] = value_[k] - (at + (place - static_cast<float>(whole)) * (after - at)) - shift[0];
        const float off = weight_[k] * residual_[k];
        sum += off;
        sloped += slope_[k] * off;
        sloped_x += slope_[k] * x * off;
      }
      g += Shift(sum, sloped, sloped_x, y * sloped);
    }
    return solver_.solve(g);
  }

 private:
  void factorise() {
    Eigen::Matrix4f H = Eigen::Matrix4f::Zero();
    std::size_t k = 0;
    for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
      for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du, ++k) {
        const Shift J(1.0F, slope_[k], slope_[k] * static_cast<float>(du), slope_[k] * static_cast<float>(dv));
        H.noalias() += weight_[k] * J * J.transpose();
      }
    }
    solver_.compute(H);
  }

  Square value_, slope_, weight_, residual_{};
  float slopes_ = 0.0F;
  Eigen::LDLT<Eigen::Matrix4f> solver_;
};

}  // namespace

std::optional<Shift> square_shift(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v,
                                  double column) {
  constexpr int kRounds = 6, kSteps = 2;
  constexpr float kEnough_px = 0.005F, kMaxShift_px = 1.0F, kMaxStretch = 0.3F;
  LeftSquare square(left, u, v);
  if (!square.is_determined()) return std::nullopt;
  Shift shift = Shift::Zero();
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) square.reweigh();
    const float before = shift[1];
    for (int k = 0; k < kSteps; ++k) {
      const auto move = square.step(right, v, column, shift);
      if (!move) return std::nullopt;
      shift += *move;
      if (!(std::abs(shift[1]) < kMaxShift_px && shift.tail<2>().cwiseAbs().maxCoeff() < kMaxStretch)) {
        return std::nullopt;
      }
    }
    if (round > 0 && std::abs(shift[1] - before) < kEnough_px) break;
  }
  return shift;
}

}  // namespace pharos::slam
