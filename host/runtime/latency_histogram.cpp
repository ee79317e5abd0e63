// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::host {

void LatencyHistogram::add(std::int64_t duration_ns) {
  const double octaves = std::log2(static_cast<double>(std::max(duration_ns, kSmallest_ns)) / kSmallest_ns);
  const auto bin = static_cast<std::size_t>(std::ceil(octaves * kBinsPerOctave));
  ++bins_[std::min(bin, bins_.size() - 1)];
  ++count_;
  max_ns_ = std::max(max_ns_, duration_ns);
}

std::int64_t LatencyHistogram::quantile_ns(double q) const {
  const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen == 0 || seen < rank) continue;
    if (bin == bins_.size() - 1) return max_ns_;
    const double edge_ns = kSmallest_ns * std::exp2(static_cast<double>(bin) / kBinsPerOctave);
    return std::min(static_cast<std::int64_t>(std::ceil(edge_ns)), max_ns_);
  }
  return 0;
}

}  // namespace pharos::host
