// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/flasher.hpp"

#include <string>

#include "host/support/input_error.hpp"
#include "pharos/wire/crc32.hpp"
#include "tools/flash/block_sender.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kMs = 1'000'000;
/// Interval of requests to a target that does not respond: shorter than the loader's window of 200 ms after a reset.
constexpr std::int64_t kCall_ns = 80 * kMs;
constexpr std::int64_t kHint_ns = 2000 * kMs;
constexpr std::int64_t kReplyTimeout_ns = 500 * kMs;
constexpr int kAttempts = 10;
/// A sector of serial flash takes up to 3 s, an image up to four of them.
constexpr std::int64_t kErase_ns = 2000 * kMs;
constexpr int kEraseAttempts = 15;
constexpr std::int64_t kVerify_ns = 5000 * kMs;
constexpr int kVerifyAttempts = 3;
/// From the loader's window to the program's first frames.
constexpr std::int64_t kStart_ns = 10'000 * kMs;
/// Restarts of the whole transfer after a reset of the target.
constexpr int kBeginnings = 4;

boot_image::Version version_of(const wire::Hello& hello) {
  return {hello.firmware_major, hello.firmware_minor, hello.firmware_patch};
}

/// A loader without an image reports 0.0.0.
bool has_image(const wire::Hello& hello) {
  return hello.role != wire::Role::kLoader || version_of(hello) != boot_image::Version{0, 0, 0};
}

/// Why the target does not accept an image that arrived whole; empty: another reason.
std::string refusal_text(const Reply& reply) {
  if (!reply.refusal) return {};
  switch (*reply.refusal) {
    case wire::NakReason::kNotSigned:
      return "the image is not signed, and the target's development jumper is not set; sign it (make_image.py --key) "
             "or set the jumper";
    case wire::NakReason::kBadSignature:
      return "the image's signature is not of the key that the target was built with: another key, or a changed image";
    case wire::NakReason::kTooOld:
      return "the image is older than " +
             to_text({static_cast<std::uint8_t>(reply.value >> 16), static_cast<std::uint8_t>(reply.value >> 8),
                      static_cast<std::uint8_t>(reply.value)}) +
             ", the oldest version that this target still accepts";
    case wire::NakReason::kNoVerifier:
      return "the target's verifier of signatures is missing or damaged; write verifier.bin with a programmer";
    default:
      return {};
  }
}

}  // namespace

Flasher::Flasher(FlashLine& line, const FlashReports& reports, const FlashOptions& options)
    : session_(line), reports_(reports), options_(options) {}

bool Flasher::probe(Peer& peer) {
  session_.end_partial_frame();
  session_.send(wire::LoaderQuery{});
  session_.send(wire::Command{wire::CommandCode::kIdentify, 0});
  const std::int64_t deadline = session_.now_ns() + kCall_ns;
  while (const auto frame = session_.receive(deadline)) {
    if (frame->type == wire::MessageType::kHello) {
      const auto hello = wire::decode_payload<wire::Hello>(frame->payload);
      if (hello) peer.hello = *hello;
    } else if (frame->type == wire::MessageType::kLoaderInfo) {
      const auto info = wire::decode_payload<wire::LoaderInfo>(frame->payload);
      if (info) peer.loader = *info;
    }
    if (peer.loader) return true;
  }
  return peer.hello && peer.hello->role != wire::Role::kLoader;
}

void Flasher::no_reply_text() {
  if (const auto version = session_.unsupported_version()) {
    throw FlashError("the target speaks version " + std::to_string(*version) +
                     " of the protocol, this pharos version " + std::to_string(wire::kProtocolVersion) +
                     "; use the pharos that came with it");
  }
  if (session_.counters().frames == 0 && session_.counters().garbage_bytes > 0) {
    throw FlashError("bytes come, but no frame among them; is " + std::to_string(options_.baud) +
                     " baud the speed of the line (--baud)?");
  }
  throw FlashError("no answer from the target; check power, cable and --baud, and switch it on while this waits");
}

Flasher::Peer Flasher::find(std::int64_t wait_ns) {
  session_.forget_received();
  const std::int64_t start = session_.now_ns();
  bool hinted = false;
  Peer peer;
  while (!probe(peer)) {
    const std::int64_t waited = session_.now_ns() - start;
    if (waited > wait_ns) no_reply_text();
    if (!hinted && waited > kHint_ns) {
      hinted = true;
      reports_.note("no answer yet; switch the target off and on again");
      session_.skip_numbers();
    }
  }
  return peer;
}

Flasher::Peer Flasher::enter_loader(const Peer& program) {
  if (program.hello->role == wire::Role::kSimulator) {
    throw FlashError("at the other end is a simulator: nothing can be flashed there");
  }
  const auto reply = session_.request(wire::Command{wire::CommandCode::kEnterLoader, 0}, kReplyTimeout_ns, kAttempts);
  if (reply && reply->refusal) {
    throw FlashError(
        "the program that runs does not start the loader; switch the target off, run this, and switch it on");
  }
  const std::int64_t deadline = session_.now_ns() + kStart_ns;
  while (session_.now_ns() < deadline) {
    Peer peer;
    if (probe(peer) && peer.loader) {
      if (!peer.hello) peer.hello = program.hello;
      return peer;
    }
  }
  throw FlashError("the target does not start its loader; switch it off and on while this runs again");
}

