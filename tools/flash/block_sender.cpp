// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/block_sender.hpp"

#include <algorithm>
#include <string>

#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/loader_messages.hpp"

namespace pharos::tools {

void BlockSender::fill_window() {
  const std::uint32_t window = static_cast<std::uint32_t>(wire::kLoaderWindow) * block_bytes_;
  while (next_ < image_.size() && next_ < arrived_ + window) {
    const std::size_t bytes = std::min<std::size_t>(block_bytes_, image_.size() - next_);
    wire::LoaderData block;
    block.offset = next_;
    for (const std::uint8_t byte : image_.subspan(next_, bytes)) block.data.push_back(byte);
    const std::uint16_t sequence = session_.send(block);
    if (!first_since_back_) first_since_back_ = sequence;
    next_ += static_cast<std::uint32_t>(bytes);
    ++blocks_sent_;
  }
}

void BlockSender::go_back(std::uint32_t offset) {
  arrived_ = next_ = offset;
  first_since_back_.reset();
}

void BlockSender::refused(const NumberedReply& response) {
  const std::uint32_t value = response.reply.value;
  switch (*response.reply.refusal) {
    case wire::NakReason::kOutOfOrder: {
      if (value == wire::kNothingBegun) throw TransferLost("the target was reset");
      // After a lost block all later blocks are refused: go back to the lost one.
      const bool current =
          first_since_back_ && static_cast<std::int16_t>(response.for_sequence - *first_since_back_) >= 0;
      if (current && value <= image_.size()) go_back(value);
      return;
    }
    case wire::NakReason::kUnsupported:
      throw TransferLost("the target was reset and runs its program");
    case wire::NakReason::kWriteFailed:
      throw FlashError("the target's flash cannot be written at byte " + std::to_string(value) +
                       "; what ran before is still there");
    default:
      throw FlashError(
          "the target refuses the image: it cannot run there (wrong load address?); what ran before is "
          "still there");
  }
}

void BlockSender::take(const wire::Frame& frame) {
  if (frame.type == wire::MessageType::kHello) {
    const auto hello = wire::decode_payload<wire::Hello>(frame.payload);
    if (hello && hello->role != wire::Role::kLoader) throw TransferLost("the target was reset and runs its program");
    return;
  }
  const auto response = as_reply(frame);
  if (!response || response->for_type != static_cast<std::uint8_t>(wire::MessageType::kLoaderData)) return;
  if (response->reply.refusal) {
    refused(*response);
  } else if (response->reply.value > arrived_ && response->reply.value <= image_.size()) {
    arrived_ = response->reply.value;
    next_ = std::max(next_, arrived_);
  }
}

void BlockSender::send_from(std::uint32_t offset, const std::function<void(std::size_t)>& progress) {
  go_back(offset);
  int timeouts = 0;
  std::int64_t deadline = session_.now_ns() + timeout_ns_;
  while (arrived_ < image_.size()) {
    fill_window();
    const std::uint32_t before = arrived_;
    const auto frame = session_.receive(deadline);
    if (frame) take(*frame);
    if (arrived_ > before) {
      timeouts = 0;
      deadline = session_.now_ns() + timeout_ns_;
      progress(arrived_);
    } else if (!frame) {
      if (++timeouts == kMaxTimeouts) {
        throw FlashError("the target fell silent at byte " + std::to_string(arrived_) + " of " +
                         std::to_string(image_.size()) + "; what ran before is still there: run this again");
      }
      session_.end_partial_frame();
      go_back(arrived_);
      deadline = session_.now_ns() + timeout_ns_;
    }
  }
}

}  // namespace pharos::tools
