// SPDX-License-Identifier: Apache-2.0
#include "tools/support/residual_table.hpp"

#include "pharos/base/units.hpp"

namespace pharos::tools {

void ResidualTable::push(std::uint8_t station, const track::TrackedBearing& bearing) {
  if (station >= kMaxStations || bearing.raw.sensor >= kMaxSensors) return;
  Cell& cell = cells_[station][static_cast<std::size_t>(index_of(bearing.axis))][bearing.raw.sensor];
  if (bearing.used) {
    cell.used.push(bearing.residual_rad);
  } else {
    ++cell.left_out;
  }
}

void ResidualTable::write(const OutputOptions& options) const {
  Output output(options, {"station", "axis", "sensor", "used", "left_out", "mean_arcsec", "sd_arcsec", "rms_arcsec"});
  host::RowWriter& rows = output.rows();
  for (std::size_t station = 0; station < kMaxStations; ++station) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const char letter = name_of(axis);
      for (std::size_t sensor = 0; sensor < kMaxSensors; ++sensor) {
        const Cell& cell = cells_[station][static_cast<std::size_t>(index_of(axis))][sensor];
        if (cell.used.count() == 0 && cell.left_out == 0) continue;
        rows.integer(static_cast<std::int64_t>(station)).text({&letter, 1});
        rows.integer(static_cast<std::int64_t>(sensor)).integer(cell.used.count()).integer(cell.left_out);
        if (cell.used.count() == 0) {
          rows.none(3);
        } else {
          const std::optional<double> deviation = cell.used.deviation();
          rows.number(cell.used.mean() * kArcsecPerRad);
          rows.number(deviation ? std::optional(*deviation * kArcsecPerRad) : std::nullopt);
          rows.number(cell.used.rms() * kArcsecPerRad);
        }
        rows.end_row();
      }
    }
  }
  output.finish();
}

}  // namespace pharos::tools
