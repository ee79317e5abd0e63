// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/sweep_selection.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::calibrate {
namespace {

constexpr std::size_t kMinSweeps = 20;  // of a piece that is judged
constexpr double kJudged = 0.9, kPieceRatio = 2.5;

double quantile(std::vector<double> values, double part) {
  auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median_of(const std::vector<double>& values) { return quantile(values, 0.5); }

bool within(const network::PlaneSweep& sweep, const BodySpline& motion) {
  return std::all_of(sweep.hits.begin(), sweep.hits.end(),
                     [&](const network::Hit& hit) { return motion.holds(hit.time_s); });
}

network::PlaneSweep known_hits(const network::PlaneSweep& sweep, const Target& target) {
  network::PlaneSweep out = sweep;
  out.hits.clear();
  for (const network::Hit& hit : sweep.hits) {
    if (find_sensor(target, hit.sensor) != nullptr) out.hits.push_back(hit);
  }
  return out;
}

// At most one hit a sensor.
void keep_nearest(network::PlaneSweep& sweep, const SweepResiduals& residuals, double hit_gate_rad) {
  const double middle = median_of(residuals);
  network::PlaneSweep out = sweep;
  out.hits.clear();
  for (std::size_t i = 0; i < sweep.hits.size(); ++i) {
    const double apart = std::abs(residuals[i] - middle);
    bool nearest = apart <= hit_gate_rad;
    for (std::size_t j = 0; j < sweep.hits.size(); ++j) {
      if (j == i || sweep.hits[j].sensor != sweep.hits[i].sensor) continue;
      const double other = std::abs(residuals[j] - middle);
      nearest = nearest && (apart < other || (apart == other && i < j));
    }
    if (nearest) out.hits.push_back(sweep.hits[i]);
  }
  sweep = out;
}

}  // namespace

Selection select_sweeps(const std::vector<network::PlaneSweep>& sweeps, const StationUnknowns& unknowns,
                        const SelectionGates& gates) {
  Selection out;
  std::size_t piece = 0;
  for (const network::PlaneSweep& sweep : sweeps) {
    while (piece < unknowns.motion.size() && unknowns.motion[piece].end_s() < sweep.hits[0].time_s) ++piece;
    if (piece == unknowns.motion.size()) break;
    if (!within(sweep, unknowns.motion[piece])) continue;
    UsedSweep used{known_hits(sweep, unknowns.target), piece};
    if (used.sweep.hits.empty()) continue;
    out.hits += used.sweep.hits.size();
    const std::size_t before = used.sweep.hits.size();
    const SweepResiduals residuals = residuals_of(used.sweep, unknowns.motion[piece], unknowns);
    if (!(std::abs(median_of(residuals)) <= gates.sweep_rad)) {
      ++out.sweeps_left;
      continue;
    }
    keep_nearest(used.sweep, residuals, gates.hit_rad);
    out.hits_left += before - used.sweep.hits.size();
    if (!used.sweep.hits.empty()) out.sweeps.push_back(used);
  }
  return out;
}

std::size_t drop_pieces(const std::vector<network::PlaneSweep>& sweeps, StationUnknowns& unknowns,
                        const SelectionGates& gates) {
  std::vector<std::vector<double>> worst(unknowns.motion.size());
  for (const UsedSweep& used : select_sweeps(sweeps, unknowns, gates).sweeps) {
    double largest = 0.0;
    for (const double r : residuals_of(used.sweep, unknowns.motion[used.motion], unknowns)) {
      largest = std::max(largest, std::abs(r));
    }
    worst[used.motion].push_back(largest);
  }
  std::vector<double> of_piece, known;
  for (std::vector<double>& values : worst) {
    of_piece.push_back(values.size() < kMinSweeps ? -1.0 : quantile(values, kJudged));
    if (of_piece.back() >= 0.0) known.push_back(of_piece.back());
  }
  const double limit_rad = known.empty() ? 0.0 : kPieceRatio * quantile(known, 0.5);
  std::vector<BodySpline> kept;
  for (std::size_t i = 0; i < of_piece.size(); ++i) {
    if (of_piece[i] >= 0.0 && of_piece[i] <= limit_rad) kept.push_back(unknowns.motion[i]);
  }
  const std::size_t dropped = unknowns.motion.size() - kept.size();
  unknowns.motion = std::move(kept);
  return dropped;
}

}  // namespace pharos::calibrate
