// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/table/row_writer.hpp"
#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Counts of one kind's trials.
class IntegrityCounts {
 public:
  void add(std::uint64_t seed, const IntegrityTrial& trial);
  /// Answered, refused, ambiguous, failures with their first seeds, availability, error over sigma.
  std::vector<ComparisonRow> rows(const IntegrityKind& kind) const;

 private:
  struct Ratio {
    std::string quantity;
    double squares = 0.0;
    double median_error() const;
    std::vector<double> errors;
  };

  int trials_ = 0, ok_ = 0, ambiguous_ = 0;
  int answerable_ = 0, answerable_ok_ = 0;
  std::vector<std::uint64_t> failures_;
  std::vector<Ratio> ratios_;
};

/// Seeds `first` to `first + count - 1` of one kind. `rows`: one row a quantity of every trial, where wanted;
/// `after_each` is called after every trial.
IntegrityCounts run_integrity(const IntegrityKind& kind, std::uint64_t first, int count, host::RowWriter* rows,
                              const std::function<void()>& after_each);
/// Columns of these rows.
std::vector<std::string> trial_columns();

}  // namespace pharos::tools
