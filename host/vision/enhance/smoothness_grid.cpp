// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/smoothness_grid.hpp"

#include <algorithm>
#include <array>

#include "host/vision/enhance/block_transform.hpp"
#include "host/vision/enhance/wide_vectors.hpp"

namespace pharos::enhance {
namespace {

using Index = std::ptrdiff_t;
using transform::Four;
using transform::load;
using transform::store;

// Smallest grid: there line sweeps in both directions suffice.
constexpr Index kCoarsest_px = 4;
// Two links lead from one group of 2 x 2 to the next, over twice the distance: 2 / 2 / 2.
constexpr float kCoarseLink = 0.5F;

// Rows that are treated together, because within a row each step depends on the value before.
constexpr Index kTogether = 8;

void resize(SmoothnessGrid& grid, Index width, Index height) {
  grid.width = width;
  grid.height = height;
  const auto size = static_cast<std::size_t>(width * height);
  for (auto* values :
       {&grid.mass, &grid.right, &grid.down, &grid.along_column, &grid.along_row, &grid.x, &grid.b, &grid.residual}) {
    values->resize(size);
  }
  grid.row.resize(static_cast<std::size_t>(width));
}

// The pivots of `rows` rows from v on, column by column: within a row each depends on the one before, by a division.
template <std::size_t rows>
void factor_rows(SmoothnessGrid& grid, Index v) {
  const Index width = grid.width;
  const float* right = grid.right.data() + v * width;
  const float* down = grid.down.data() + v * width;
  const float* mass = grid.mass.data() + v * width;
  float* inverse = grid.along_row.data() + v * width;
  std::array<float, rows> left{};
  for (Index u = 0; u < width; ++u) {
    for (std::size_t k = 0; k < rows; ++k) {
      const Index at = static_cast<Index>(k) * width + u;
      const float above = v > 0 || k > 0 ? down[at - width] : 0.0F;
      const float s = mass[at] + down[at] + above + left[k];
      inverse[at] = 1.0F / (s + right[at]);
      left[k] = right[at] * s * inverse[at];
    }
  }
}

// Pivots m = s + link of the tridiagonal systems, s = (links aside + mass) + link_before s_before / m_before: a sum of
// positive terms, so that a mass of 1 is not lost by rounding against links of 1e5.
PHAROS_WIDE_VECTORS void factor(SmoothnessGrid& grid) {
  const Index width = grid.width, height = grid.height;
  std::vector<float> before(static_cast<std::size_t>(width), 0.0F);
  for (Index v = 0; v < height; ++v) {
    const float* right = grid.right.data() + v * width;
    const float* down = grid.down.data() + v * width;
    const float* mass = grid.mass.data() + v * width;
    float* inverse = grid.along_column.data() + v * width;
    for (Index u = 0; u < width; ++u) {
      const float s = mass[u] + right[u] + (u > 0 ? right[u - 1] : 0.0F) + before[static_cast<std::size_t>(u)];
      const float m = s + down[u];
      inverse[u] = 1.0F / m;
      before[static_cast<std::size_t>(u)] = down[u] * s * inverse[u];
    }
  }
  Index v = 0;
  for (; v + kTogether <= height; v += kTogether) factor_rows<static_cast<std::size_t>(kTogether)>(grid, v);
  for (; v < height; ++v) factor_rows<1>(grid, v);
}

void coarsen(const SmoothnessGrid& fine, SmoothnessGrid& coarse) {
  resize(coarse, (fine.width + 1) / 2, (fine.height + 1) / 2);
  for (Index v = 0; v < coarse.height; ++v) {
    for (Index u = 0; u < coarse.width; ++u) {
      float mass = 0.0F, right = 0.0F, down = 0.0F;
      for (Index y = 2 * v; y < std::min(2 * v + 2, fine.height); ++y) {
        for (Index x = 2 * u; x < std::min(2 * u + 2, fine.width); ++x) {
          mass += fine.mass[static_cast<std::size_t>(y * fine.width + x)];
        }
        if (2 * u + 1 < fine.width) right += fine.right[static_cast<std::size_t>(y * fine.width + 2 * u + 1)];
      }
      if (2 * v + 1 < fine.height) {
        for (Index x = 2 * u; x < std::min(2 * u + 2, fine.width); ++x) {
          down += fine.down[static_cast<std::size_t>((2 * v + 1) * fine.width + x)];
        }
      }
      const auto at = static_cast<std::size_t>(v * coarse.width + u);
      coarse.mass[at] = mass;
      coarse.right[at] = kCoarseLink * right;
      coarse.down[at] = kCoarseLink * down;
    }
  }
}

// store(u, (A x)(u, v)) along row v, from the rows of x around it; at the border the row itself replaces the missing
// one.
template <class Store>
void apply_row(const SmoothnessGrid& grid, Index v, const float* above, const float* here, const float* below,
               Store&& store) {
  const Index width = grid.width;
  const float* right = grid.right.data() + v * width;
  const float* down = grid.down.data() + v * width;
  const float* mass = grid.mass.data() + v * width;
  const float* link_above = v > 0 ? down - width : down;
  const auto value = [&](Index u, float left, float next) {
    return mass[u] * here[u] + left + next + link_above[u] * (here[u] - above[u]) + down[u] * (here[u] - below[u]);
  };
  if (width == 1) {
    store(0, value(0, 0.0F, 0.0F));
    return;
  }
  store(0, value(0, 0.0F, right[0] * (here[0] - here[1])));
  for (Index u = 1; u + 1 < width; ++u) {
    store(u, value(u, right[u - 1] * (here[u] - here[u - 1]), right[u] * (here[u] - here[u + 1])));
  }
  store(width - 1, value(width - 1, right[width - 2] * (here[width - 1] - here[width - 2]), 0.0F));
}

// out = row v of b - A x; `above` is the row of x over it (row v itself at the upper border).
PHAROS_WIDE_VECTORS void residual_row(const SmoothnessGrid& grid, Index v, const float* above, float* out) {
  const float* here = grid.x.data() + v * grid.width;
  const float* below = v + 1 < grid.height ? here + grid.width : here;
  const float* b = grid.b.data() + v * grid.width;
  apply_row(grid, v, above, here, below, [out, b](Index u, float value) { out[u] = b[u] - value; });
}

const float* row_above(const SmoothnessGrid& grid, Index v) {
  return grid.x.data() + std::max<Index>(0, v - 1) * grid.width;
}

// Each column's tridiagonal system, one row farther down: `here` holds its right-hand side.
PHAROS_WIDE_VECTORS void eliminate_row(const SmoothnessGrid& grid, Index v, float* here) {
  const Index width = grid.width;
  const float* inverse = grid.along_column.data() + v * width;
  if (v == 0) {
    for (Index u = 0; u < width; ++u) here[u] *= inverse[u];
    return;
  }
  const float* before = here - width;
  const float* link = grid.down.data() + (v - 1) * width;
  for (Index u = 0; u < width; ++u) here[u] = (here[u] + link[u] * before[u]) * inverse[u];
}

// Back substitution, upwards; put(x, solution) along each row.
template <class Put>
void substitute_columns(SmoothnessGrid& grid, Put&& put) {
  const Index width = grid.width, height = grid.height;
  for (Index v = height - 1; v >= 0; --v) {
    float* here = grid.residual.data() + v * width;
    float* x = grid.x.data() + v * width;
    if (v + 1 < height) {
      const float* after = here + width;
      const float* link = grid.down.data() + v * width;
      const float* inverse = grid.along_column.data() + v * width;
      for (Index u = 0; u < width; ++u) here[u] += link[u] * inverse[u] * after[u];
    }
    for (Index u = 0; u < width; ++u) put(x[u], here[u]);
  }
}

// The tridiagonal system of row v: forward elimination, and back substitution into x.
void solve_row(SmoothnessGrid& grid, Index v) {
  const Index width = grid.width;
  float* y = grid.residual.data() + v * width;
  const float* link = grid.right.data() + v * width;
  const float* inverse = grid.along_row.data() + v * width;
  float* x = grid.x.data() + v * width;
  y[0] *= inverse[0];
  for (Index u = 1; u < width; ++u) y[u] = (y[u] + link[u - 1] * y[u - 1]) * inverse[u];
  float last = 0.0F;
  for (Index u = width - 1; u >= 0; --u) {
    last = y[u] + link[u] * inverse[u] * last;
    x[u] += last;
  }
}

// Four rows of four values from `at`, as columns.
struct Square {
  Four column[4];
  Square(const float* at, Index width)
      : column{load(at), load(at + width), load(at + 2 * width), load(at + 3 * width)} {
    turn();
  }
  void turn() { transform::turn(column[0], column[1], column[2], column[3]); }
  void store_at(float* at, Index width) {
    turn();
    for (Index k = 0; k < 4; ++k) store(column[k], at + k * width);
  }
};

// Four rows' tridiagonal systems, a column or a square of four columns at a time.
class FourRows {
 public:
  FourRows(SmoothnessGrid& grid, Index v)
      : width_(grid.width),
        y_(grid.residual.data() + v * width_),
        x_(grid.x.data() + v * width_),
        link_(grid.right.data() + v * width_),
        inverse_(grid.along_row.data() + v * width_) {}

