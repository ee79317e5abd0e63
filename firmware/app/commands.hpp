// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/base/ring_buffer.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/frame_decoder.hpp"

namespace pharos::app {

/// Reply to one frame of the host.
struct Reply {
  std::uint8_t for_type = 0;
  std::uint16_t for_sequence = 0;
  std::optional<wire::NakReason> refused;  // empty: Ack
  std::uint32_t value = 0;
};

/// Bytes of the host -> requests, and the replies that wait for the line.
class Commands {
 public:
  /// `can`: HelloMode bits that this build supports. `modes`: those in force from the start.
  Commands(std::uint8_t can, std::uint8_t modes) : can_(can), modes_(modes) {}

  void push(std::uint8_t byte);

  std::uint8_t modes() const { return modes_; }
  /// A Hello was requested; reported once.
  bool take_identify();
  enum class Restart : std::uint8_t { kNone, kProgram, kLoader };
  /// True once its Ack was sent.
  Restart restart() const { return answers_.empty() ? restart_ : Restart::kNone; }

  bool has_answer() const { return !answers_.empty(); }
  Reply take_answer() { return answers_.pop(); }

  std::uint32_t executed() const { return executed_; }
  std::uint32_t refused() const { return refused_; }
  /// Frames of the host that did not arrive whole.
  std::uint32_t damaged() const;

 private:
  void execute(const wire::Command& command, Reply answer);
  void refuse(Reply answer, wire::NakReason reason);

  static constexpr std::size_t kAnswers = 4;  // a host waits for each; more at once are refused and counted

  wire::FrameDecoder frames_;
  RingBuffer<Reply, kAnswers> answers_;
  std::uint8_t can_;
  std::uint8_t modes_;
  bool identify_ = false;
  Restart restart_ = Restart::kNone;
  std::uint32_t executed_ = 0;
  std::uint32_t refused_ = 0;
};

}  // namespace pharos::app
