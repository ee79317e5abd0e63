// SPDX-License-Identifier: Apache-2.0
#include "tools/layout/layout_score.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "pharos/pose/precision.hpp"

namespace pharos::layout {
namespace {

constexpr double kUnmeasured = 100.0;

}  // namespace

double statistic(std::vector<double> values, const Objective& objective) {
  if (values.empty()) return 0.0;
  if (objective.kind == Objective::Kind::kMean) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  if (objective.kind == Objective::Kind::kWorst) return *std::max_element(values.begin(), values.end());
  const double rank = std::ceil(objective.percentile / 100.0 * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Dops dops_of(const Target& target, const std::vector<LighthouseFromBody>& poses, const Sight& sight) {
  Dops dops;
  dops.reserve(poses.size());
  for (const LighthouseFromBody& pose : poses) {
    const pose::SensorSet visible = pose::visible_sensors(target, pose, sight.incidence_rad);
    const auto precision = pose::precision_of(target, pose, visible, sight.rho);
    if (precision) {
      dops.push_back(Dop{precision->adop_deg_per_rad, precision->pdop_m_per_rad});
    } else {
      dops.push_back(std::nullopt);
    }
  }
  return dops;
}

Score score_of(const Dops& dops, const Objective& objective) {
  std::vector<double> adops;
  std::vector<double> pdops;
  for (const auto& dop : dops) {
    if (!dop) continue;
    adops.push_back(dop->adop_deg_per_rad);
    pdops.push_back(dop->pdop_m_per_rad);
  }
  const std::size_t measured = adops.size();
  return {statistic(std::move(adops), objective), statistic(std::move(pdops), objective), measured};
}

LayoutEvaluator::LayoutEvaluator(std::vector<LighthouseFromBody> poses, Sight sight, Objective objective,
                                 double attitude_weight, const Score& reference)
    : poses_(std::move(poses)),
      sight_(sight),
      objective_(objective),
      attitude_weight_(attitude_weight),
      reference_(reference) {}

double LayoutEvaluator::operator()(const Target& target) const {
  std::vector<double> adops;
  std::vector<double> pdops;
  for (const auto& dop : dops_of(target, poses_, sight_)) {
    adops.push_back(dop ? std::min(dop->adop_deg_per_rad / reference_.adop_deg_per_rad, kUnmeasured) : kUnmeasured);
    pdops.push_back(dop ? std::min(dop->pdop_m_per_rad / reference_.pdop_m_per_rad, kUnmeasured) : kUnmeasured);
  }
  return attitude_weight_ * statistic(std::move(adops), objective_) +
         (1.0 - attitude_weight_) * statistic(std::move(pdops), objective_);
}

}  // namespace pharos::layout
