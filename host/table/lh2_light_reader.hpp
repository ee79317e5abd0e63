// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/table/line_reader.hpp"
#include "host/table/tick_column.hpp"
#include "pharos/lighthouse/lh2_burst.hpp"

namespace pharos::host {

/// Raw light of Lighthouse 2.0: a row for each change of a receiver's outputs, in the order of time for each sensor.
///
/// Either a table with the columns `sensor,time_ticks,data,envelope` (20 ns ticks, 32-bit or unwrapped, see TickColumn;
/// data 0 or 1; envelope 0 while there is light, as receivers give it), or what a logic analyser exports for one
/// receiver: a header that begins with `Time[s]`, then a channel with the data and perhaps one with the envelope. Its
/// times are rounded to ticks.
///
/// A last line without a line end was cut off in writing: it is dropped and ended_unfinished() is true. Anything else
/// that is not such a row is an InputError that names file, line and column.
class Lh2LightReader {
 public:
  explicit Lh2LightReader(ByteSource source);

  std::optional<lighthouse::Lh2Edge> next();
  bool ended_unfinished() const { return lines_.ended_unfinished(); }
  const std::string& name() const { return lines_.name(); }

 private:
  enum Column : std::size_t { kSensor, kTime, kData, kEnvelope, kColumns };

  void read_header();
  void name_columns(const std::vector<std::string>& fields);
  void split(std::string_view line);
  std::int64_t whole(Column column, std::int64_t minimum, std::int64_t maximum) const;
  std::int64_t time_ticks();
  [[noreturn]] void fail(Column column, const char* what) const;

  LineReader lines_;
  bool analyser_ = false;
  std::size_t header_fields_ = 0;
  std::array<std::optional<std::size_t>, kColumns> position_;
  std::vector<std::string_view> fields_;
  TickColumn ticks_;
};

}  // namespace pharos::host
