// SPDX-License-Identifier: Apache-2.0
// Any bytes on the loader's line, and any frames: it never writes the slot of the valid image, which starts afterwards.
// First byte of the input: bytes (0) or frames.
#include <algorithm>
#include <cstdint>
#include <span>

#include "support/require.hpp"
#include "unit/boot/host.hpp"

namespace {

using pharos::test::require;
using namespace pharos;
using namespace pharos::boot::test;
using Input = std::span<const std::uint8_t>;

const Bytes& good_image() {
  static const Bytes image = make_image(1, {.body_bytes = 64});
  return image;
}

/// A clock that is not part of the test.
void set_fast_flash(VirtualTarget& target) {
  target.turn_ticks = boot::kTicksPerSecond / 1000;
  target.machine.byte_ticks = 1;
  target.machine.uart_holds = 1 << 16;
}

/// Flash with that image in the last slot, which the loader takes first.
const std::vector<std::uint8_t>& flash_with_image() {
  static const std::vector<std::uint8_t> bytes = [] {
    VirtualTarget target;
    set_fast_flash(target);
    Host host(target);
    start_with(target, host, good_image());
    return target.machine.flash.bytes;
  }();
  return bytes;
}

/// One frame: type, length, payload.
Input take_frame(Input input, wire::FrameEncoder& encoder, Machine& machine) {
  const auto type = static_cast<wire::MessageType>(0x40 + input[0] % 8);
  const std::size_t size = std::min<std::size_t>(input[1], input.size() - 2);
  std::array<std::uint8_t, wire::kMaxLineFrame> line{};
  const std::size_t bytes = encoder.encode(type, input.subspan(2, size), line);
  machine.host_sends(std::span(line).first(bytes));
  return input.subspan(2 + size);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Input input(data + 1, size - 1);
  VirtualTarget target;
  set_fast_flash(target);
  target.machine.flash.bytes = flash_with_image();
  target.power_on();
  boot::announce_reset(target.machine.retained, wire::ResetCause::kCommand, true);
  target.reset();
  wire::FrameEncoder encoder;
  if (data[0] == 0) {
    target.machine.host_sends(input);
  } else {
    while (input.size() >= 2) input = take_frame(input, encoder, target.machine);
  }
  target.run(boot::kTicksPerSecond / 5);
  const auto& before = flash_with_image();
  const std::uint32_t good = ModelBoard::slot_offset(boot_image::kSlots - 1);
  require(std::equal(before.begin() + good, before.begin() + good + ModelBoard::kSlotBytes,
                     target.machine.flash.bytes.begin() + good));
  target.power_off();
  target.power_on();
  target.run(boot::kTicksPerSecond / 2);
  require(target.runs_application());
  const Bytes body = body_of(good_image());
  require(std::equal(body.begin(), body.end(), target.machine.memory.begin()));
  return 0;
}
