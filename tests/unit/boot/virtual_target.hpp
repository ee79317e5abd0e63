// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "firmware/boot/loader.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "unit/boot/images.hpp"
#include "unit/boot/model_board.hpp"

namespace pharos::boot::test {

/// A target that can be switched on and off: the real loader on a model board, and a substitute application that sends
/// Hello, responds to commands and sends frames ten times a second.
class VirtualTarget {
 public:
  Machine machine;
  /// Off: bytes from the host are lost.
  bool powered = false;
  /// The application neither receives nor sends any more.
  bool hangs = false;
  /// Images of this version neither receive nor send; -1: none.
  int silent_patch = -1;
  /// Duration of an iteration of the target's main loop; a longer one makes the test faster.
  std::int64_t turn_ticks = 250;

  void power_on() {
    machine.retained = {};  // content after a power loss; zeros are not a valid mark
    machine.flash.steps_left = UINT64_MAX;
    powered = true;
    reset();
  }
  void power_off() {
    powered = false;
    loader_.reset();
    application_.reset();
    machine.to_target.clear();
  }
  /// A reset by the watchdog.
  void reset() {
    ModelBoard::machine = &machine;
    application_.reset();
    note_reset(machine.retained);
    loader_ = std::make_unique<Loader<ModelBoard>>();
    loader_->prepare(take_loader_request(machine.retained));
  }

  bool runs_application() const { return application_ != nullptr; }
  /// Header of the running image.
  const boot_image::BootImageHeader& running() const { return application_->header; }
  const boot_image::BootImageHeader* loaded() const { return loader_ ? loader_->loaded() : nullptr; }

  /// One iteration of the target's main loop.
  void step() {
    ModelBoard::machine = &machine;
    machine.now += turn_ticks;
    if (!powered) {
      machine.to_target.clear();
      return;
    }
    try {
      application_ ? step_application() : step_loader();
    } catch (const PowerCut&) {
      power_off();
    }
  }
  void run(std::int64_t ticks) {
    for (const std::int64_t end = machine.now + ticks; machine.now < end;) step();
  }

 private:
  struct Application {
    boot_image::BootImageHeader header;
    wire::FrameDecoder frames;
    wire::FrameEncoder encoder;
    std::int64_t last_hello = INT64_MIN / 2;
    std::int64_t last_time = INT64_MIN / 2;
    bool restart = false;
  };

  void step_loader() {
    const Turn turn = loader_->turn();
    if (turn == Turn::kStart) {
      note_start(machine.retained);
      application_ = std::make_unique<Application>();
      application_->header = *loader_->loaded();
      loader_.reset();
    } else if (turn == Turn::kRestart) {
      reset_boot_attempts(machine.retained);
      announce_reset(machine.retained, wire::ResetCause::kCommand);
      reset();
    }
  }

  template <class M>
  void say(const M& message) {
    std::array<std::uint8_t, M::kMaxBytes> payload{};
    std::array<std::uint8_t, wire::kMaxLineFrame> line{};
    const std::size_t size = wire::encode_payload(message, payload);
    const std::size_t bytes = application_->encoder.encode(M::kType, std::span(payload).first(size), line);
    for (const std::uint8_t byte : std::span(line).first(bytes)) {
      while (!machine.transmit(byte)) machine.now += machine.byte_ticks;
    }
  }
  void send_hello() {
    wire::Hello hello;
    hello.reset_cause = last_reset(machine.retained);
    hello.firmware_major = application_->header.version.major;
    hello.firmware_minor = application_->header.version.minor;
    hello.firmware_patch = application_->header.version.patch;
    hello.board.characters = application_->header.board;
    say(hello);
  }

  void step_application() {
    Application& app = *application_;
    if (hangs || app.header.version.patch == silent_patch) {
      (void)machine.receive();
      return;
    }
    if (machine.now - app.last_hello >= kTicksPerSecond) {
      app.last_hello = machine.now;
      send_hello();
    }
    if (machine.now - app.last_time >= kTicksPerSecond / 10) {
      app.last_time = machine.now;
      say(wire::Time{machine.now});
      confirm_start(machine.retained);
    }
    for (int byte = machine.receive(); byte >= 0; byte = machine.receive()) {
      if (const auto frame = app.frames.push(static_cast<std::uint8_t>(byte))) execute(*frame);
      if (!application_) return;
    }
  }
  void execute(const wire::Frame& frame) {
    const auto type = static_cast<std::uint8_t>(frame.type);
    const auto command = wire::decode_payload<wire::Command>(frame.payload);
    if (frame.type != wire::MessageType::kCommand || !command) {
      say(wire::Nak{type, frame.sequence, wire::NakReason::kUnsupported, 0});
      return;
    }
    say(wire::Ack{type, frame.sequence, 0});
    if (command->code == wire::CommandCode::kIdentify) send_hello();
    if (command->code == wire::CommandCode::kEnterLoader) {
      announce_reset(machine.retained, wire::ResetCause::kCommand, true);
      reset();
    }
  }

  std::unique_ptr<Loader<ModelBoard>> loader_;
  std::unique_ptr<Application> application_;
};

}  // namespace pharos::boot::test
