// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/smoothness_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::enhance {
namespace {

using Index = std::ptrdiff_t;

// Below it lines of both directions solve a grid by themselves.
constexpr Index kCoarsest_px = 4;
constexpr int kCoarsestRounds = 4;
// Two links lead from one group of 2 x 2 to the next, over twice the distance: 2 / 2 / 2.
constexpr float kCoarseLink = 0.5F;
// Coarse corrections in a cycle. With one the iterations grow by a half to twice on textured frames.
constexpr int kCorrections = 2;

void resize(SmoothnessGrid& grid, Index width, Index height) {
  grid.width = width;
  grid.height = height;
  const auto size = static_cast<std::size_t>(width * height);
  for (auto* values :
       {&grid.mass, &grid.right, &grid.down, &grid.along_column, &grid.along_row, &grid.x, &grid.b, &grid.residual}) {
    values->resize(size);
  }
}

// Pivots m = s + link of the tridiagonal systems, s = (links aside + mass) + link_before s_before / m_before: a sum of
// positive terms, so that a mass of 1 beside links of 1e5 is not lost.
void factor(SmoothnessGrid& grid) {
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
  for (Index v = 0; v < height; ++v) {
    const float* right = grid.right.data() + v * width;
    const float* down = grid.down.data() + v * width;
    const float* above = v > 0 ? down - width : nullptr;
    const float* mass = grid.mass.data() + v * width;
    float* inverse = grid.along_row.data() + v * width;
    float left = 0.0F;
    for (Index u = 0; u < width; ++u) {
      const float s = mass[u] + down[u] + (above != nullptr ? above[u] : 0.0F) + left;
      inverse[u] = 1.0F / (s + right[u]);
      left = right[u] * s * inverse[u];
    }
  }
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

// out = (mass + Laplacian) x, or b minus that.
template <class Store>
void apply(const SmoothnessGrid& grid, const float* x, Store&& store) {
  const Index width = grid.width, height = grid.height;
  for (Index v = 0; v < height; ++v) {
    const Index row = v * width;
    const float* right = grid.right.data() + row;
    const float* down = grid.down.data() + row;
    const float* mass = grid.mass.data() + row;
    const float* here = x + row;
    const float* above = v > 0 ? here - width : here;
    const float* below = v + 1 < height ? here + width : here;
    const float* link_above = v > 0 ? down - width : down;
    const auto value = [&](Index u, float left, float next) {
      return mass[u] * here[u] + left + next + link_above[u] * (here[u] - above[u]) + down[u] * (here[u] - below[u]);
    };
    if (width == 1) {
      store(row, value(0, 0.0F, 0.0F));
      continue;
    }
    store(row, value(0, 0.0F, right[0] * (here[0] - here[1])));
    for (Index u = 1; u + 1 < width; ++u) {
      store(row + u, value(u, right[u - 1] * (here[u] - here[u - 1]), right[u] * (here[u] - here[u + 1])));
    }
    store(row + width - 1, value(width - 1, right[width - 2] * (here[width - 1] - here[width - 2]), 0.0F));
  }
}

void residual(SmoothnessGrid& grid) {
  float* out = grid.residual.data();
  const float* b = grid.b.data();
  apply(grid, grid.x.data(), [out, b](Index at, float value) { out[at] = b[at] - value; });
}

// residual <- solution of each column's tridiagonal system; x += that
void columns(SmoothnessGrid& grid) {
  const Index width = grid.width, height = grid.height;
  float* y = grid.residual.data();
  for (Index u = 0; u < width; ++u) y[u] *= grid.along_column[static_cast<std::size_t>(u)];
  for (Index v = 1; v < height; ++v) {
    float* here = y + v * width;
    const float* before = here - width;
    const float* link = grid.down.data() + (v - 1) * width;
    const float* inverse = grid.along_column.data() + v * width;
    for (Index u = 0; u < width; ++u) here[u] = (here[u] + link[u] * before[u]) * inverse[u];
  }
  for (Index v = height - 1; v >= 0; --v) {
    float* here = y + v * width;
    float* x = grid.x.data() + v * width;
    if (v + 1 < height) {
      const float* after = here + width;
      const float* link = grid.down.data() + v * width;
      const float* inverse = grid.along_column.data() + v * width;
      for (Index u = 0; u < width; ++u) here[u] += link[u] * inverse[u] * after[u];
    }
    for (Index u = 0; u < width; ++u) x[u] += here[u];
  }
}

template <std::size_t kRows>
void rows_at(SmoothnessGrid& grid, Index v) {
  const Index width = grid.width;
  std::array<float, kRows> last{};
  float* y = grid.residual.data() + v * width;
  const float* link = grid.right.data() + v * width;
  const float* inverse = grid.along_row.data() + v * width;
  float* x = grid.x.data() + v * width;
  for (Index u = 0; u < width; ++u) {
    for (std::size_t k = 0; k < kRows; ++k) {
      const Index at = static_cast<Index>(k) * width + u;
      last[k] = (y[at] + (u > 0 ? link[at - 1] : 0.0F) * last[k]) * inverse[at];
      y[at] = last[k];
    }
  }
  last = {};
  for (Index u = width - 1; u >= 0; --u) {
    for (std::size_t k = 0; k < kRows; ++k) {
      const Index at = static_cast<Index>(k) * width + u;
      last[k] = y[at] + link[at] * inverse[at] * last[k];
      x[at] += last[k];
    }
  }
}

// The same along rows; several at a time, since each waits for its last value.
void rows(SmoothnessGrid& grid) {
  constexpr Index kTogether = 8;
  Index v = 0;
  for (; v + kTogether <= grid.height; v += kTogether) rows_at<kTogether>(grid, v);
  for (; v < grid.height; ++v) rows_at<1>(grid, v);
}

void restrict_to(const SmoothnessGrid& fine, SmoothnessGrid& coarse) {
  std::fill(coarse.b.begin(), coarse.b.end(), 0.0F);
  for (Index v = 0; v < fine.height; ++v) {
    const float* from = fine.residual.data() + v * fine.width;
    float* to = coarse.b.data() + v / 2 * coarse.width;
    for (Index u = 0; u + 1 < fine.width; u += 2) to[u / 2] += from[u] + from[u + 1];
    if (fine.width % 2 == 1) to[coarse.width - 1] += from[fine.width - 1];
  }
}

void prolong(const SmoothnessGrid& coarse, SmoothnessGrid& fine) {
  for (Index v = 0; v < fine.height; ++v) {
    const float* from = coarse.x.data() + v / 2 * coarse.width;
    float* to = fine.x.data() + v * fine.width;
    for (Index u = 0; u < fine.width; ++u) to[u] += from[u / 2];
  }
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  constexpr std::size_t kPiece = 1024;  // floats add up well over a thousand terms; doubles over the rest
  for (std::size_t k = 0; k < a.size(); k += kPiece) {
    std::array<float, 8> part{};
    const std::size_t end = std::min(a.size(), k + kPiece);
    std::size_t i = k;
    for (; i + 8 <= end; i += 8) {
      for (std::size_t lane = 0; lane < 8; ++lane) part[lane] += a[i + lane] * b[i + lane];
    }
    for (; i < end; ++i) part[0] += a[i] * b[i];
    for (const float value : part) sum += static_cast<double>(value);
  }
  return sum;
}

// How far the last few steps went, together. What is left is shorter by as much as the steps shrink; three of them
// leave room for the slowest frames seen, which shrink by a seventh a step.
class LastSteps {
 public:
  double length_with(double step) {
    steps_[count_++ % kKept] = step;
    double sum = 0.0;
    for (const double one : steps_) sum += one;
    return count_ < kKept ? kFewSteps * sum : sum;
  }

 private:
  static constexpr std::size_t kKept = 3;
  // Before there are so many, only a start that is good five times over is believed.
  static constexpr double kFewSteps = 5.0;
  std::array<double, kKept> steps_{};
  std::size_t count_ = 0;
};

}  // namespace

void SmoothnessSolver::build(const SmoothnessSystem& system) {
  Index width = system.width_px, height = system.height_px;
  std::size_t levels = 1;
  while (std::max(width, height) > kCoarsest_px) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    ++levels;
  }
  grids_.resize(levels);
  SmoothnessGrid& fine = grids_.front();
  resize(fine, system.width_px, system.height_px);
  std::fill(fine.mass.begin(), fine.mass.end(), 1.0F);
  fine.right = system.right;
  fine.down = system.down;
  for (std::size_t k = 0; k < levels; ++k) {
    if (k > 0) coarsen(grids_[k - 1], grids_[k]);
    factor(grids_[k]);
  }
}

