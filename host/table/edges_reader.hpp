// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/table/line_reader.hpp"
#include "host/table/tick_column.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::host {

/// A recording of light pulses: a table with the columns `sensor,rise_ticks,fall_ticks` (20 ns ticks, 32-bit or
/// unwrapped, see TickColumn; other columns are ignored). About 8 M rows/s from a plain file, 4 M from gzip.
///
/// A last line without a line end was cut off in writing: it is dropped and ended_unfinished() is true. Anything else
/// that is not a row of numbers is an InputError that names file, line and column. Values are not checked here: sensors
/// above 31 (those above 255 as 255), implausible lengths and times are left to the decoder, which counts them.
class EdgesReader {
 public:
  explicit EdgesReader(ByteSource source);

  std::optional<lighthouse::RawPulse> next();
  std::size_t line_number() const { return lines_.line_number(); }
  bool ended_unfinished() const { return lines_.ended_unfinished(); }
  const std::string& name() const { return lines_.name(); }

  /// Whether the first bytes of an input are the header of such a table.
  static bool looks_like(std::string_view first_bytes);
  /// Bytes that looks_like needs at most.
  static constexpr std::size_t kHeaderBytes = 256;

 private:
  static constexpr std::size_t kColumns = 3;

  void read_header();
  [[noreturn]] void fail(std::string_view line) const;

  LineReader lines_;
  std::vector<std::size_t> column_of_field_;  // kColumns for a field that is ignored
  std::size_t fields_needed_ = 0;
  TickColumn ticks_;
};

}  // namespace pharos::host
