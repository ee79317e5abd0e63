// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"

namespace pharos::tools {

// Rows of `pharos decode` for Lighthouse 2.0.
const std::vector<std::string>& lh2_hit_columns();
const std::vector<std::string>& lh2_ootx_columns();

/// One row: the payload and, where they can be read, its fields.
void write_lh2_payload(const lighthouse::OotxPayload& payload, host::RowWriter& rows);

/// Hits of several stations in the order of time: sweeps come complete, up to some milliseconds after another
/// station's.
class Lh2HitRows {
 public:
  explicit Lh2HitRows(host::RowWriter& rows) : rows_(rows) {}

  /// The id of a channel's station, for its rows from now on.
  void name_station(const lighthouse::OotxPayload& payload);
  void push(const lighthouse::Lh2Sweep& sweep);
  void flush();

 private:
  struct Row {
    double time_s = 0.0;
    double theta_rad = 0.0;
    double sync_s = 0.0;
    double offset_bits = 0.0;
    std::uint8_t channel = 0;
    std::uint8_t plane = 0;
    std::uint8_t sensor = 0;
    std::uint16_t width_ticks = 0;
    bool slow_bit = false;
    bool several = false;

    bool operator<(const Row& other) const { return time_s < other.time_s; }
  };

  void write(const Row& row);

  host::RowWriter& rows_;
  std::multiset<Row> waiting_;
  std::array<std::optional<std::uint32_t>, lighthouse::kLh2Channels> id_;
};

}  // namespace pharos::tools