  void begin_forth() {
    last_ = column(y_) * column(inverse_);
    put(last_, y_);
  }
  void forth(Index u) {
    last_ = (column(y_ + u) + column(link_ + u - 1) * last_) * column(inverse_ + u);
    put(last_, y_ + u);
  }
  void forth_by_four(Index u) {
    Square here(y_ + u, width_);
    const Square link(link_ + u - 1, width_), inverse(inverse_ + u, width_);
    for (std::size_t k = 0; k < 4; ++k) {
      last_ = (here.column[k] + link.column[k] * last_) * inverse.column[k];
      here.column[k] = last_;
    }
    here.store_at(y_ + u, width_);
  }
  void begin_back() { last_ = Four{}; }
  void back(Index u) {
    last_ = column(y_ + u) + column(link_ + u) * column(inverse_ + u) * last_;
    put(column(x_ + u) + last_, x_ + u);
  }
  void back_by_four(Index u) {
    const Square here(y_ + u, width_), link(link_ + u, width_), inverse(inverse_ + u, width_);
    Square sum(x_ + u, width_);
    for (std::size_t k = 4; k-- > 0;) {
      last_ = here.column[k] + link.column[k] * inverse.column[k] * last_;
      sum.column[k] += last_;
    }
    sum.store_at(x_ + u, width_);
  }