void Flasher::check(const BootImageFile& image, const Peer& peer) {
  const boot_image::BootImageHeader& header = image.header;
  const std::string_view board = peer.loader ? peer.loader->board.view() : peer.hello->board.view();
  if (board != view(header.board)) {
    throw host::InputError("the image is for the board '" + std::string(view(header.board)) + "', the target is a '" +
                           std::string(board) + "'; take the image for that");
  }
  if (peer.loader && image.bytes.size() > peer.loader->capacity_bytes) {
    throw host::InputError("the image has " + std::to_string(image.bytes.size()) + " bytes, the target's slot holds " +
                           std::to_string(peer.loader->capacity_bytes));
  }
  if (older_allowed_ || !peer.hello || !has_image(*peer.hello)) return;
  const boot_image::Version running = version_of(*peer.hello);
  if (header.version < running && !reports_.allow_older(running)) {
    throw FlashError("the image is version " + to_text(header.version) + ", older than " + to_text(running) +
                     " that is there; --allow-older writes it all the same");
  }
  older_allowed_ = true;
}

std::uint32_t Flasher::begin(const BootImageFile& image) {
  wire::LoaderBegin request;
  request.image_bytes = static_cast<std::uint32_t>(image.bytes.size());
  request.image_crc32 = wire::crc32(image.bytes);
  request.board.characters = image.header.board;
  const auto reply = session_.request(request, kErase_ns, kEraseAttempts);
  if (!reply)
    throw FlashError("the target does not answer while it erases; what ran before is still there: run this again");
  if (reply->refusal == wire::NakReason::kUnsupported) throw TransferLost("the target was reset and runs its program");
  if (reply->refusal == wire::NakReason::kWriteFailed) {
    throw FlashError("the target's flash cannot be erased; what ran before is still there");
  }
  if (reply->refusal)
    throw FlashError("the target refuses the image (reason " + std::to_string(static_cast<int>(*reply->refusal)) + ")");
  return reply->value;
}

void Flasher::verify(const BootImageFile& image) {
  const auto reply = session_.request(wire::LoaderVerify{}, kVerify_ns, kVerifyAttempts);
  if (!reply)
    throw FlashError("the target does not answer while it verifies; what ran before is still there: run this again");
  if (!reply->refusal && reply->value == wire::crc32(image.bytes)) return;
  if (reply->refusal == wire::NakReason::kWriteFailed) {
    throw FlashError("the target's flash cannot be written; what ran before is still there");
  }
  if (const std::string text = refusal_text(*reply); !text.empty()) {
    (void)session_.request(wire::LoaderStart{}, kReplyTimeout_ns, kAttempts);  // of what was there before
    throw FlashError(text + "; what ran before is still there");
  }
  if (reply->refusal == wire::NakReason::kBadPayload)
    throw FlashError("the target refuses the image; what ran before is still there");
  throw TransferLost("what the target's flash gives back is not what was sent");
}

void Flasher::start() {
  const auto reply = session_.request(wire::LoaderStart{}, kReplyTimeout_ns, kAttempts);
  if (reply && reply->refusal && *reply->refusal != wire::NakReason::kUnsupported) {
    throw FlashError("the target does not start what was written; run this again");
  }
  // No response, or a program that does not know the request: the Ack was lost and the program already runs.
}

wire::Hello Flasher::await_program(const boot_image::BootImageHeader& header) {
  const std::int64_t deadline = session_.now_ns() + kStart_ns;
  while (const auto frame = session_.receive(deadline)) {
    if (frame->type != wire::MessageType::kHello) continue;
    const auto hello = wire::decode_payload<wire::Hello>(frame->payload);
    if (!hello) continue;
    if (hello->role == wire::Role::kLoader) {
      throw FlashError("the image was written and verified, but the target's loader does not start it");
    }
    if (version_of(*hello) != header.version) {
      throw FlashError("the image was written and verified, but what runs says that it is version " +
                       to_text(version_of(*hello)) + " and not " + to_text(header.version));
    }
    return *hello;
  }
  throw FlashError(
      "the image was written and verified, but nothing that it runs says Hello; to go back, flash another one: run "
      "this and switch the target off and on");
}

void Flasher::transfer(const BootImageFile& image, const wire::LoaderInfo& loader, FlashResult& result) {
  const std::uint32_t offset = begin(image);
  if (offset > 0) reports_.note("going on at byte " + std::to_string(offset) + ", where it was broken off");
  const std::int64_t window_bytes =
      static_cast<std::int64_t>(wire::kLoaderWindow * wire::line_size(wire::LoaderData::kMaxBytes));
  BlockSender blocks(session_, image.bytes, loader.block_bytes, window_bytes * 10'000 * kMs / options_.baud);
  const std::int64_t first = session_.now_ns();
  blocks.send_from(offset, reports_.progress);
  result.line_ns = session_.now_ns() - first;
  result.blocks_sent = blocks.blocks_sent();
  result.slot_offset = loader.slot_offset;
  verify(image);
}

FlashResult Flasher::flash(const BootImageFile& image) {
  FlashResult result;
  for (int beginning = 1;; ++beginning) {
    Peer peer = find(options_.wait_ns);
    if (!result.before && peer.hello && has_image(*peer.hello)) result.before = version_of(*peer.hello);
    check(image, peer);
    if (!peer.loader) peer = enter_loader(peer);
    try {
      check(image, peer);
      transfer(image, *peer.loader, result);
      break;
    } catch (const TransferLost& lost) {
      if (beginning == kBeginnings) {
        throw FlashError(std::string(lost.what()) + ", again and again; what ran before is still there");
      }
      reports_.note(std::string(lost.what()) + "; beginning anew");
    } catch (const host::InputError&) {
      start();  // nothing is written: start the present image
      throw;
    }
  }
  start();
  result.running = await_program(image.header);
  return result;
}

}  // namespace pharos::tools
