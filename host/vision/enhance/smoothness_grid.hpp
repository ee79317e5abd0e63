// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "host/vision/enhance/smoothness.hpp"

namespace pharos::enhance {

/// One grid of the hierarchy: A x = b with (A x)(p) = mass(p) x(p) + sum of link(p, q) (x(p) - x(q)).
struct SmoothnessGrid {
  std::ptrdiff_t width = 0, height = 0;
  std::vector<float> mass, right, down;
  std::vector<float> along_column, along_row;  ///< inverse pivots of the tridiagonal systems of each column and row
  std::vector<float> x, b;
  std::vector<float> residual;  ///< buffer of the sweeps
  std::vector<float> row;       ///< one more row of it
};

/// The whole hierarchy of (5): 2x2 pixels to one from grid to grid, each factored along rows and columns.
void build_grids(const SmoothnessSystem& system, std::vector<SmoothnessGrid>& grids);

/// x = M^-1 b, M the tridiagonal systems of all columns: the sweep from x = 0.
void first_columns(SmoothnessGrid& grid);
/// x += M^-1 (b - A x), by columns and by rows.
void sweep_columns(SmoothnessGrid& grid);
void sweep_rows(SmoothnessGrid& grid);
/// coarse.b = restriction of fine's residual b - A x, four pixels to one.
void restrict_to(SmoothnessGrid& fine, SmoothnessGrid& coarse);
/// fine.x += coarse.x.
void prolong(const SmoothnessGrid& coarse, SmoothnessGrid& fine);
/// out = A x.
void apply(const SmoothnessGrid& grid, const float* x, float* out);

}  // namespace pharos::enhance
