// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/table/table_reader.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::host {

/// Rows of a sweeps.csv: time_s, station, axis (x and y of LH1, a and b of LH2), sensor, theta_rad. Every error is an
/// InputError that names file, line and column.
class SweepTable {
 public:
  explicit SweepTable(const std::string& path);

  bool next() { return table_.next(); }
  const std::string& name() const { return table_.name(); }
  std::uint8_t station() const { return static_cast<std::uint8_t>(table_.integer(1, 0, 255)); }
  network::Hit hit() const;
  /// By the axis.
  network::Generation generation() const;
  std::size_t plane() const;
  /// Throws where the axis is not one of this generation.
  void require(network::Generation generation) const;

 private:
  TableReader table_;
};

}  // namespace pharos::host
