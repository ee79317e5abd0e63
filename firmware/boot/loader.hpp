// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/loader_line.hpp"
#include "firmware/boot/payloads.hpp"
#include "firmware/boot/slots.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::boot {

inline constexpr std::uint16_t kLoaderVersion = 1;
/// Time after every reset in which the loader accepts a LoaderQuery: lets a host in where the image itself does not
/// respond.
inline constexpr std::uint32_t kWindow_ticks = kTicksPerSecond / 5;
/// Silence after which the loader starts its image: a host that disconnects must not leave the target waiting for ever.
/// Less than the 85.9 s of the tick counter.
inline constexpr std::uint32_t kTimeout_ticks = 60 * kTicksPerSecond;

/// Next action of the loader after one pass.
enum class Turn : std::uint8_t { kAgain, kStart, kRestart };

/// The loader's side of proto/README.md, "Loader": takes an image into the slot that does not hold the good one.
///
/// Order of writes: erase, body, header with mark. The good slot is never written, so power may fail at any moment.
template <BootBoard Board>
class Loader {
 public:
  /// Finds the image to be started and copies it to its load address; once, before all else. `stay`: the loader was
  /// requested.
  void prepare(bool stay);
  /// The image that was found; null when there is none.
  const boot_image::BootImageHeader* loaded() const { return slots_.loaded(); }
  /// Does all pending work. kStart: run loaded(). kRestart: restart by a reset.
  Turn turn();

 private:
  /// Content of the reply: reason 0 is Ack.
  struct Reply {
    std::uint32_t reason;
    std::uint32_t value;
  };
  static Reply done(std::uint32_t value) { return {0, value}; }
  static Reply refused(wire::NakReason reason, std::uint32_t value = 0) {
    return {static_cast<std::uint32_t>(reason), value};
  }
  /// The image as sent does not fit this slot: the next begin starts from the beginning.
  Reply give_up(wire::NakReason reason, std::uint32_t value = 0) {
    image_bytes_ = 0;
    return refused(reason, value);
  }

  Turn listen();
  Turn serve();
  /// Executes and answers the line's request. True: it requests a start.
  bool answer();
  Reply answer_to(const FrameReceiver& request);
  Reply begin(const BeginPayload& request);
  Reply take(std::uint32_t offset, std::span<const std::uint8_t> data);
  Reply verify();
  /// Signature and version; done(0): may be marked.
  Reply check_origin();
  bool write_head();
  void send_hello();
  void send_info();

  bool is_receiving() const { return image_bytes_ != 0; }
  /// Called by the flash while it works.
  auto taking_bytes() {
    return [this] { line_.take_bytes(); };
  }
  std::uint32_t slot_offset() const { return Board::slot_offset(slots_.spare()); }

  HelloPayload hello_{};
  Slots<Board> slots_;
  LoaderLine<Board> line_;
  std::uint32_t last_frame_ = 0;  // ticks; before the first frame, of the start
  std::uint32_t last_hello_ = 0;
  bool serving_ = false;           // no longer waiting for a query
  std::uint32_t image_bytes_ = 0;  // 0: nothing begun
  std::uint32_t image_crc32_ = 0;
  std::uint32_t expected_ = 0;  // offset
  bool verified_ = false;
  /// The image's first page, written last, with the mark in it.
  union {
    std::array<std::uint8_t, boot_image::kPageBytes> page_{};
    boot_image::SlotHead head_;
  };
};

template <BootBoard Board>
void Loader<Board>::prepare(bool stay) {
  slots_.find(boot_attempts_exhausted(Board::retained()));
  if (take_confirmation(Board::retained())) slots_.raise_floor(taking_bytes());
  hello_.role = wire::Role::kLoader;
  hello_.reset_cause = static_cast<std::uint8_t>(Board::retained().last_cause);
  hello_.start_count = static_cast<std::uint16_t>(Board::retained().start_count);
  hello_.tick_rate_hz = kTicksPerSecond;
  hello_.board = Board::kName;
  if (loaded() != nullptr) hello_.firmware = loaded()->version;
  serving_ = stay || loaded() == nullptr;
  last_frame_ = Board::ticks();
  last_hello_ = last_frame_ - kTicksPerSecond;
}

