// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::hal {

/// One tick in which inputs changed, as read from the capture block's FIFO (firmware/rtl/README.md).
struct CaptureRecord {
  std::uint32_t time_ticks = 0;  // low word of the counter
  std::uint32_t changed = 0;     // bit per input; never 0
  std::uint32_t levels = 0;      // of all inputs after it
  bool gap = false;              // edges are missing between this record and the one before
};

/// The capture block: edges of the photodiodes stamped by a free-running counter, and that counter.
class EdgeCapture {
 public:
  /// The oldest record in the FIFO, removed from it; false when it is empty.
  virtual bool read(CaptureRecord& record) = 0;
  /// The counter that stamps the records, 64 bits. Records stamped kSettle_ticks before it or earlier can be read.
  virtual std::int64_t now_ticks() = 0;
  static constexpr std::int64_t kSettle_ticks = 8;  // the block's two, and a bus read or two
  /// Edges that the block dropped since it started.
  virtual std::uint32_t edges_lost() = 0;
  /// Whether it dropped any since the last call.
  virtual bool take_overflow() = 0;
  /// Bit per input that exists.
  virtual std::uint32_t inputs() = 0;

 protected:
  ~EdgeCapture() = default;
};

}  // namespace pharos::hal
