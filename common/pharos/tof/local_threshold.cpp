// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/local_threshold.hpp"

#include <algorithm>

namespace pharos::tof {
namespace {

// (5): T = m - 0.2 s. Squared and rearranged, so that integers suffice: 1 / 0.2^2.
constexpr std::int64_t kInverseSquaredFactor = 25;

constexpr std::array<std::uint16_t, static_cast<std::size_t>(kMaxWidth_px)> kNothing{};  // a row without pixels

// Index of a mirrored border: the first pixel beyond is the second one inside. In images narrower than the window it is
// mirrored more than once.
std::int32_t mirrored(std::int32_t index, std::int32_t size) {
  if (size == 1) return 0;
  const std::int32_t period = 2 * (size - 1);
  index = index % period;
  if (index < 0) index += period;
  return index < size ? index : period - index;
}

// Sums of a window's columns.
struct Window {
  std::int32_t count = 0;
  std::int32_t sum = 0;
  std::int64_t squares = 0;

  void add(const ColumnSums& columns, std::int32_t u) {
    const auto k = static_cast<std::size_t>(u);
    count += columns.count[k];
    sum += columns.sum[k];
    squares += columns.squares[k];
  }
  void remove(const ColumnSums& columns, std::int32_t u) {
    const auto k = static_cast<std::size_t>(u);
    count -= columns.count[k];
    sum -= columns.sum[k];
    squares -= columns.squares[k];
  }
};

// The columns' windows, a row farther down.
void move_down(const std::uint16_t* leaves, const std::uint16_t* enters, std::int32_t width, ColumnSums& columns) {
  for (std::int32_t u = 0; u < width; ++u) {
    const auto k = static_cast<std::size_t>(u);
    columns.count[k] += (enters[u] != 0 ? 1 : 0) - (leaves[u] != 0 ? 1 : 0);
    columns.sum[k] += enters[u] - leaves[u];
  }
  for (std::int32_t u = 0; u < width; ++u) {
    const std::uint32_t more = enters[u], less = leaves[u];
    columns.squares[static_cast<std::size_t>(u)] +=
        static_cast<std::int64_t>(more * more) - static_cast<std::int64_t>(less * less);
  }
}

// G > T. With n, S, Q the window's count, sum and sum of squares: n (G - m) = n G - S and n^2 s^2 = n Q - S^2.
bool grows(std::uint16_t grey, const Window& window, ThresholdForm form) {
  const std::int64_t over_mean = window.count * grey - window.sum;
  const std::int64_t spread = window.count * window.squares - static_cast<std::int64_t>(window.sum) * window.sum;
  bool near_mean = kInverseSquaredFactor * over_mean * over_mean < spread;
  if (form == ThresholdForm::kAsPrinted) {  // s^2 = (spread / n) / (S / n) = spread / S
    const double n = window.count;
    near_mean = static_cast<double>(kInverseSquaredFactor) * static_cast<double>(over_mean) *
                    static_cast<double>(over_mean) * static_cast<double>(window.sum) <
                n * n * static_cast<double>(spread);
  }
  // Without a branch: the result follows no pattern.
  return (static_cast<unsigned>(grey != 0) &
          (static_cast<unsigned>(over_mean > 0) | static_cast<unsigned>(near_mean))) != 0;
}

// One row of pixels, the window moving along it.
void mark_row(const std::uint16_t* row, std::int32_t v, std::int32_t width, std::int32_t w, ThresholdForm form,
              const ColumnSums& columns, BitImage& above) {
  Window window;
  for (std::int32_t k = -w; k <= w; ++k) window.add(columns, mirrored(k, width));
  std::uint64_t marked = 0;
  const auto mark = [&](std::int32_t u) {
    marked |= static_cast<std::uint64_t>(grows(row[u], window, form)) << (static_cast<unsigned>(u) & 63U);
    if ((u + 1) % 64 != 0 && u + 1 != width) return;
    above.put(u, v, marked);
    marked = 0;
  };
  const auto by_the_border = [&](std::int32_t u) {
    mark(u);
    window.remove(columns, mirrored(u - w, width));
    window.add(columns, mirrored(u + w + 1, width));
  };
  const std::int32_t last_inside = std::max(w, width - w - 1);
  std::int32_t u = 0;
  for (; u < std::min(w, width); ++u) by_the_border(u);
  for (; u < last_inside; ++u) {
    mark(u);
    window.remove(columns, u - w);
    window.add(columns, u + w + 1);
  }
  for (; u < width; ++u) by_the_border(u);
}

}  // namespace

void local_threshold(ImageView<const std::uint16_t> grey, std::int32_t half_window_px, ThresholdForm form,
                     ThresholdWorkspace& workspace, BitImage& above) {
  above.reset(grey.width_px, grey.height_px);
  const std::int32_t w = std::clamp<std::int32_t>(half_window_px, 1, kMaxHalfWindow_px);
  ColumnSums& columns = workspace.columns;
  columns = {};
  const auto row = [&](std::int32_t v) { return grey.row(mirrored(v, grey.height_px)); };
  for (std::int32_t k = -w; k <= w; ++k) move_down(kNothing.data(), row(k), grey.width_px, columns);
  for (std::int32_t v = 0; v < grey.height_px; ++v) {
    mark_row(grey.row(v), v, grey.width_px, w, form, columns, above);
    move_down(row(v - w), row(v + w + 1), grey.width_px, columns);
  }
}

}  // namespace pharos::tof
