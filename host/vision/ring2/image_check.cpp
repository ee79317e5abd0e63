// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/image_check.hpp"

#include <array>
#include <cstddef>
#include <numeric>

namespace pharos::host {
namespace {

// Fractions of the grey range. A sensor's own noise is some thousandths of it (6 electrons of 10,000), one count of
// eight bits four.
constexpr double kBlackBelow = 0.02;
constexpr double kMinContrast = 0.02;
constexpr double kSaturatedFraction = 0.5;
// Fraction of the pixels that must reach a level, so that a few hot pixels do not count.
constexpr double kBrightFraction = 0.001;
// Only every n-th row is counted: some thousand pixels suffice to estimate a fraction.
constexpr std::int32_t kRowStep = 4;
// Neighbouring pixels mostly have the same grey value: counting them in one histogram would serialise the additions.
constexpr std::size_t kLanes = 4;

constexpr std::size_t kGreys = 256;

std::array<std::uint32_t, kGreys> histogram_of(ImageView<const std::uint16_t> image) {
  std::array<std::array<std::uint32_t, kGreys>, kLanes> lanes{};
  for (std::int32_t v = 0; v < image.height_px; v += kRowStep) {
    const std::uint16_t* row = image.row(v);
    for (std::int32_t u = 0; u < image.width_px; ++u) ++lanes[static_cast<std::size_t>(u) % kLanes][row[u] >> 8];
  }
  for (std::size_t lane = 1; lane < kLanes; ++lane) {
    for (std::size_t grey = 0; grey < kGreys; ++grey) lanes[0][grey] += lanes[lane][grey];
  }
  return lanes[0];
}

}  // namespace

const char* name_of(ImageDefect fault) {
  switch (fault) {
    case ImageDefect::kNone:
      return "none";
    case ImageDefect::kBlack:
      return "black";
    case ImageDefect::kSaturated:
      return "saturated";
    case ImageDefect::kEven:
      return "even";
  }
  return "unknown";
}

ImageDefect fault_of(ImageView<const std::uint16_t> image) {
  const std::array<std::uint32_t, kGreys> histogram = histogram_of(image);
  const double pixels = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  if (static_cast<double>(histogram[255]) > kSaturatedFraction * pixels) return ImageDefect::kSaturated;
  const auto level_above = [&](double fraction) {
    double above = 0.0;
    for (std::size_t level = histogram.size(); level-- > 0;) {
      above += static_cast<double>(histogram[level]);
      if (above > fraction * pixels) return static_cast<double>(level) / 255.0;
    }
    return 0.0;
  };
  const double bright = level_above(kBrightFraction);
  if (bright < kBlackBelow) return ImageDefect::kBlack;
  return bright - level_above(1.0 - kBrightFraction) < kMinContrast ? ImageDefect::kEven : ImageDefect::kNone;
}

}  // namespace pharos::host
