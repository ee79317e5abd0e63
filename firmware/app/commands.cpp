// SPDX-License-Identifier: Apache-2.0
#include "firmware/app/commands.hpp"

#include "pharos/wire/codec.hpp"
#include "pharos/wire/hello_message.hpp"

namespace pharos::app {

void Commands::push(std::uint8_t byte) {
  const auto frame = frames_.push(byte);
  if (!frame) return;
  if (answers_.full()) {
    ++refused_;
    return;
  }
  const Reply answer{static_cast<std::uint8_t>(frame->type), frame->sequence, std::nullopt, 0};
  if (frame->type != wire::MessageType::kCommand) {
    refuse(answer, wire::NakReason::kUnsupported);
    return;
  }
  const auto command = wire::decode_payload<wire::Command>(frame->payload);
  if (command) {
    execute(*command, answer);
  } else {
    refuse(answer, wire::NakReason::kBadPayload);
  }
}

void Commands::execute(const wire::Command& command, Reply answer) {
  switch (command.code) {
    case wire::CommandCode::kIdentify:
      identify_ = true;
      break;
    case wire::CommandCode::kSetModes:
      modes_ = static_cast<std::uint8_t>(command.value & can_);
      answer.value = modes_;
      break;
    case wire::CommandCode::kReset:
      restart_ = Restart::kProgram;
      break;
    case wire::CommandCode::kEnterLoader:
      restart_ = Restart::kLoader;
      break;
    default:
      refuse(answer, wire::NakReason::kUnsupported);
      return;
  }
  ++executed_;
  answers_.push(answer);
}

void Commands::refuse(Reply answer, wire::NakReason reason) {
  ++refused_;
  answer.refused = reason;
  answers_.push(answer);
}

bool Commands::take_identify() {
  const bool asked = identify_;
  identify_ = false;
  return asked;
}

std::uint32_t Commands::damaged() const {
  const wire::LinkCounters& counters = frames_.counters();
  return static_cast<std::uint32_t>(counters.bad_crc + counters.bad_stuffing + counters.too_short + counters.too_long);
}

}  // namespace pharos::app