void SmoothnessSolver::cycle(std::size_t level) {
  SmoothnessGrid& grid = grids_[level];
  std::fill(grid.x.begin(), grid.x.end(), 0.0F);
  grid.residual = grid.b;
  const bool coarsest = level + 1 == grids_.size();
  const int rounds = coarsest ? kCoarsestRounds : 1;
  for (int k = 0; k < rounds; ++k) {
    if (k > 0) residual(grid);
    columns(grid);
    residual(grid);
    rows(grid);
  }
  for (int k = 0; !coarsest && k < kCorrections; ++k) {
    residual(grid);
    restrict_to(grid, grids_[level + 1]);
    cycle(level + 1);
    prolong(grids_[level + 1], grid);
  }
  for (int k = 0; k < rounds; ++k) {  // in the opposite order, so that the cycle is symmetric
    residual(grid);
    rows(grid);
    residual(grid);
    columns(grid);
  }
}

int SmoothnessSolver::solve(const SmoothnessSystem& system, const FloatImage& start, double tolerance,
                            int most_iterations, FloatImage& refined) {
  build(system);
  SmoothnessGrid& fine = grids_.front();
  if (refined.width_px != start.width_px || refined.height_px != start.height_px || refined.channels != 1) {
    refined = start;
  }
  const auto range = [&] {
    const auto [low, high] = std::minmax_element(refined.values.begin(), refined.values.end());
    return static_cast<double>(*high - *low);
  };
  const double pixels = static_cast<double>(start.pixels());
  std::vector<float>& r = fine.b;
  std::vector<float>& z = fine.x;
  apply(fine, refined.values.data(), [&](Index at, float value) {
    r[static_cast<std::size_t>(at)] = start.values[static_cast<std::size_t>(at)] - value;
  });
  direction_.resize(start.pixels());
  image_.resize(start.pixels());
  double before = 0.0;
  LastSteps steps;
  for (int k = 0; k < most_iterations; ++k) {
    cycle(0);
    const double now = dot(r, z);
    if (!(now > 0.0)) return k;  // solved to the last bit
    const float beta = k == 0 ? 0.0F : static_cast<float>(now / before);
    before = now;
    for (std::size_t i = 0; i < z.size(); ++i) direction_[i] = k == 0 ? z[i] : z[i] + beta * direction_[i];
    apply(fine, direction_.data(), [&](Index at, float value) { image_[static_cast<std::size_t>(at)] = value; });
    const double step = now / dot(direction_, image_);
    const auto length = static_cast<float>(step);
    for (std::size_t i = 0; i < z.size(); ++i) {
      refined.values[i] += length * direction_[i];
      r[i] -= length * image_[i];
    }
    const double moved = step * std::sqrt(dot(direction_, direction_) / pixels);
    if (steps.length_with(moved) <= tolerance * range()) return k + 1;
  }
  return most_iterations;
}

}  // namespace pharos::enhance
