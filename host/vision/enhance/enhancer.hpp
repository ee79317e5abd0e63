// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "host/vision/enhance/bm3d.hpp"
#include "host/vision/enhance/float_image.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::enhance {

/// The weights W of (4): 1 everywhere (I), 1 / |gradient of the start| (II), or (6), gradients gathered in a window
/// (III).
enum class WeightStrategy { kUniform, kGradient, kWindow };

/// The denoiser from R to R_d: none (R_d = R), thresholds on single blocks (1 to 2 dB worse than BM3D), or BM3D.
enum class Denoiser { kNone, kFast, kBm3d };

struct EnhanceSettings {
  WeightStrategy strategy = WeightStrategy::kWindow;
  double alpha = 0.15;    ///< weight of smoothness in (4)
  double sigma_px = 2.0;  ///< of the Gaussian window in (6)
  double gamma = 0.8;     ///< exponent of (7)
  Denoiser denoiser = Denoiser::kBm3d;
  Bm3dSettings bm3d;  ///< kVideoBm3d for frames in a stream
  /// Standard deviation of the noise in the reflectance's luma, 1 = white; empty: estimated from each frame.
  std::optional<double> noise_sigma;
  /// Divide R by its peak() before it is denoised and recomposed; else values above white are clipped, as printed in
  /// the paper.
  bool fit_to_white = true;
  int threads = 2;  ///< the result is identical, bit by bit, for any number
};

/// Every step of one frame. L is the illumination after (7), the one that (3) and (8) use.
struct Enhanced {
  FloatImage start;          ///< max-RGB (2); one plane
  FloatImage refined;        ///< solution of (5); one plane
  FloatImage illumination;   ///< L = refined^gamma (7); one plane
  FloatImage reflectance;    ///< R = S / (L + eps) (3), unbounded; planes as the frame's
  float peak = 1.0F;         ///< with fit_to_white: the 99.5th percentile of R's lit pixels, 1 at least
  FloatImage denoised;       ///< R_d: R / peak within 0 ... 1, its luma denoised
  FloatImage result;         ///< (R / peak) L + R_d (1 - L) (8), R / peak within 0 ... 1
  double noise_sigma = 0.0;  ///< used for R_d; 0 without a denoiser
  int iterations = 0;        ///< of the solver of (5)
};

/// Low-light enhancement of single frames or of a video, after paper 004, section 1 (LIME, with BM3D).
///
/// Keeps its buffers, and the illumination of a frame as the start value for the next: one Enhancer a camera. Frames
/// may change size; the next one is then computed without a start value. Cost of denoising: see BlockDenoiser. Not
/// thread-safe; different Enhancers may be used in parallel.
class Enhancer {
 public:
  explicit Enhancer(const EnhanceSettings& settings = {});
  Enhancer(Enhancer&&) noexcept;
  Enhancer& operator=(Enhancer&&) noexcept;
  ~Enhancer();

  /// All steps of a grey frame; valid until the next call. Empty for an empty view.
  const Enhanced& enhance(ImageView<const std::uint8_t> frame);
  const Enhanced& enhance(ImageView<const std::uint16_t> frame);
  /// The same of one or three planes, 0 ... 1.
  const Enhanced& enhance(const FloatImage& frame);

  /// The first half only: start, refined, illumination and iterations.
  const Enhanced& illuminate(const FloatImage& frame);

  /// The next frame is computed without a start value: after a cut, or where frames must not depend on those before.
  void forget();

  const EnhanceSettings& settings() const { return settings_; }

 private:
  struct Buffers;
  EnhanceSettings settings_;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace pharos::enhance
