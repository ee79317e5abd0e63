// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

/// One edge as the capture block stamped it.
struct RawEdge {
  std::int64_t stamp_ticks = 0;  // 64 bits unwrapped
  std::uint8_t sensor = 0;       // 0..31
  bool rising = false;
  bool operator==(const RawEdge&) const = default;
};

/// Diagnostic mode: every edge, in the order of capture, so that recordings of edges can be made of any real target.
///
/// Sensor and level take one byte, the time since the edge before it 1 byte up to 63 ticks, 2 up to 8,191, 3 up to
/// 1,048,575 (20.9 ms), at most 10. Real edges take about 3.2 bytes each: see proto/README.md for rates.
struct RawEdges {
  static constexpr MessageType kType = MessageType::kRawEdges;
  static constexpr std::size_t kMaxEdges = 128;
  static constexpr std::size_t kHeadBytes = 13;
  static constexpr std::size_t kMaxEdgeBytes = 11;
  static constexpr std::size_t kMaxBytes = 512;

  std::uint32_t edges_lost = 0;  // by the capture block or because the line was too slow, since start
  StaticVector<RawEdge, kMaxEdges> edges;
};

// 45 edges fit with any stamps; RawEdgesPacker fills a message completely.
void write(const RawEdges& message, ByteWriter& out);
void read(ByteReader& in, RawEdges& message);

/// Writes edges into the payload of one message, as they arrive, until the next one does not fit. State: 0.5 kB.
class RawEdgesPacker {
 public:
  /// False when the message is full: send it, clear(), and push the edge again. An edge that cannot be sent (sensor
  /// above 31, time out of range) is left out.
  bool push(const RawEdge& edge);
  /// The payload of a RawEdges message with what was pushed since clear().
  std::span<const std::uint8_t> payload(std::uint32_t edges_lost);
  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }

 private:
  std::array<std::uint8_t, RawEdges::kMaxBytes> bytes_{};
  std::size_t size_ = 0;
  std::uint8_t count_ = 0;
  std::int64_t first_ticks_ = 0;
  std::int64_t last_ticks_ = 0;
};

}  // namespace pharos::wire
