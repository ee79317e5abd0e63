// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pharos::tools {

/// One line of the benchmark: the same task solved by our code and by a peer in the same run.
struct BenchRow {
  std::string what;
  double ours = 0.0;
  std::optional<double> peer;
  std::string unit;
  bool less_is_better = true;

  /// Ratio by which ours is better; empty without a peer or where one of the two is zero.
  std::optional<double> ratio() const;
};

enum class BenchForm { kPretty, kCsv, kJson };

/// `what,ours,peer,ratio,unit` on standard output; pretty: the same in aligned columns of rounded numbers.
void write_rows(const std::vector<BenchRow>& rows, BenchForm form);

}  // namespace pharos::tools
