// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "tools/flash/flash_session.hpp"

namespace pharos::tools {

/// The target left the transfer: it was reset, or its data differ from those sent. The transfer must begin again.
class TransferLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sends an image in blocks, up to kLoaderWindow of them unacknowledged (go-back-N); after a lost block it continues at
/// the offset that the loader requests.
class BlockSender {
 public:
  /// `line_time_ns`: transmission time of a full window.
  BlockSender(FlashSession& session, std::span<const std::uint8_t> image, std::uint32_t block_bytes,
              std::int64_t line_time_ns)
      : session_(session), image_(image), block_bytes_(block_bytes), timeout_ns_(kReplyTimeout_ns + 2 * line_time_ns) {}

  /// From `offset` to the end; calls `progress` with the bytes acknowledged. Throws FlashError when the target does not
  /// respond or refuses, TransferLost when the transfer must begin again.
  void send_from(std::uint32_t offset, const std::function<void(std::size_t)>& progress);

  std::uint64_t blocks_sent() const { return blocks_sent_; }

 private:
  /// Time for the target to write a page and for an adapter to forward received bytes.
  static constexpr std::int64_t kReplyTimeout_ns = 300'000'000;
  /// Consecutive timeouts of the response to the same block.
  static constexpr int kMaxTimeouts = 20;

  void fill_window();
  void take(const wire::Frame& frame);
  void refused(const NumberedReply& response);
  void go_back(std::uint32_t offset);

  FlashSession& session_;
  std::span<const std::uint8_t> image_;
  std::uint32_t block_bytes_;
  std::int64_t timeout_ns_;
  std::uint32_t arrived_ = 0;  // all bytes before it are acknowledged
  std::uint32_t next_ = 0;     // next to be sent
  std::optional<std::uint16_t>
      first_since_back_;  // responses to earlier frames refer to blocks sent before the retransmission
  std::uint64_t blocks_sent_ = 0;
};

}  // namespace pharos::tools
