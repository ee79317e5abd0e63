// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/raw_edges_message.hpp"

#include "pharos/base/capacity.hpp"

namespace pharos::wire {
namespace {

constexpr std::uint8_t kRisingBit = 0x80;

void write_edge(const RawEdge& edge, std::int64_t previous_ticks, ByteWriter& out) {
  if (edge.sensor >= kMaxSensors || !is_plausible_time(edge.stamp_ticks)) out.fail();
  out.put(static_cast<std::uint8_t>(edge.sensor | (edge.rising ? kRisingBit : 0)));
  out.put_varint(edge.stamp_ticks - previous_ticks);
}

void write_head(std::uint32_t edges_lost, std::int64_t first_ticks, std::size_t count, ByteWriter& out) {
  out.put(edges_lost);
  out.put_ticks(first_ticks);
  out.put(static_cast<std::uint8_t>(count));
}

}  // namespace

void write(const RawEdges& message, ByteWriter& out) {
  std::int64_t previous = message.edges.empty() ? 0 : message.edges[0].stamp_ticks;
  write_head(message.edges_lost, previous, message.edges.size(), out);
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
    const bool plausible = step >= -2 * kMaxTicks && step <= 2 * kMaxTicks && is_plausible_time(previous + step);
    in.refuse_if(!plausible || edge.sensor >= kMaxSensors || (i == 0 && step != 0));
    edge.stamp_ticks = plausible ? previous + step : previous;
    previous = edge.stamp_ticks;
    message.edges.push_back(edge);
  }
}

bool RawEdgesPacker::push(const RawEdge& edge) {
  if (edge.sensor >= kMaxSensors || !is_plausible_time(edge.stamp_ticks)) return true;
  if (count_ == RawEdges::kMaxEdges) return false;
  if (empty()) {
    size_ = RawEdges::kHeadBytes;
    first_ticks_ = last_ticks_ = edge.stamp_ticks;
  }
  ByteWriter writer{std::span(bytes_).subspan(size_)};
  write_edge(edge, last_ticks_, writer);
  if (writer.failed()) return false;
  size_ += writer.size();
  last_ticks_ = edge.stamp_ticks;
  ++count_;
  return true;
}

std::span<const std::uint8_t> RawEdgesPacker::payload(std::uint32_t edges_lost) {
  ByteWriter writer(bytes_);
  write_head(edges_lost, empty() ? 0 : first_ticks_, count_, writer);
  return std::span(bytes_).first(empty() ? RawEdges::kHeadBytes : size_);
}

}  // namespace pharos::wire
