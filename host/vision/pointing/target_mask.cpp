// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/target_mask.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr double kSaturatedValue = 65535.0 * 0.998;
constexpr double kMaxSaturated = 0.25;  // fraction of the target's pixels
constexpr double kStandsOut = 6.0;      // sigmas of the sky
constexpr double kBlack = 10.0;         // sigmas between the sky and the brightest thousandth of a percent
constexpr std::size_t kMinPixels = 40;  // of a target: a panel of 20 x 2
constexpr double kMinFraction = 0.05;   // of the largest piece: another panel, not a star
constexpr std::int32_t kMargin_px = 14;
constexpr int kBins = 256;
constexpr double kMadSigma = 1.4826;

struct Piece {
  std::size_t pixels = 0;
  std::int32_t left = 0, right = 0, top = 0, bottom = 0;
  double brightest = 0.0;
  double sum = 0.0;
};

// A run of pixels of one row above the level, and its component.
struct Run {
  std::int32_t row = 0, left = 0, right = 0;
  std::size_t piece = 0;
};

struct Pieces {
  std::vector<Piece> all;
  std::vector<Run> runs;
};

std::vector<Run> runs_above(ImageView<const std::uint16_t> image, double level) {
  const auto minimum = static_cast<std::int32_t>(std::floor(level)) + 1;
  std::vector<Run> runs;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    const std::uint16_t* row = image.row(v);
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      if (row[u] < minimum) continue;
      const std::int32_t left = u;
      while (u < image.width_px && row[u] >= minimum) ++u;
      runs.push_back({v, left, u - 1, runs.size()});
    }
  }
  return runs;
}

std::size_t root_of(std::vector<Run>& runs, std::size_t k) {
  while (runs[k].piece != k) k = runs[k].piece = runs[runs[k].piece].piece;
  return k;
}

// Each run's component becomes the first run that it is connected with (eight neighbours).
void join_runs(std::vector<Run>& runs) {
  std::size_t above = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    while (runs[above].row < runs[k].row - 1 ||
           (runs[above].row == runs[k].row - 1 && runs[above].right < runs[k].left - 1)) {
      ++above;
    }
    for (std::size_t i = above; runs[i].row == runs[k].row - 1 && runs[i].left <= runs[k].right + 1; ++i) {
      const std::size_t a = root_of(runs, i), b = root_of(runs, k);
      runs[std::max(a, b)].piece = std::min(a, b);
    }
  }
}

void add_run(Piece& piece, const Run& run, const std::uint16_t* row) {
  if (piece.pixels == 0) piece = {0, run.left, run.right, run.row, run.row, 0.0, 0.0};
  piece.pixels += static_cast<std::size_t>(run.right - run.left + 1);
  piece.left = std::min(piece.left, run.left);
  piece.right = std::max(piece.right, run.right);
  piece.bottom = run.row;
  for (std::int32_t u = run.left; u <= run.right; ++u) {
    piece.sum += row[u];
    piece.brightest = std::max<double>(piece.brightest, row[u]);
  }
}

// Connected components of the pixels above the level.
Pieces pieces_above(ImageView<const std::uint16_t> image, double level) {
  Pieces pieces{{}, runs_above(image, level)};
  std::vector<Run>& runs = pieces.runs;
  join_runs(runs);
  std::vector<std::size_t> number(runs.size());  // of a first run's component
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::size_t root = root_of(runs, k);
    if (root == k) {
      number[k] = pieces.all.size();
      pieces.all.emplace_back();
    }
    add_run(pieces.all[number[root]], runs[k], image.row(runs[k].row));
  }
  for (std::size_t k = runs.size(); k-- > 0;) runs[k].piece = number[root_of(runs, k)];
  return pieces;
}

// Median and scatter (by the median deviation) of the whole image, most of which is sky; from its histogram.
struct Sky {
  double median = 0.0, sigma = 0.0, brightest = 0.0;
};

std::size_t rank_in(const std::vector<std::uint32_t>& histogram, std::size_t rank) {
  std::size_t below = 0, value = 0;
  while (value + 1 < histogram.size() && below + histogram[value] <= rank) below += histogram[value++];
  return value;
}