template <BootBoard Board>
Turn Loader<Board>::turn() {
  return serving_ ? serve() : listen();
}

template <BootBoard Board>
Turn Loader<Board>::listen() {
  if (line_.next_frame() && line_.request().type() == wire::MessageType::kLoaderQuery) serving_ = true;
  return Board::ticks() - last_frame_ < kWindow_ticks || serving_ ? Turn::kAgain : Turn::kStart;
}

template <BootBoard Board>
Turn Loader<Board>::serve() {
  const std::uint32_t now = Board::ticks();
  if (!is_receiving() && now - last_hello_ >= kTicksPerSecond) {
    last_hello_ = now;
    send_hello();
  }
  if (line_.next_frame()) {
    last_frame_ = now;
    if (answer()) return Turn::kRestart;
  }
  return loaded() != nullptr && now - last_frame_ >= kTimeout_ticks ? Turn::kRestart : Turn::kAgain;
}

template <BootBoard Board>
void Loader<Board>::send_hello() {
  hello_.time_ticks = Board::ticks();
  line_.send(wire::MessageType::kHello, bytes_of(hello_));
}

template <BootBoard Board>
void Loader<Board>::send_info() {
  InfoPayload info;
  info.loader_version = kLoaderVersion;
  info.block_bytes = boot_image::kPageBytes;
  info.slot_offset = slot_offset();
  info.capacity_bytes = Board::kSlotBytes;
  info.board = hello_.board;
  line_.send(wire::MessageType::kLoaderInfo, bytes_of(info));
}

template <BootBoard Board>
bool Loader<Board>::answer() {
  const FrameReceiver& request = line_.request();
  const wire::MessageType type = request.type();
  if (type == wire::MessageType::kLoaderQuery) {
    send_hello();
    send_info();
    return false;
  }
  const Reply answer = answer_to(request);
  const bool good = answer.reason == 0;
  NakPayload payload;
  payload.for_type = static_cast<std::uint8_t>(type);
  std::memcpy(&payload.for_sequence, request.sequence(), sizeof payload.for_sequence);
  payload.reason = static_cast<std::uint8_t>(answer.reason);
  payload.value = answer.value;
  auto* bytes = reinterpret_cast<std::uint8_t*>(&payload);
  if (good) std::memcpy(bytes + offsetof(NakPayload, reason), &answer.value, sizeof answer.value);
  line_.send(good ? wire::MessageType::kAck : wire::MessageType::kNak, {bytes, sizeof payload - (good ? 1u : 0u)});
  return type == wire::MessageType::kLoaderStart && good;
}

template <BootBoard Board>
auto Loader<Board>::answer_to(const FrameReceiver& request) -> Reply {
  const std::uint8_t* payload = request.payload();
  const std::size_t size = request.payload_bytes();
  switch (request.type()) {
    case wire::MessageType::kLoaderBegin:
      if (size != sizeof(BeginPayload)) break;
      return begin(*reinterpret_cast<const BeginPayload*>(payload));
    case wire::MessageType::kLoaderData: {
      const auto& head = *reinterpret_cast<const DataHead*>(payload);
      if (size < sizeof head || size != sizeof head + head.bytes) break;
      return take(head.offset, {payload + sizeof head, head.bytes});
    }
    case wire::MessageType::kLoaderVerify:
      return verify();
    case wire::MessageType::kLoaderStart:
      if (verified_ || (loaded() != nullptr && !is_receiving())) return done(0);
      return refused(wire::NakReason::kNotVerified);
    default:
      return refused(wire::NakReason::kUnsupported);
  }
  return refused(wire::NakReason::kBadPayload);
}

