// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/local_threshold.hpp"

#include <algorithm>

namespace pharos::tof {
namespace {

// (5): T = m - 0.2 s. Squared and turned round, so that whole numbers suffice: 1 / 0.2^2.
constexpr std::int64_t kInverseSquaredFactor = 25;

// Index of a mirrored border: the first pixel beyond is the second one inside. Images narrower than the window bounce
// more than once.
std::int32_t mirrored(std::int32_t index, std::int32_t size) {
  if (size == 1) return 0;
  const std::int32_t period = 2 * (size - 1);
  index = index % period;
  if (index < 0) index += period;
  return index < size ? index : period - index;
}

void add_row(ColumnSums* columns, const std::uint16_t* row, std::int32_t width, std::int64_t sign) {
  for (std::int32_t u = 0; u < width; ++u) {
    const std::int64_t value = row[u];
    columns[u].count += value != 0 ? static_cast<std::int32_t>(sign) : 0;
    columns[u].sum += sign * value;
    columns[u].squares += sign * value * value;
  }
}

void add(ColumnSums& window, const ColumnSums& column) {
  window.count += column.count;
  window.sum += column.sum;
  window.squares += column.squares;
}

void remove(ColumnSums& window, const ColumnSums& column) {
  window.count -= column.count;
  window.sum -= column.sum;
  window.squares -= column.squares;
}

// G > T. With n, S, Q the window's count, sum and sum of squares: n (G - m) = n G - S and n^2 s^2 = n Q - S^2.
bool grows(std::uint16_t grey, const ColumnSums& window, ThresholdForm form) {
  if (grey == 0) return false;
  const std::int64_t over_mean = static_cast<std::int64_t>(window.count) * grey - window.sum;
  if (over_mean > 0) return true;
  const std::int64_t spread = window.count * window.squares - window.sum * window.sum;
  if (form == ThresholdForm::kPixelCount) return kInverseSquaredFactor * over_mean * over_mean < spread;
  // As printed: s^2 = (spread / n) / (S / n) = spread / S.
  const double n = window.count;
  return static_cast<double>(kInverseSquaredFactor) * static_cast<double>(over_mean) * static_cast<double>(over_mean) *
             static_cast<double>(window.sum) <
         n * n * static_cast<double>(spread);
}

}  // namespace

void local_threshold(ImageView<const std::uint16_t> grey, std::int32_t half_window_px, ThresholdForm form,
                     ThresholdWorkspace& workspace, BitImage& above) {
  above.reset(grey.width_px, grey.height_px);
  const std::int32_t w = std::clamp<std::int32_t>(half_window_px, 1, kMostHalfWindow_px);
  ColumnSums* columns = workspace.columns.data();
  std::fill_n(columns, grey.width_px, ColumnSums{});
  for (std::int32_t k = -w; k <= w; ++k) add_row(columns, grey.row(mirrored(k, grey.height_px)), grey.width_px, 1);
  for (std::int32_t v = 0; v < grey.height_px; ++v) {
    const std::uint16_t* row = grey.row(v);
    ColumnSums window;
    for (std::int32_t k = -w; k <= w; ++k) add(window, columns[mirrored(k, grey.width_px)]);
    for (std::int32_t u = 0; u < grey.width_px; ++u) {
      if (grows(row[u], window, form)) above.set(u, v);
      const bool inside = u >= w && u + w + 1 < grey.width_px;
      remove(window, columns[inside ? u - w : mirrored(u - w, grey.width_px)]);
      add(window, columns[inside ? u + w + 1 : mirrored(u + w + 1, grey.width_px)]);
    }
    add_row(columns, grey.row(mirrored(v - w, grey.height_px)), grey.width_px, -1);
    add_row(columns, grey.row(mirrored(v + w + 1, grey.height_px)), grey.width_px, 1);
  }
}

}  // namespace pharos::tof
