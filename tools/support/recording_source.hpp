// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/table/byte_source.hpp"
#include "tools/support/recording.hpp"

namespace pharos::tools {

/// Called with each counter's name, value and meaning.
using CounterVisitor = std::function<void(const char* name, std::uint64_t value, const char* text)>;

/// One format of a recording.
class RecordingSource {
 public:
  RecordingSource() = default;
  RecordingSource(const RecordingSource&) = delete;
  RecordingSource& operator=(const RecordingSource&) = delete;
  virtual ~RecordingSource() = default;

  virtual std::optional<RecordingEvent> next() = 0;
  /// Whether a target decoded it, of either generation.
  virtual bool is_serial() const = 0;
  virtual void visit_counters(const CounterVisitor& visit) const = 0;
  /// Notes for the user at the end.
  virtual std::vector<std::string> remarks() const = 0;
};

/// A table of light pulses, decoded here.
std::unique_ptr<RecordingSource> open_pulse_table(host::ByteSource bytes);
/// A recorded serial stream.
std::unique_ptr<RecordingSource> open_serial_stream(host::ByteSource bytes);
/// The raw bytes of a serial line, from the delimiter of a frame on.
std::unique_ptr<RecordingSource> open_line_bytes(host::ByteSource bytes);

}  // namespace pharos::tools