 private:
  Four column(const float* at) const { return Four{at[0], at[width_], at[2 * width_], at[3 * width_]}; }
  void put(const Four& values, float* at) const {
    for (Index k = 0; k < 4; ++k) at[k * width_] = values[k];
  }

  Index width_;
  float *y_, *x_;
  const float *link_, *inverse_;
  Four last_{};
};

// kTogether rows from v on.
void solve_rows(SmoothnessGrid& grid, Index v) {
  std::array<FourRows, 2> halves = {FourRows(grid, v), FourRows(grid, v + kTogether / 2)};
  const auto both = [&halves](auto&& step) {
    for (FourRows& half : halves) step(half);
  };
  const Index whole = 1 + (grid.width - 1) / 4 * 4;
  both([](FourRows& half) { half.begin_forth(); });
  for (Index u = 1; u < whole; u += 4) both([u](FourRows& half) { half.forth_by_four(u); });
  for (Index u = whole; u < grid.width; ++u) both([u](FourRows& half) { half.forth(u); });
  both([](FourRows& half) { half.begin_back(); });
  for (Index u = grid.width - 1; u >= whole; --u) both([u](FourRows& half) { half.back(u); });
  for (Index u = whole - 4; u >= 1; u -= 4) both([u](FourRows& half) { half.back_by_four(u); });
  both([](FourRows& half) { half.back(0); });
}

}  // namespace

PHAROS_WIDE_VECTORS void build_grids(const SmoothnessSystem& system, std::vector<SmoothnessGrid>& grids) {
  Index width = system.width_px, height = system.height_px;
  std::size_t levels = 1;
  while (std::max(width, height) > kCoarsest_px) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    ++levels;
  }
  grids.resize(levels);
  SmoothnessGrid& fine = grids.front();
  resize(fine, system.width_px, system.height_px);
  std::fill(fine.mass.begin(), fine.mass.end(), 1.0F);
  fine.right = system.right;
  fine.down = system.down;
  for (std::size_t k = 0; k < levels; ++k) {
    if (k > 0) coarsen(grids[k - 1], grids[k]);
    factor(grids[k]);
  }
}