template <BootBoard Board>
auto Loader<Board>::begin(const BeginPayload& request) -> Reply {
  if (!slots_.is_name(request.board)) return refused(wire::NakReason::kWrongBoard);
  if (request.image_bytes > Board::kSlotBytes) return refused(wire::NakReason::kTooLarge, Board::kSlotBytes);
  if (request.image_bytes <= boot_image::kPageBytes) return refused(wire::NakReason::kBadPayload);
  if (request.image_bytes == image_bytes_ && request.image_crc32 == image_crc32_) return done(expected_);
  verified_ = false;
  expected_ = 0;
  image_bytes_ = request.image_bytes;
  image_crc32_ = request.image_crc32;
  for (std::uint32_t offset = 0; offset < image_bytes_; offset += Board::Flash::kSectorBytes) {
    if (!Board::flash().erase_sector(slot_offset() + offset, taking_bytes())) {
      return give_up(wire::NakReason::kWriteFailed, offset);
    }
  }
  return done(0);
}

template <BootBoard Board>
auto Loader<Board>::take(std::uint32_t offset, std::span<const std::uint8_t> data) -> Reply {
  if (!is_receiving()) return refused(wire::NakReason::kOutOfOrder, wire::kNothingBegun);
  if (offset < expected_) return done(expected_);
  if (offset > expected_) return refused(wire::NakReason::kOutOfOrder, expected_);
  // Blocks are pages, the last one what is left.
  if (data.size() != std::min<std::uint32_t>(boot_image::kPageBytes, image_bytes_ - expected_)) {
    return refused(wire::NakReason::kBadPayload);
  }
  if (offset == 0) {
    std::memcpy(page_.data(), data.data(), page_.size());
    const bool good = boot_image::fault_of(head_.image.header) == boot_image::BootImageError::kNone &&
                      head_.image.header.body_bytes == image_bytes_ - boot_image::kPageBytes &&
                      slots_.fits(head_.image.header);
    if (!good) return give_up(wire::NakReason::kBadPayload);
  } else if (!Board::flash().program(slot_offset() + offset, data, taking_bytes())) {
    return give_up(wire::NakReason::kWriteFailed, offset);
  }
  expected_ += static_cast<std::uint32_t>(data.size());
  return done(expected_);
}

template <BootBoard Board>
auto Loader<Board>::verify() -> Reply {
  if (!is_receiving()) return refused(wire::NakReason::kOutOfOrder, wire::kNothingBegun);
  if (expected_ != image_bytes_) return refused(wire::NakReason::kOutOfOrder, expected_);
  if (verified_) return done(image_crc32_);
  // As at every start: the data read back from the flash is checked.
  const boot_image::BootImageHeader& header = head_.image.header;
  const bool good_body = slots_.load(slots_.spare(), head_.image);
  const std::span body(Board::memory(header.load_address, header.body_bytes), header.body_bytes);
  const std::uint32_t crc = wire::crc32(body, wire::crc32(page_));
  if (crc != image_crc32_) return give_up(wire::NakReason::kBadCrc, crc);
  if (!good_body) return give_up(wire::NakReason::kBadPayload);
  if (const Reply reply = check_origin(); reply.reason != 0) {
    image_bytes_ = 0;
    return reply;
  }
  if (!write_head()) return give_up(wire::NakReason::kWriteFailed);
  verified_ = true;
  return done(crc);
}

template <BootBoard Board>
[[gnu::noinline]] auto Loader<Board>::check_origin() -> Reply {
  const bool development = Board::development();
  if (!boot_image::is_signed(head_.image.seal)) return development ? done(0) : refused(wire::NakReason::kNotSigned);
  const std::uint32_t floor = VersionFloor<Board>::read();
  if (number_of(head_.image.header.version) < floor && !development) return refused(wire::NakReason::kTooOld, floor);
  const Verdict verdict = Board::verify(boot_image::signed_bytes_of(head_.image), head_.image.seal.signature.data());
  return {static_cast<std::uint32_t>(verdict), 0};
}

template <BootBoard Board>
bool Loader<Board>::write_head() {
  head_.mark = boot_image::make_mark(head_.image, slots_.next_sequence());
  return Board::flash().program(slot_offset(), std::span(page_).first(sizeof head_), taking_bytes()) &&
         slots_.read(slots_.spare(), head_) == slots_.next_sequence();
}

}  // namespace pharos::boot
