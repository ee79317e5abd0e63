// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/enhancer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/vision/enhance/luma.hpp"
#include "host/vision/enhance/smoothness.hpp"
#include "host/vision/enhance/smoothness_solver.hpp"

namespace pharos::enhance {
namespace {

// The epsilon of (3): black stays black. Small compared with the darkest step of 16 bits after (7), 65535^-0.8 =
// 1.4e-4.
constexpr float kBlack = 1e-5F;
// Tolerance of the illumination, as a fraction of its range (RMS).
constexpr double kTolerance = 5e-3;
constexpr int kMaxIterations = 60;

void raise(const FloatImage& refined, double gamma, FloatImage& out) {
  out.shape(refined.width_px, refined.height_px, 1);
  const auto exponent = static_cast<float>(gamma);
  std::transform(refined.values.begin(), refined.values.end(), out.values.begin(),
                 [exponent](float value) { return std::pow(std::max(value, 0.0F), exponent); });
}

void divide(const FloatImage& frame, const FloatImage& illumination, FloatImage& reflectance) {
  reflectance.shape(frame.width_px, frame.height_px, frame.channels);
  const float* light = illumination.plane(0);
  for (int c = 0; c < frame.channels; ++c) {
    const float* from = frame.plane(c);
    float* to = reflectance.plane(c);
    for (std::size_t k = 0; k < frame.pixels(); ++k) to[k] = from[k] / (light[k] + kBlack);
  }
}

// In dark frames the illumination hardly follows the target's rim: the whole target may be above white. Computed from
// every fourth lit pixel.
float peak_of(const FloatImage& reflectance, std::vector<float>& lit) {
  lit.clear();
  for (std::size_t k = 0; k < reflectance.values.size(); k += 4) {
    if (reflectance.values[k] > 0.0F) lit.push_back(reflectance.values[k]);
  }
  if (lit.empty()) return 1.0F;
  const auto at = lit.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), at, lit.end());
  return std::max(1.0F, *at);
}

// (8)
void recompose(const FloatImage& reflectance, const FloatImage& illumination, const FloatImage& denoised, float peak,
               FloatImage& result) {
  result.shape(reflectance.width_px, reflectance.height_px, reflectance.channels);
  const float* light = illumination.plane(0);
  const float scale = 1.0F / peak;
  for (int c = 0; c < reflectance.channels; ++c) {
    const float* plain = reflectance.plane(c);
    const float* quiet = denoised.plane(c);
    float* to = result.plane(c);
    for (std::size_t k = 0; k < reflectance.pixels(); ++k) {
      to[k] = quiet[k] + (std::min(plain[k] * scale, 1.0F) - quiet[k]) * light[k];
    }
  }
}

}  // namespace

struct Enhancer::Buffers {
  FloatImage widened;
  std::vector<float> lit;
  Enhanced steps;
  SmoothnessWeights weights;
  SmoothnessSystem system;
  SmoothnessSolver solver;
  LumaDenoiser denoiser;
};

Enhancer::Enhancer(const EnhanceSettings& settings) : settings_(settings), buffers_(std::make_unique<Buffers>()) {}
Enhancer::Enhancer(Enhancer&&) noexcept = default;
Enhancer& Enhancer::operator=(Enhancer&&) noexcept = default;
Enhancer::~Enhancer() = default;

void Enhancer::forget() { buffers_->steps.refined = FloatImage(); }

const Enhanced& Enhancer::enhance(ImageView<const std::uint8_t> frame) {
  to_floats(frame, buffers_->widened);
  return enhance(buffers_->widened);
}

const Enhanced& Enhancer::enhance(ImageView<const std::uint16_t> frame) {
  to_floats(frame, buffers_->widened);
  return enhance(buffers_->widened);
}

const Enhanced& Enhancer::illuminate(const FloatImage& frame) {
  Buffers& b = *buffers_;
  Enhanced& steps = b.steps;
  max_of_channels(frame, steps.start);
  b.weights.weigh(steps.start, settings_.strategy, settings_.alpha, settings_.sigma_px, b.system);
  steps.iterations = b.solver.solve(b.system, steps.start, kTolerance, kMaxIterations, steps.refined);
  raise(steps.refined, settings_.gamma, steps.illumination);
  return steps;
}

const Enhanced& Enhancer::enhance(const FloatImage& frame) {
  Buffers& b = *buffers_;
  Enhanced& steps = b.steps;
  if (frame.pixels() == 0) {
    steps = Enhanced();
    return steps;
  }
  illuminate(frame);
  divide(frame, steps.illumination, steps.reflectance);
  steps.peak = settings_.fit_to_white ? peak_of(steps.reflectance, b.lit) : 1.0F;
  steps.noise_sigma = b.denoiser.denoise(steps.reflectance, steps.peak, settings_, steps.denoised);
  recompose(steps.reflectance, steps.illumination, steps.denoised, steps.peak, steps.result);
  return steps;
}

}  // namespace pharos::enhance
