// SPDX-License-Identifier: Apache-2.0
#include "host/stations/sweep_table.hpp"

#include "pharos/base/capacity.hpp"

namespace pharos::host {

using network::Generation;

SweepTable::SweepTable(const std::string& path)
    : table_(ByteSource(path), {"time_s", "station", "axis", "sensor", "theta_rad"}) {}

network::Hit SweepTable::hit() const {
  return {table_.number(0), static_cast<std::uint8_t>(table_.integer(3, 0, kMaxSensors - 1)), table_.number(4)};
}

Generation SweepTable::generation() const {
  const std::string_view axis = table_.text(2);
  if (axis == "x" || axis == "y") return Generation::kLighthouse1;
  if (axis == "a" || axis == "b") return Generation::kLighthouse2;
  table_.fail(2, "must be x or y (generation 1), a or b (generation 2)");
}

std::size_t SweepTable::plane() const {
  generation();
  const std::string_view axis = table_.text(2);
  return axis == "x" || axis == "a" ? 0 : 1;
}

void SweepTable::require(Generation wanted) const {
  if (generation() == wanted) return;
  table_.fail(2, wanted == Generation::kLighthouse2 ? "must be a or b: this station is of generation 2"
                                                    : "must be x or y: this station is of generation 1");
}

}  // namespace pharos::host
