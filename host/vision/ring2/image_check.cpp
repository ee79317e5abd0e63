// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/image_check.hpp"

#include <array>
#include <cstddef>

namespace pharos::host {
namespace {

// Shares of the grey range. A sensor's own noise is some thousandths of it (6 electrons of 10,000), one count of eight
// bits four.
constexpr double kBlackBelow = 0.02;
constexpr double kLeastContrast = 0.02;
constexpr double kSaturatedShare = 0.5;
// So many of the pixels must reach a level for it to count: a few hot ones do not make light.
constexpr double kBrightShare = 0.001;

}  // namespace

const char* name_of(ImageFault fault) {
  switch (fault) {
    case ImageFault::kNone:
      return "none";
    case ImageFault::kBlack:
      return "black";
    case ImageFault::kSaturated:
      return "saturated";
    case ImageFault::kEven:
      return "even";
  }
  return "unknown";
}

ImageFault fault_of(ImageView<const std::uint16_t> image) {
  std::array<std::size_t, 256> histogram{};
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    const std::uint16_t* row = image.row(v);
    for (std::int32_t u = 0; u < image.width_px; ++u) ++histogram[row[u] >> 8];
  }
  const double pixels = static_cast<double>(image.pixels());
  if (static_cast<double>(histogram[255]) > kSaturatedShare * pixels) return ImageFault::kSaturated;
  const auto level_above = [&](double share) {
    double above = 0.0;
    for (std::size_t level = histogram.size(); level-- > 0;) {
      above += static_cast<double>(histogram[level]);
      if (above > share * pixels) return static_cast<double>(level) / 255.0;
    }
    return 0.0;
  };
  const double bright = level_above(kBrightShare);
  if (bright < kBlackBelow) return ImageFault::kBlack;
  return bright - level_above(1.0 - kBrightShare) < kLeastContrast ? ImageFault::kEven : ImageFault::kNone;
}

}  // namespace pharos::host
