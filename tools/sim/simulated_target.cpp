// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/simulated_target.hpp"

#include "pharos/base/ticks.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/hello_message.hpp"

namespace pharos::sim {
namespace {

constexpr std::int64_t kTimePeriod_ticks = kTicksPerSecond / 10;
// Longest credible pulse (a stretched flash, 0.2 ms) with room to spare.
constexpr std::int64_t kEdgeHold_ticks = kTicksPerSecond / 1000;

}  // namespace

SimulatedTarget::SimulatedTarget(const TargetIdentity& identity) : identity_(identity) {
  if (identity.generation != 2) return;
  sequences_ = std::make_unique<lighthouse::Lh2Sequences>();
  lh2_ = std::make_unique<lighthouse::Lh2LightDecoder>(*sequences_);
}

void SimulatedTarget::queue(report::Reporter::Bytes bytes) {
  if (bytes.empty()) return;
  frames_.emplace_back(bytes.begin(), bytes.end());
  ++device_.frames_sent;
}

void SimulatedTarget::push(const lighthouse::RawPulse& pulse) {
  if ((identity_.modes & wire::kModeRawEdges) != 0) {
    edges_.push({pulse.rise_ticks, pulse.sensor, true});
    edges_.push({pulse.fall_ticks, pulse.sensor, false});
  }
  decoder_.push(pulse);
  take_decoded();
}

void SimulatedTarget::push(const lighthouse::Lh2Edge& edge) {
  if (!lh2_) return;
  lh2_->push(edge);
  take_decoded();
}

void SimulatedTarget::advance(std::int64_t now_ticks) {
  now_ticks_ = now_ticks;
  if (lh2_) {
    lh2_->advance(now_ticks);
  } else {
    decoder_.advance(now_ticks);
  }
  take_decoded();
  if (!started_) {
    started_ = true;
    ++starts_;
    next_time_ticks_ = now_ticks;
    next_second_ticks_ = now_ticks;
  }
  give_out_edges(now_ticks - kEdgeHold_ticks);
  send_periodic();
}

void SimulatedTarget::restart_line() {
  started_ = false;
  frames_.clear();
  reporter_ = report::Reporter();
  from_host_.restart();
}

void SimulatedTarget::finish() {
  if (lh2_) lh2_->flush();
  decoder_.flush();
  take_decoded();
  give_out_edges(INT64_MAX);
  if ((identity_.modes & wire::kModeRawEdges) != 0) queue(reporter_.flush_edges());
  next_second_ticks_ = now_ticks_;
  send_periodic();
}

void SimulatedTarget::take_decoded() {
  const bool sends = (identity_.modes & wire::kModeSweeps) != 0;
  while (const auto sweep = decoder_.take_sweep()) {
    ++sweeps_;
    if (sends) queue(reporter_.report(*sweep));
  }
  while (const auto payload = decoder_.take_ootx()) {
    ++payloads_;
    if (sends) queue(reporter_.report(*payload));
  }
  if (lh2_) take_lh2(sends);
}

void SimulatedTarget::take_lh2(bool sends) {
  while (const auto sweep = lh2_->take_sweep()) {
    ++sweeps_;
    if (sends) queue(reporter_.report(*sweep));
  }
  while (const auto payload = lh2_->take_ootx()) {
    ++payloads_;
    if (sends) queue(reporter_.report(report::Lh2OotxReport{*payload}));
  }
}

void SimulatedTarget::give_out_edges(std::int64_t until_ticks) {
  while (!edges_.empty() && edges_.top().stamp_ticks <= until_ticks) {
    queue(reporter_.report(edges_.top(), device_.edges_lost));
    edges_.pop();
  }
}

void SimulatedTarget::send_hello() {
  wire::Hello hello;
  hello.role = wire::Role::kSimulator;
  hello.reset_cause = wire::ResetCause::kPowerOn;
  hello.modes = identity_.modes;
  hello.start_count = starts_;
  hello.tick_rate_hz = static_cast<std::uint32_t>(kTicksPerSecond);
  hello.sensors = identity_.sensors;
  hello.time_ticks = now_ticks_;
  hello.unique_id = identity_.unique_id;
  hello.board = wire::Text<24>("simulator");
  hello.target = wire::Text<24>(identity_.name);
  queue(reporter_.send(hello));
}

void SimulatedTarget::send_periodic() {
  if (now_ticks_ >= next_second_ticks_) {
    next_second_ticks_ = now_ticks_ + kTicksPerSecond;
    send_hello();
    queue(reporter_.report(report::DecoderReport{now_ticks_, decoder_.counters()}));
    queue(reporter_.report(report::DeviceReport{now_ticks_, device_}));
  }
  if (now_ticks_ >= next_time_ticks_) {
    next_time_ticks_ = now_ticks_ + kTimePeriod_ticks;
    queue(reporter_.report_time(now_ticks_));
  }
}

void SimulatedTarget::receive(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    const auto frame = from_host_.push(byte);
    if (!frame) continue;
    const auto type = static_cast<std::uint8_t>(frame->type);
    if (frame->type != wire::MessageType::kCommand) {
      queue(reporter_.send(wire::Nak{type, frame->sequence, wire::NakReason::kUnsupported, 0}));
      continue;
    }
    const auto command = wire::decode_payload<wire::Command>(frame->payload);
    if (command) {
      answer(*command, frame->sequence);
    } else {
      ++device_.commands_refused;
      queue(reporter_.send(wire::Nak{type, frame->sequence, wire::NakReason::kBadPayload, 0}));
    }
  }
}

void SimulatedTarget::answer(const wire::Command& command, std::uint16_t sequence) {
  const auto type = static_cast<std::uint8_t>(wire::MessageType::kCommand);
  switch (command.code) {
    case wire::CommandCode::kIdentify:
      ++device_.commands;
      queue(reporter_.send(wire::Ack{type, sequence, 0}));
      send_hello();
      return;
    case wire::CommandCode::kSetModes:
      ++device_.commands;
      // It has no pose solver on board.
      identity_.modes = static_cast<std::uint8_t>(command.value & (wire::kModeSweeps | wire::kModeRawEdges));
      queue(reporter_.send(wire::Ack{type, sequence, identity_.modes}));
      return;
    default:
      ++device_.commands_refused;
      queue(reporter_.send(wire::Nak{type, sequence, wire::NakReason::kUnsupported, 0}));
  }
}

}  // namespace pharos::sim