PHAROS_WIDE_VECTORS void first_columns(SmoothnessGrid& grid) {
  for (Index v = 0; v < grid.height; ++v) {
    float* here = grid.residual.data() + v * grid.width;
    std::copy_n(grid.b.data() + v * grid.width, grid.width, here);
    eliminate_row(grid, v, here);
  }
  substitute_columns(grid, [](float& x, float solution) { x = solution; });
}

PHAROS_WIDE_VECTORS void sweep_columns(SmoothnessGrid& grid) {
  for (Index v = 0; v < grid.height; ++v) {
    float* here = grid.residual.data() + v * grid.width;
    residual_row(grid, v, row_above(grid, v), here);
    eliminate_row(grid, v, here);
  }
  substitute_columns(grid, [](float& x, float solution) { x += solution; });
}

// All rows are solved from the same x: the row above a group, which is already updated, is saved before.
PHAROS_WIDE_VECTORS void sweep_rows(SmoothnessGrid& grid) {
  const Index width = grid.width;
  for (Index v = 0; v < grid.height;) {
    const Index count = v + kTogether <= grid.height ? kTogether : 1;
    for (Index k = v; k < v + count; ++k) {
      const float* above = k == v && v > 0 ? grid.row.data() : row_above(grid, k);
      residual_row(grid, k, above, grid.residual.data() + k * width);
    }
    std::copy_n(grid.x.data() + (v + count - 1) * width, width, grid.row.data());
    if (count == kTogether) {
      solve_rows(grid, v);
    } else {
      solve_row(grid, v);
    }
    v += count;
  }
}

PHAROS_WIDE_VECTORS void restrict_to(SmoothnessGrid& fine, SmoothnessGrid& coarse) {
  std::fill(coarse.b.begin(), coarse.b.end(), 0.0F);
  float* from = fine.row.data();
  for (Index v = 0; v < fine.height; ++v) {
    residual_row(fine, v, row_above(fine, v), from);
    float* to = coarse.b.data() + v / 2 * coarse.width;
    for (Index u = 0; u + 1 < fine.width; u += 2) to[u / 2] += from[u] + from[u + 1];
    if (fine.width % 2 == 1) to[coarse.width - 1] += from[fine.width - 1];
  }
}

PHAROS_WIDE_VECTORS void prolong(const SmoothnessGrid& coarse, SmoothnessGrid& fine) {
  for (Index v = 0; v < fine.height; ++v) {
    const float* from = coarse.x.data() + v / 2 * coarse.width;
    float* to = fine.x.data() + v * fine.width;
    for (Index u = 0; u < fine.width / 2; ++u) {
      to[2 * u] += from[u];
      to[2 * u + 1] += from[u];
    }
    if (fine.width % 2 == 1) to[fine.width - 1] += from[coarse.width - 1];
  }
}

PHAROS_WIDE_VECTORS void apply(const SmoothnessGrid& grid, const float* x, float* out) {
  for (Index v = 0; v < grid.height; ++v) {
    const float* here = x + v * grid.width;
    const float* above = v > 0 ? here - grid.width : here;
    const float* below = v + 1 < grid.height ? here + grid.width : here;
    float* to = out + v * grid.width;
    apply_row(grid, v, above, here, below, [to](Index u, float value) { to[u] = value; });
  }
}

}  // namespace pharos::enhance
