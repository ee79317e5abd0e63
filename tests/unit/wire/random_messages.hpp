// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "pharos/wire/codec.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/counters_message.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/lh2_sweep_message.hpp"
#include "pharos/wire/loader_messages.hpp"
#include "pharos/wire/ootx_message.hpp"
#include "pharos/wire/pose_message.hpp"
#include "pharos/wire/raw_edges_message.hpp"
#include "pharos/wire/sweep_message.hpp"

namespace pharos::wire::test {

using Bytes = std::vector<std::uint8_t>;

/// Draws messages of every type with every field anywhere in its range.
class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed) : random_(seed) {}

  template <class T = std::uint64_t>
  T integer() {
    return static_cast<T>(random_());
  }
  std::size_t below(std::size_t bound) { return random_() % bound; }
  template <class T>
  T between(std::int64_t minimum, std::int64_t maximum) {
    return static_cast<T>(minimum + static_cast<std::int64_t>(below(static_cast<std::size_t>(maximum - minimum + 1))));
  }
  std::int64_t ticks() { return integer<std::int64_t>() % (kMaxTicks + 1); }
  double real() {
    const auto mantissa = static_cast<double>(integer<std::int32_t>());
    return std::ldexp(mantissa, static_cast<int>(below(60)) - 45);
  }

  void fill(Time& m) { m.time_ticks = ticks(); }
  void fill(Hello& m) {
    m.role = static_cast<Role>(below(3));
    m.reset_cause = static_cast<ResetCause>(below(kResetCauses));
    m.modes = integer<std::uint8_t>();
    m.firmware_major = integer<std::uint8_t>();
    m.firmware_minor = integer<std::uint8_t>();
    m.firmware_patch = integer<std::uint8_t>();
    m.start_count = integer<std::uint16_t>();
    m.tick_rate_hz = integer<std::uint32_t>();
    m.sensors = integer<std::uint32_t>();
    m.time_ticks = ticks();
    m.unique_id = integer<std::uint32_t>();
    fill(m.board);
    fill(m.target);
  }
  void fill(Counters& m) {
    m.time_ticks = ticks();
    m.group = static_cast<CounterGroup>(below(3));
    m.values.clear();
    for (std::size_t i = below(Counters::kMaxValues + 1); i > 0; --i) m.values.push_back(integer<std::uint32_t>());
  }
  void fill(Sweep& m) {
    m.flash_start_ticks = ticks();
    m.flash_length_ticks = between<std::int32_t>(kMinFlash_ticks, kMaxPulse_ticks);
    m.period_sixteenth_ticks = between<std::uint32_t>(kMinPeriod_sixteenth_ticks, kMaxPeriod_sixteenth_ticks);
    m.flash_sensors = between<std::uint8_t>(0, kMaxSensors);
    m.flags = integer<std::uint8_t>();
    m.station = static_cast<std::uint8_t>(below(2));
    m.axis = static_cast<Axis>(below(2));
    m.data = below(2) == 1;
    m.skip = below(2) == 1;
    m.hits.clear();
    for (std::size_t i = below(kMaxHitsPerSweep + 1); i > 0; --i) {
      m.hits.push_back({between<std::uint8_t>(0, kMaxSensors - 1),
                        between<std::uint16_t>(kMinPulse_ticks, kMaxPulse_ticks),
                        between<std::int32_t>(0, kMaxCentre_half_ticks)});
    }
  }
  void fill(Ootx& m) {
    m.time_ticks = ticks();
    m.station = static_cast<std::uint8_t>(below(2));
    m.data.clear();
    for (std::size_t i = below(Ootx::kMaxData + 1); i > 0; --i) m.data.push_back(integer<std::uint8_t>());
  }
  void fill(Lh2Sweep& m) {
    m.sync_ticks = ticks();
    m.sync_sixths = static_cast<std::uint8_t>(below(6));
    m.channel = static_cast<std::uint8_t>(below(16));
    m.plane = static_cast<std::uint8_t>(below(2));
    m.slow_bit = below(2) == 1;
    m.hits.clear();
    for (std::size_t i = below(kMaxHitsPerSweep + 1); i > 0; --i) {
      m.hits.push_back({between<std::uint8_t>(0, kMaxSensors - 1), between<std::uint16_t>(1, kMaxLh2Width_ticks),
                        between<std::int32_t>(0, kMaxLh2Centre_sixths)});
    }
  }
  void fill(Lh2Ootx& m) {
    m.time_ticks = ticks();
    m.channel = static_cast<std::uint8_t>(below(16));
    m.data.clear();
    for (std::size_t i = below(Lh2Ootx::kMaxData + 1); i > 0; --i) m.data.push_back(integer<std::uint8_t>());
  }
  void fill(PoseFields& m) {
    for (double& value : m.orientation_wxyz) value = real();
    for (double& value : m.position_m) value = real();
  }
  void fill(Pose& m) {
    m.time_ticks = ticks();
    m.station = static_cast<std::uint8_t>(below(2));
    m.flags = integer<std::uint8_t>();
    m.observations = integer<std::uint16_t>();
    m.answer.reset();
    m.refusal = below(3) == 0 ? static_cast<std::uint8_t>(1 + below(255)) : std::uint8_t{0};
    if (m.refusal != 0) return;
    PoseResult& answer = m.answer.emplace();
    fill(answer.pose);
    for (float& value : answer.covariance) value = static_cast<float>(real());
    answer.residual_rms_rad = static_cast<float>(real());
    answer.adop_deg_per_rad = static_cast<float>(real());
    answer.pdop_m_per_rad = static_cast<float>(real());
    answer.iterations = integer<std::uint8_t>();
    if (below(2) == 0) return;
    fill(answer.second.emplace().pose);
    answer.second->delta_chi2 = static_cast<float>(real());
  }
  void fill(RawEdges& m) {
    m.edges_lost = integer<std::uint32_t>();
    RawEdgesPacker packer;
    RawEdge edge{ticks(), 0, false};
    for (std::size_t i = below(RawEdges::kMaxEdges + 1); i > 0; --i) {
      // Mostly small steps, as in light, sometimes implausible ones.
      edge.stamp_ticks = below(20) == 0 ? ticks() : edge.stamp_ticks / 2 + static_cast<std::int64_t>(below(400000));
      edge.sensor = static_cast<std::uint8_t>(below(kMaxSensors));
      edge.rising = below(2) == 1;
      if (!packer.push(edge)) break;
    }
    m.edges = decode_payload<RawEdges>(packer.payload(0)).value().edges;
  }
  void fill(Command& m) { m = {static_cast<CommandCode>(integer<std::uint8_t>()), integer<std::uint32_t>()}; }
  void fill(Ack& m) { m = {integer<std::uint8_t>(), integer<std::uint16_t>(), integer<std::uint32_t>()}; }
  void fill(Nak& m) {
    m = {integer<std::uint8_t>(), integer<std::uint16_t>(), static_cast<NakReason>(integer<std::uint8_t>()),
         integer<std::uint32_t>()};
  }
  void fill(LoaderQuery&) {}
  void fill(LoaderInfo& m) {
    m.loader_version = integer<std::uint16_t>();
    m.block_bytes = integer<std::uint16_t>();
    m.slot_offset = integer<std::uint32_t>();
    m.capacity_bytes = integer<std::uint32_t>();
    fill(m.board);
  }
  void fill(LoaderBegin& m) {
    m.image_bytes = integer<std::uint32_t>();
    m.image_crc32 = integer<std::uint32_t>();
    fill(m.board);
  }
  void fill(LoaderData& m) {
    m.offset = integer<std::uint32_t>();
    m.data.clear();
    for (std::size_t i = below(LoaderData::kMaxData + 1); i > 0; --i) m.data.push_back(integer<std::uint8_t>());
  }
  void fill(LoaderVerify&) {}
  void fill(LoaderStart&) {}
  template <std::size_t N>
  void fill(Text<N>& text) {
    text = Text<N>();
    for (std::size_t i = below(N + 1); i > 0; --i) text.characters[i - 1] = static_cast<char>(' ' + below(95));
  }

  template <class M>
  Bytes payload_of() {
    M message;
    fill(message);
    std::array<std::uint8_t, kMaxPayload> bytes{};
    const std::size_t size = encode_payload(message, bytes);
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
  }

 private:
  std::mt19937_64 random_;
};

template <class... Messages>
struct MessageList {
  template <class Visitor>
  static void for_each(Visitor&& visit) {
    (visit(Messages{}), ...);
  }
  static constexpr std::size_t kSize = sizeof...(Messages);
};

/// All message types.
using AllMessages = MessageList<Hello, Counters, Time, Sweep, Ootx, Pose, RawEdges, Command, LoaderQuery, LoaderInfo,
                                LoaderBegin, LoaderData, LoaderVerify, LoaderStart, Ack, Nak, Lh2Sweep, Lh2Ootx>;

/// Calls visit(M{}) with the message struct of `type`; false for types that have none.
template <class Visitor>
bool visit_type(MessageType type, Visitor&& visit) {
  bool found = false;
  AllMessages::for_each([&](auto message) {
    if (decltype(message)::kType != type) return;
    found = true;
    visit(message);
  });
  return found;
}

inline Bytes frame_bytes(FrameEncoder& encoder, MessageType type, std::span<const std::uint8_t> payload) {
  Bytes line(kMaxLineFrame);
  line.resize(encoder.encode(type, payload, line));
  return line;
}

}  // namespace pharos::wire::test
