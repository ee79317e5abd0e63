// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/campaign.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tools {
namespace {

// Maximum number of failures' seeds that are reported.
constexpr std::size_t kMaxToldSeeds = 12;

bool beyond(const Deviation& d) { return d.error > kIntegritySigmas * d.sigma && d.error > d.tolerance; }

std::string words_of(const std::vector<std::uint64_t>& seeds) {
  std::string text = seeds.empty() ? "" : "seeds";
  for (std::size_t i = 0; i < std::min(seeds.size(), kMaxToldSeeds); ++i) text += ' ' + std::to_string(seeds[i]);
  return seeds.size() > kMaxToldSeeds ? text + " ..." : text;
}

void write_trial(const IntegrityKind& kind, std::uint64_t seed, const IntegrityTrial& trial, host::RowWriter& rows) {
  const auto begin = [&] {
    rows.text(kind.name).text(std::to_string(seed)).integer(trial.answerable ? 1 : 0).text(trial.status);
  };
  if (trial.deviations.empty()) {
    begin();
    rows.none(4).end_row();
  }
  for (const Deviation& d : trial.deviations) {
    begin();
    rows.text(d.quantity).number(d.error).number(d.sigma).integer(trial.ok() && beyond(d) ? 1 : 0).end_row();
  }
  rows.flush();
}

}  // namespace

bool IntegrityTrial::failed() const { return ok() && std::any_of(deviations.begin(), deviations.end(), beyond); }

std::vector<std::string> trial_columns() {
  return {"kind", "seed", "answerable", "status", "quantity", "error", "sigma", "failure"};
}

double IntegrityCounts::Ratio::median_error() const {
  std::vector<double> sorted = errors;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void IntegrityCounts::add(std::uint64_t seed, const IntegrityTrial& trial) {
  ++trials_;
  ok_ += trial.ok() ? 1 : 0;
  ambiguous_ += trial.ambiguous() ? 1 : 0;
  answerable_ += trial.answerable ? 1 : 0;
  answerable_ok_ += trial.answerable && trial.ok() ? 1 : 0;
  if (trial.failed()) failures_.push_back(seed);
  if (!trial.ok()) return;
  for (const Deviation& d : trial.deviations) {
    auto ratio = std::find_if(ratios_.begin(), ratios_.end(), [&](const Ratio& r) { return r.quantity == d.quantity; });
    if (ratio == ratios_.end()) ratio = ratios_.insert(ratios_.end(), Ratio{d.quantity, 0.0, {}});
    ratio->squares += d.error * d.error / (d.sigma * d.sigma);
    ratio->errors.push_back(d.error);
  }
}

std::vector<ComparisonRow> IntegrityCounts::rows(const IntegrityKind& kind) const {
  const std::string item = "integrity " + kind.name;
  const int refused = trials_ - ok_ - ambiguous_;
  std::vector<ComparisonRow> rows = {
      {item, "trials", "", "4000", static_cast<double>(trials_), "a seed a body", {}},
      {item, "answered", "", "", static_cast<double>(ok_), "status ok", {}},
      {item, "ambiguous", "", "", static_cast<double>(ambiguous_), "", {}},
      {item, "refused", "", "", static_cast<double>(refused), "", {}},
      {item, "failures", "", "0", static_cast<double>(failures_.size()), words_of(failures_), {}}};
  if (answerable_ > 0) {
    rows.push_back({item,
                    "availability",
                    "%",
                    ">= 90",
                    100.0 * answerable_ok_ / answerable_,
                    std::to_string(answerable_) + " where " + kind.rule,
                    {}});
  }
  for (const Ratio& ratio : ratios_) {
    const double mean = ratio.squares / static_cast<double>(ratio.errors.size());
    rows.push_back({item, ratio.quantity + ": median error", "", "", ratio.median_error(), "", {}});
    rows.push_back({item, ratio.quantity + ": error over sigma, RMS", "", "0.5 to 1.5", std::sqrt(mean), "", {}});
  }
  return rows;
}

IntegrityCounts run_integrity(const IntegrityKind& kind, std::uint64_t first, int count, host::RowWriter* rows,
                              const std::function<void()>& after_each) {
  IntegrityCounts counts;
  for (int k = 0; k < count; ++k) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
    const IntegrityTrial trial = kind.trial(seed);
    counts.add(seed, trial);
    if (rows != nullptr) write_trial(kind, seed, trial, *rows);
    after_each();
  }
  return counts;
}

}  // namespace pharos::tools