Sky sky_of(ImageView<const std::uint16_t> image) {
  std::vector<std::uint32_t> histogram(65536);
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) ++histogram[image.at(u, v)];
  }
  const std::size_t median = rank_in(histogram, image.pixels() / 2);
  std::vector<std::uint32_t> deviations(65536);
  std::size_t step = 65536;  // between occurring values: 257 for 8 bits
  std::size_t last = 65536;
  for (std::size_t value = 0; value < histogram.size(); ++value) {
    if (histogram[value] == 0) continue;
    if (last != 65536) step = std::min(step, value - last);
    last = value;
    deviations[value > median ? value - median : median - value] += histogram[value];
  }
  const double spread = kMadSigma * static_cast<double>(rank_in(deviations, image.pixels() / 2));
  const double rounding = 0.3 * static_cast<double>(step == 65536 ? 1 : step);
  return {static_cast<double>(median), std::max(spread, rounding),
          static_cast<double>(rank_in(histogram, image.pixels() - 1 - image.pixels() / 100'000))};
}

// Histogram of square roots above the sky, in kBins steps up to the brightest.
double otsu_threshold(ImageView<const std::uint16_t> image, const Box& box, double sky, double brightest,
                      const std::vector<std::uint8_t>& stars) {
  std::vector<std::uint32_t> values(65536);
  std::size_t i = 0;
  for (std::int32_t v = box.top; v < box.top + box.height; ++v) {
    const std::uint16_t* row = image.row(v) + box.left;
    for (std::int32_t u = 0; u < box.width; ++u, ++i) values[row[u]] += stars[i] == 0 ? 1U : 0U;
  }
  const double scale = (kBins - 1) / std::sqrt(std::max(1.0, brightest - sky));
  std::vector<std::uint32_t> histogram(kBins);
  for (std::size_t value = 0; value < values.size(); ++value) {
    if (values[value] == 0) continue;
    const double root = scale * std::sqrt(std::max(0.0, static_cast<double>(value) - sky));
    histogram[static_cast<std::size_t>(std::min<double>(kBins - 1, root))] += values[value];
  }
  const double root = (otsu(histogram) + 1) / scale;
  return sky + root * root;
}

bool belongs(const Piece& piece, const Piece& main) {
  if (&piece == &main) return true;
  const std::int32_t reach = std::max(main.right - main.left, main.bottom - main.top) / 2;
  return static_cast<double>(piece.pixels) >= kMinFraction * static_cast<double>(main.pixels) &&
         piece.left <= main.right + reach && piece.right >= main.left - reach && piece.top <= main.bottom + reach &&
         piece.bottom >= main.top - reach;
}

Box box_around(const std::vector<Piece>& pieces, const Piece& main, ImageView<const std::uint16_t> image) {
  std::int32_t left = main.left, right = main.right, top = main.top, bottom = main.bottom;
  for (const Piece& piece : pieces) {
    if (!belongs(piece, main)) continue;
    left = std::min(left, piece.left);
    right = std::max(right, piece.right);
    top = std::min(top, piece.top);
    bottom = std::max(bottom, piece.bottom);
  }
  Box box;
  box.left = std::max(0, left - kMargin_px);
  box.top = std::max(0, top - kMargin_px);
  box.width = std::min(image.width_px, right + kMargin_px + 1) - box.left;
  box.height = std::min(image.height_px, bottom + kMargin_px + 1) - box.top;
  return box;
}

// Within the box: pixels of components that are not the target.
std::vector<std::uint8_t> stars_in(const Box& box, const Pieces& pieces, const Piece& main) {
  std::vector<std::uint8_t> stars(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (const Run& run : pieces.runs) {
    if (run.row < box.top || run.row >= box.top + box.height || belongs(pieces.all[run.piece], main)) continue;
    const std::int32_t left = std::max(run.left, box.left) - box.left;
    const std::int32_t right = std::min(run.right, box.left + box.width - 1) - box.left;
    const auto row = stars.begin() + static_cast<std::ptrdiff_t>(run.row - box.top) * box.width;
    if (left <= right) std::fill(row + left, row + right + 1, std::uint8_t{1});
  }
  return stars;
}

}  // namespace

int otsu(const std::vector<std::uint32_t>& histogram) {
  double total = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    total += histogram[i];
    moment += static_cast<double>(i) * histogram[i];
  }
  double below = 0.0, moment_below = 0.0, best = -1.0;
  int threshold = 0;
  for (std::size_t i = 0; i + 1 < histogram.size(); ++i) {
    below += histogram[i];
    moment_below += static_cast<double>(i) * histogram[i];
    const double above = total - below;
    if (below <= 0.0 || above <= 0.0) continue;
    const double apart = moment_below / below - (moment - moment_below) / above;
    const double between = below * above * apart * apart;
    if (between <= best) continue;
    best = between;
    threshold = static_cast<int>(i);
  }
  return threshold;
}

Result<TargetMask, PointingRefusal> find_target(ImageView<const std::uint16_t> image) {
  const Sky sky = sky_of(image);
  if (sky.median >= kSaturatedValue) return PointingRefusal::kSaturated;
  if (sky.brightest - sky.median < kBlack * sky.sigma) return PointingRefusal::kBlack;
  const Pieces pieces = pieces_above(image, sky.median + kStandsOut * sky.sigma);
  if (pieces.all.empty()) return PointingRefusal::kBlack;
  const Piece& main = *std::max_element(pieces.all.begin(), pieces.all.end(),
                                        [](const Piece& a, const Piece& b) { return a.pixels < b.pixels; });
  if (main.pixels < kMinPixels) return PointingRefusal::kStarsOnly;
  TargetMask target;
  target.sky = sky.median;
  target.noise = sky.sigma;
  target.box = box_around(pieces.all, main, image);
  const double mean = main.sum / static_cast<double>(main.pixels);
  double brightest = 0.0;
  for (const Piece& piece : pieces.all) {
    if (belongs(piece, main)) {
      brightest = std::max(brightest, piece.brightest);
    } else if (piece.brightest > mean) {
      target.has_brighter_star = true;
    }
  }
  const Box& box = target.box;
  const std::vector<std::uint8_t> stars = stars_in(box, pieces, main);
  target.threshold = otsu_threshold(image, box, sky.median, brightest, stars);
  target.mask.resize(stars.size());
  std::size_t i = 0, of_target = 0, saturated = 0;
  for (std::int32_t v = box.top; v < box.top + box.height; ++v) {
    const std::uint16_t* row = image.row(v) + box.left;
    for (std::int32_t u = 0; u < box.width; ++u, ++i) {
      const bool inside = stars[i] == 0 && row[u] > target.threshold;
      target.mask[i] = inside ? 1 : 0;
      of_target += inside ? 1U : 0U;
      saturated += inside && row[u] >= kSaturatedValue ? 1U : 0U;
    }
  }
  if (of_target < kMinPixels)
    return target.has_brighter_star ? PointingRefusal::kStarsBrighter : PointingRefusal::kStarsOnly;
  if (static_cast<double>(saturated) > kMaxSaturated * static_cast<double>(of_target))
    return PointingRefusal::kSaturated;
  return target;
}

}  // namespace pharos::pointing
