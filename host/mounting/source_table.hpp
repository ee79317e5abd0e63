// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "host/mounting/mounting.hpp"

namespace pharos::host {

/// A pose of a source as its table states it.
struct SourceRow {
  double time_s = 0.0;  // on the source's clock
  std::optional<double>
      arrival_s;  // when it was there, on the vehicle's clock; column arrival_s of a simulated approach
  /// Without the turn, R is one of the rotations with this z axis.
  SensorFromFeature pose;
  /// Rotation (rad) before translation (m) of delta in the sensor frame. The 21 columns cov_... where the table has
  /// them; otherwise even in all directions, of the traces sigma_rot_deg, sigma_pos_mm. About the axis of a pose
  /// without turn it is zero, which is no knowledge.
  Matrix6 covariance = Matrix6::Zero();
  /// False: the rotation about the feature's z axis (R.col(2)) was not measured: ring2, tof without connector.
  bool has_turn = true;
  float time_sigma_s = 0.0F;                // of time_s, as the source states it; tables do not tell it
  std::optional<SensorFromFeature> second;  // of an ambiguous pose
  double delta_chi2 = 0.0;                  // of the second to the first
};

/// What is selected of a table.
struct SourceTableChoice {
  std::optional<int> station;     // lighthouse: rows of this station only
  std::optional<double> rate_hz;  // of tables whose rows count frames (tof) or pairs (ring2) and have no time
};

/// Poses of one source from the table that `pharos track`, `tof`, `circles` or `slam --format csv` prints, row by row;
/// columns are found by name, others are ignored; .gz; -.
///
/// Throws InputError naming file, line and column: a missing column, a number that is none, a quaternion whose length
/// differs from 1 by more than 1 %, a covariance that is none, several lighthouse stations and none chosen, no time.
class SourceTable {
 public:
  SourceTable(const std::string& path, SourceKind kind, const SourceTableChoice& choice = {});
  SourceTable(SourceTable&&) noexcept;
  SourceTable& operator=(SourceTable&&) noexcept;
  ~SourceTable();

  /// The next row with a pose; rows without one are counted and skipped.
  std::optional<SourceRow> next();
  std::size_t rows() const;
  std::size_t refused() const;
  std::size_t line_number() const;
  const std::string& name() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Names of the upper triangle of a full covariance by rows, 21 of the 36 columns that `--covariance` prints:
/// cov_rx_rx_rad2 ... cov_rx_tx_rad_m ... cov_tz_tz_m2.
const std::array<std::string, 21>& upper_covariance_columns();

}  // namespace pharos::host
