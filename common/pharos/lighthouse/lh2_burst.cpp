// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_burst.hpp"

namespace pharos::lighthouse {
namespace {

// Between the halves of a bit are 4 ticks, between the worst garbage at the end of a burst 70 (captures of a receiver).
constexpr std::int64_t kBurstGap_ticks = 60;
// An envelope that stays on although nothing changes belongs to no burst.
constexpr std::int64_t kStuckEnvelope_ticks = 500;
// The widest sheet (0.3 m from a station) passes in 60 us.
constexpr std::int64_t kLongestBurst_ticks = 5000;
// 17 bits have at least this many changes; noise of a receiver has 2 or 4.
constexpr std::size_t kMinBurstEdges = 18;
// So many changes in a row that are before the last one: the counter started anew.
constexpr std::uint8_t kCounterWentBack = 32;

}  // namespace

std::optional<Lh2Burst> Lh2BurstCollector::push(const Lh2Edge& edge, Lh2Counters& counters) {
  ++counters.edges_in;
  if (edge.sensor >= kMaxSensors) {
    ++counters.edges_bad_sensor;
    return std::nullopt;
  }
  Receiver& receiver = receiver_[edge.sensor];
  if (!is_possible_time(edge.time_ticks)) {
    ++counters.edges_off_time;
    return std::nullopt;
  }
  if (receiver.seen && edge.time_ticks < receiver.last_ticks) {
    ++counters.edges_off_time;
    if (++receiver.early < kCounterWentBack) return std::nullopt;
    const auto ended = receiver.open ? close(receiver, counters) : std::nullopt;
    receiver = {};
    return ended;
  }
  receiver.early = 0;
  std::optional<Lh2Burst> ended;
  if (receiver.open && has_ended(receiver, edge.time_ticks)) ended = close(receiver, counters);
  if (receiver.seen && (edge.data != receiver.data || edge.light != receiver.light)) add(receiver, edge, counters);
  receiver.seen = true;
  receiver.data = edge.data;
  receiver.light = edge.light;
  receiver.last_ticks = edge.time_ticks;
  return ended;
}

void Lh2BurstCollector::add(Receiver& receiver, const Lh2Edge& edge, Lh2Counters& counters) {
  Lh2Burst& burst = receiver.burst;
  if (!receiver.open) {
    const bool light_ends = edge.data == receiver.data && !edge.light;
    if (light_ends) return;
    burst = {};
    burst.start_ticks = edge.time_ticks;
    burst.sensor = edge.sensor;
    receiver.open = true;
    receiver.too_long = false;
  }
  const std::int64_t after = edge.time_ticks - burst.start_ticks;
  if (after > kLongestBurst_ticks) {
    receiver.too_long = true;
    return;
  }
  const auto ticks = static_cast<std::uint16_t>(after);
  if (edge.data != receiver.data && !burst.edge_ticks.push_back(ticks)) ++counters.edges_overflow;
  // The envelope may flicker: from its first beginning to its last end.
  if (edge.light && !receiver.light && !burst.has_envelope()) burst.light_begin_ticks = burst.light_end_ticks = ticks;
  if (!edge.light && receiver.light) burst.light_end_ticks = ticks;
}

bool Lh2BurstCollector::has_ended(const Receiver& receiver, std::int64_t now_ticks) {
  return now_ticks - receiver.last_ticks > (receiver.light ? kStuckEnvelope_ticks : kBurstGap_ticks);
}

std::optional<Lh2Burst> Lh2BurstCollector::close(Receiver& receiver, Lh2Counters& counters) {
  receiver.open = false;
  ++counters.bursts;
  if (receiver.too_long) {
    ++counters.bursts_long;
    return std::nullopt;
  }
  if (receiver.burst.edge_ticks.size() < kMinBurstEdges) {
    ++counters.bursts_short;
    return std::nullopt;
  }
  return receiver.burst;
}

std::optional<Lh2Burst> Lh2BurstCollector::advance(std::int64_t now_ticks, Lh2Counters& counters) {
  for (Receiver& receiver : receiver_) {
    if (!receiver.open || !has_ended(receiver, now_ticks)) continue;
    if (auto burst = close(receiver, counters)) return burst;
  }
  return std::nullopt;
}

std::optional<Lh2Burst> Lh2BurstCollector::flush(Lh2Counters& counters) {
  for (Receiver& receiver : receiver_) {
    if (!receiver.open) continue;
    if (auto burst = close(receiver, counters)) return burst;
  }
  return std::nullopt;
}

}  // namespace pharos::lighthouse
