// SPDX-License-Identifier: Apache-2.0
// The serial protocol with any bytes. First byte of the input: the use of the others.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/report/convert.hpp"
#include "pharos/report/link_decoder.hpp"
#include "support/require.hpp"
#include "unit/wire/random_messages.hpp"

namespace {

using pharos::test::require;
using namespace pharos::wire;
using Input = std::span<const std::uint8_t>;

/// A decoded message must encode to the same bytes.
template <class M>
void check_payload(Input payload) {
  const auto message = decode_payload<M>(payload);
  if (!message) return;
  std::array<std::uint8_t, kMaxPayload> again{};
  const std::size_t size = encode_payload(*message, again);
  require(size == payload.size() && std::equal(payload.begin(), payload.end(), again.begin()));
}

/// Any bytes as a stream: no crash, consistent counters, and a good frame afterwards is always decoded.
void check_stream(Input bytes) {
  pharos::report::LinkDecoder link;
  FrameDecoder frames;
  for (const std::uint8_t byte : bytes) {
    if (const auto event = link.push(byte)) (void)pharos::report::newest_ticks(*event);
    if (const auto frame = frames.push(byte)) {
      test::visit_type(frame->type, [&](auto example) { check_payload<decltype(example)>(frame->payload); });
    }
  }
  require(frames.counters().bytes == bytes.size());
  require(frames.counters().garbage_bytes <= bytes.size());
  FrameEncoder encoder;
  std::array<std::uint8_t, kMaxLineFrame> line{};
  const std::array<std::uint8_t, 76> hello{};
  const std::size_t size = encoder.encode(MessageType::kHello, hello, line);
  const std::uint64_t repeated = frames.counters().repeated;
  bool came = false;
  for (const std::uint8_t byte : std::span(line).first(size)) came = frames.push(byte).has_value();
  require(came || frames.counters().repeated > repeated);
}

/// Any bytes as the payload of a frame: the decoded payload must be equal.
void check_frame(std::uint8_t type, Input payload) {
  FrameEncoder encoder;
  std::array<std::uint8_t, kMaxLineFrame> line{};
  const std::size_t size = encoder.encode(static_cast<MessageType>(type), payload, line);
  require((size > 0) == (payload.size() <= kMaxPayload));
  FrameDecoder decoder;
  bool came = false;
  for (const std::uint8_t byte : std::span(line).first(size)) {
    if (const auto frame = decoder.push(byte)) {
      came = std::equal(payload.begin(), payload.end(), frame->payload.begin(), frame->payload.end());
    }
  }
  require(came == (size > 0 && is_known(static_cast<MessageType>(type))));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input(data, size);
  if (input.empty()) return 0;
  const std::uint8_t use = input.front();
  const Input rest = input.subspan(1);
  if (use == 0) {
    check_stream(input);
  } else {
    check_frame(use, rest);
    test::visit_type(static_cast<MessageType>(use), [&](auto example) { check_payload<decltype(example)>(rest); });
  }
  return 0;
}
