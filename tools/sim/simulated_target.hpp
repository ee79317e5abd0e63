// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <queue>
#include <span>
#include <string>
#include <vector>

#include "pharos/lighthouse/decoder.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/report/reporter.hpp"

namespace pharos::sim {

/// Identity of a simulated target.
struct TargetIdentity {
  std::string name;           // Hello::target
  std::uint32_t sensors = 0;  // bit per sensor
  std::uint32_t unique_id = 0;
  std::uint8_t modes = wire::kModeSweeps;
  int generation = 1;  // of the stations whose light it decodes
};

/// A target's program without its board: converts pulses and clock to the bytes for the line, as encoded by the
/// portable core. Hello at the start, on request and once a second, the clock ten times a second, counters once a
/// second, sweeps and OOTX payloads as they occur (or raw edges), responses to commands.
class SimulatedTarget {
 public:
  explicit SimulatedTarget(const TargetIdentity& identity);

  void push(const lighthouse::RawPulse& pulse);
  /// Light of Lighthouse 2.0, for a target of generation 2.
  void push(const lighthouse::Lh2Edge& edge);
  /// Advances the counter to `now_ticks` and sends what is due. To be called often; must not go backwards.
  void advance(std::int64_t now_ticks);
  /// Power on: the next advance() sends Hello first.
  void restart_line();
  /// Bytes from the host.
  void receive(std::span<const std::uint8_t> bytes);
  /// End of the recording: sends everything that is still held back.
  void finish();

  /// Whole frames that wait to be sent, oldest first.
  std::deque<std::vector<std::uint8_t>>& frames() { return frames_; }
  /// A frame was dropped because the line is too slow.
  void count_skipped() { ++device_.frames_skipped; }

  std::uint32_t sweeps() const { return sweeps_; }
  std::uint32_t payloads() const { return payloads_; }
  const lighthouse::DecoderCounters& decoder_counters() const { return decoder_.counters(); }

 private:
  // Edges wait until every pulse that began before them has ended and been pushed.
  struct LaterEdge {
    bool operator()(const lighthouse::Edge& a, const lighthouse::Edge& b) const {
      return a.stamp_ticks > b.stamp_ticks;
    }
  };
  void queue(report::Reporter::Bytes bytes);
  void send_hello();
  void send_periodic();
  void take_decoded();
  void take_lh2(bool sends);
  void give_out_edges(std::int64_t until_ticks);
  void answer(const wire::Command& command, std::uint16_t sequence);

  TargetIdentity identity_;
  lighthouse::Decoder decoder_;
  // Of generation 2.
  std::unique_ptr<lighthouse::Lh2Sequences> sequences_;
  std::unique_ptr<lighthouse::Lh2LightDecoder> lh2_;
  report::Reporter reporter_;
  wire::FrameDecoder from_host_;
  wire::DeviceCounters device_;
  std::deque<std::vector<std::uint8_t>> frames_;
  std::priority_queue<lighthouse::Edge, std::vector<lighthouse::Edge>, LaterEdge> edges_;
  std::int64_t now_ticks_ = 0;
  std::int64_t next_time_ticks_ = 0;
  std::int64_t next_second_ticks_ = 0;
  bool started_ = false;
  std::uint16_t starts_ = 0;
  std::uint32_t sweeps_ = 0;
  std::uint32_t payloads_ = 0;
};

}  // namespace pharos::sim
