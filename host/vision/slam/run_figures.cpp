// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/run_figures.hpp"

#include <algorithm>

namespace pharos::slam {
namespace {

constexpr std::size_t kMaxFigures = 4096;

void add(std::vector<float>& figures, double figure) {
  if (figures.size() == kMaxFigures) {
    figures.erase(figures.begin(), figures.begin() + static_cast<std::ptrdiff_t>(kMaxFigures / 2));
  }
  figures.push_back(static_cast<float>(figure));
}

double quantile(std::vector<float> values, double fraction) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

}  // namespace

void RunFigures::add_frame(const TrackedFrame& frame, const StereoFrontend::Result& seen, double took_ms) {
  ++counts_.frames;
  counts_.tracked += frame.placed ? 1 : 0;
  counts_.lost += frame.lost ? 1 : 0;
  counts_.ambiguous_place += frame.ambiguous_place ? 1 : 0;
  counts_.relocalised += frame.relocalised ? 1 : 0;
  counts_.repeated += seen.repeated ? 1 : 0;
  counts_.dark += seen.dark ? 1 : 0;
  counts_.saturated += seen.saturated ? 1 : 0;
  add(features_, frame.features);
  add(tracking_ms_, took_ms);
  if (frame.placed) add(inliers_, frame.inliers);
}

void RunFigures::add_mapping(double took_ms) { add(mapping_ms_, took_ms); }

void RunFigures::add_loop(double took_ms) {
  ++counts_.loops;
  counts_.loop_max_ms = std::max(counts_.loop_max_ms, took_ms);
}

SlamReport RunFigures::report() const {
  SlamReport out = counts_;
  out.features_median = quantile(features_, 0.5);
  out.inliers_median = quantile(inliers_, 0.5);
  out.tracking_median_ms = quantile(tracking_ms_, 0.5);
  out.tracking_p95_ms = quantile(tracking_ms_, 0.95);
  out.mapping_median_ms = quantile(mapping_ms_, 0.5);
  return out;
}

}  // namespace pharos::slam
