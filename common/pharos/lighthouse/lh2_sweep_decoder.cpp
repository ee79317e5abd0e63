// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_sweep_decoder.hpp"

namespace pharos::lighthouse {
namespace {

// 1 ms: a rotor turns by 18 deg. A wider target gives two sweeps of one pass.
constexpr std::int64_t kSweepGap_sixths = 1000 * 50 * kSixthsPerTick;

/// Middle of the light after the sync, by the station's clock.
std::int64_t centre_of(const Lh2Beam& beam) {
  return std::int64_t{beam.place} * kBit_sixths + (beam.centre_sixths - beam.time_sixths);
}

bool within_turn(const Lh2Beam& beam) {
  return beam.channel < kLh2Channels && beam.place < kLh2SequenceLength && centre_of(beam) >= 0 &&
         centre_of(beam) < lh2_turn_sixths(beam.channel);
}

}  // namespace

void Lh2SweepDecoder::push(const Lh2Beam& beam) {
  ++counters_.beams;
  advance(beam.centre_sixths);
  if (!within_turn(beam)) {
    ++counters_.beams_beyond_turn;
    return;
  }
  Channel& channel = channel_[beam.channel];
  const Lh2Rotor::Outcome outcome = channel.rotor.push(beam);
  counters_.beams_unconfirmed += outcome.dropped;
  if (outcome.lost) ++counters_.locks_lost;
  if (outcome.found) ++counters_.locks;
  if (outcome.confirmed) add_hit(channel, *outcome.confirmed, *outcome.confirmed_at);
  if (outcome.placed) add_hit(channel, beam, *outcome.placed);
}

void Lh2SweepDecoder::add_hit(Channel& channel, const Lh2Beam& beam, const Lh2Placed& placed) {
  const std::int64_t centre = centre_of(beam);
  const std::uint8_t plane = lh2_plane_of(centre, beam.channel);
  if (!channel.sweep.hits.empty() && (placed.turn != channel.turn || plane != channel.sweep.plane)) close(channel);
  if (channel.sweep.hits.empty()) {
    channel.sweep.sync_sixths = placed.sync_sixths;
    channel.sweep.channel = beam.channel;
    channel.sweep.plane = plane;
    channel.sweep.slow_bit = beam.slow_bit;
    channel.turn = placed.turn;
  }
  if (channel.sweep.hits.push_back({beam.sensor, beam.width_ticks, static_cast<std::int32_t>(centre)})) {
    ++counters_.hits;
  } else {
    ++counters_.hits_overflow;
  }
  channel.last_sixths = beam.centre_sixths;
  if (const auto bytes = channel.slow.push(placed.turn, beam.slow_bit, counters_)) {
    if (!payloads_.push({beam.time_sixths / kSixthsPerTick, beam.channel, *bytes})) ++counters_.outputs_overflow;
  }
}

void Lh2SweepDecoder::close(Channel& channel) {
  ++counters_.sweeps;
  if (!sweeps_.push(channel.sweep)) ++counters_.outputs_overflow;
  channel.sweep.hits.clear();
}

void Lh2SweepDecoder::advance(std::int64_t now_sixths) {
  for (Channel& channel : channel_) {
    if (!channel.sweep.hits.empty() && now_sixths - channel.last_sixths > kSweepGap_sixths) close(channel);
  }
}

void Lh2SweepDecoder::flush() {
  for (Channel& channel : channel_) {
    if (!channel.sweep.hits.empty()) close(channel);
    counters_.beams_unconfirmed += channel.rotor.flush();
  }
}

std::optional<Lh2Sweep> Lh2SweepDecoder::take_sweep() {
  if (sweeps_.empty()) return std::nullopt;
  return sweeps_.pop();
}

std::optional<OotxPayload> Lh2SweepDecoder::take_ootx() {
  if (payloads_.empty()) return std::nullopt;
  return payloads_.pop();
}

bool Lh2SweepDecoder::fits(const Lh2Beam& beam) const {
  return within_turn(beam) && channel_[beam.channel].rotor.fits(beam);
}

std::uint32_t Lh2SweepDecoder::channels() const {
  std::uint32_t running = 0;
  for (std::size_t c = 0; c < kLh2Channels; ++c) running |= std::uint32_t{channel_[c].rotor.running()} << c;
  return running;
}

}  // namespace pharos::lighthouse
