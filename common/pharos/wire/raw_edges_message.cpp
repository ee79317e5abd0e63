// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/raw_edges_message.hpp"

#include <array>

#include "pharos/base/capacity.hpp"

namespace pharos::wire {
namespace {

constexpr std::uint8_t kRisingBit = 0x80;

void write_edge(const RawEdge& edge, std::int64_t previous_ticks, ByteWriter& out) {
  if (edge.sensor >= kMaxSensors || !is_credible_time(edge.stamp_ticks)) out.fail();
  out.put(static_cast<std::uint8_t>(edge.sensor | (edge.rising ? kRisingBit : 0)));
  out.put_varint(edge.stamp_ticks - previous_ticks);
}

}  // namespace

void write(const RawEdges& message, ByteWriter& out) {
  std::int64_t previous = message.edges.empty() ? 0 : message.edges[0].stamp_ticks;
  out.put(message.edges_lost);
  out.put_ticks(previous);
  out.put(static_cast<std::uint8_t>(message.edges.size()));
  for (const RawEdge& edge : message.edges) {
    write_edge(edge, previous, out);
    previous = edge.stamp_ticks;
  }
}

void read(ByteReader& in, RawEdges& message) {
  message.edges_lost = in.get<std::uint32_t>();
  const std::int64_t first = in.get_ticks();
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(count > RawEdges::kMaxEdges || (count == 0 && first != 0));
  std::int64_t previous = first;
  message.edges.clear();
  for (std::size_t i = 0; i < count && i < RawEdges::kMaxEdges && !in.ran_short(); ++i) {
    const auto head = in.get<std::uint8_t>();
    RawEdge edge;
    edge.rising = (head & kRisingBit) != 0;
    edge.sensor = static_cast<std::uint8_t>(head & ~kRisingBit);
    const std::int64_t step = in.get_varint();
    const bool credible = step >= -2 * kMaxTicks && step <= 2 * kMaxTicks && is_credible_time(previous + step);
    in.refuse_if(!credible || edge.sensor >= kMaxSensors || (i == 0 && step != 0));
    edge.stamp_ticks = credible ? previous + step : previous;
    previous = edge.stamp_ticks;
    message.edges.push_back(edge);
  }
}

bool RawEdgesPacker::push(const RawEdge& edge) {
  if (edge.sensor >= kMaxSensors || !is_credible_time(edge.stamp_ticks)) return true;
  std::array<std::uint8_t, RawEdges::kMaxEdgeBytes> scratch{};
  ByteWriter writer(scratch);
  write_edge(edge, empty() ? edge.stamp_ticks : message_.edges.back().stamp_ticks, writer);
  if (bytes_ + writer.size() > RawEdges::kMaxBytes || !message_.edges.push_back(edge)) return false;
  bytes_ += writer.size();
  return true;
}

void RawEdgesPacker::clear() {
  message_.edges.clear();
  bytes_ = RawEdges::kHeadBytes;
}

}  // namespace pharos::wire
