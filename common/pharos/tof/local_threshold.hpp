// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/image_view.hpp"
#include "pharos/tof/bit_image.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::tof {

/// Sums of a window's rows, one a column.
struct ColumnSums {
  template <class Number>
  using PerColumn = std::array<Number, static_cast<std::size_t>(kMaxWidth_px)>;
  PerColumn<std::int32_t> count{};
  PerColumn<std::int32_t> sum{};
  PerColumn<std::int64_t> squares{};
};

struct ThresholdWorkspace {
  ColumnSums columns;
};

/// Largest half window: its sums stay within 32 bits, those of squares within 64, and no connector is larger.
inline constexpr std::int32_t kMaxHalfWindow_px = 24;

/// Marks pixels for region growing (paper 000, (5) and step 3): G > T, T = m - 0.2 s, over windows of (2 w + 1)^2
/// pixels with mirrored borders.
///
/// kPixelCount: s^2 is the mean squared deviation. kAsPrinted: s^2 is the sum of squared deviations over m. Pixels of
/// value 0 (no depth) are in no window and are never marked. Running sums: the cost does not depend on w, some 10 ns a
/// pixel; exact in integers.
void local_threshold(ImageView<const std::uint16_t> grey, std::int32_t half_window_px, ThresholdForm form,
                     ThresholdWorkspace& workspace, BitImage& above);

}  // namespace pharos::tof
