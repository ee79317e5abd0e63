// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/lower_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pharos::convert {
namespace {

constexpr double kBin_s = 0.2;
constexpr std::ptrdiff_t kNeighbours = 3;
constexpr double kQuantile = 0.2;

struct Bin {
  double begin_s = 0.0;
  double level = 0.0;
  std::size_t first = 0, last = 0;  // of the values, last excluded
};

double low_quantile(std::vector<double> values) {
  const auto rank = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

std::vector<double> lower_envelope(const std::vector<double>& times_s, const std::vector<double>& values) {
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double begin_s = std::floor(times_s[i] / kBin_s) * kBin_s;
    if (bins.empty() || begin_s > bins.back().begin_s + 0.5 * kBin_s) bins.push_back({begin_s, 0.0, i, i});
    bins.back().last = i + 1;
  }
  for (Bin& bin : bins) {
    bin.level = low_quantile({values.begin() + static_cast<std::ptrdiff_t>(bin.first),
                              values.begin() + static_cast<std::ptrdiff_t>(bin.last)});
  }
  std::vector<double> envelope(values.size());
  const auto count = static_cast<std::ptrdiff_t>(bins.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Bin& here = bins[static_cast<std::size_t>(i)];
    double least = here.level;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - kNeighbours); j < std::min(count, i + kNeighbours + 1);
         ++j) {
      const Bin& other = bins[static_cast<std::size_t>(j)];
      if (std::abs(other.begin_s - here.begin_s) < (kNeighbours + 0.5) * kBin_s) least = std::min(least, other.level);
    }
    std::fill(envelope.begin() + static_cast<std::ptrdiff_t>(here.first),
              envelope.begin() + static_cast<std::ptrdiff_t>(here.last), least);
  }
  return envelope;
}

}  // namespace pharos::convert
