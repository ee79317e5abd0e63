// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "tools/flash/flash_session.hpp"

namespace pharos::tools {

/// The target fell out of the transfer: it was reset, or what it holds is not what was sent. Begin anew.
class TransferLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sends an image in blocks, kLoaderWindow of them ahead of the answers; goes back to the offset that the loader asks
/// for when one got lost.
class BlockSender {
 public:
  /// `line_time_ns`: what a full window takes on the line.
  BlockSender(FlashSession& session, std::span<const std::uint8_t> image, std::uint32_t block_bytes,
              std::int64_t line_time_ns)
      : session_(session), image_(image), block_bytes_(block_bytes), timeout_ns_(kReplyTimeout_ns + 2 * line_time_ns) {}

  /// From `offset` to the end; `progress` is told the bytes that have arrived. Throws FlashError when the target falls
  /// silent or refuses, TransferLost when all must begin anew.
  void send_from(std::uint32_t offset, const std::function<void(std::size_t)>& progress);

  std::uint64_t blocks_sent() const { return blocks_sent_; }

 private:
  /// For the target to write a page and for an adapter to hand on what came.
  static constexpr std::int64_t kReplyTimeout_ns = 300'000'000;
  /// Times in a row that the answer to the same block fails to come.
  static constexpr int kMaxTimeouts = 20;

  void fill_window();
  void take(const wire::Frame& frame);
  void refused(const NumberedReply& answer);
  void go_back(std::uint32_t offset);

  FlashSession& session_;
  std::span<const std::uint8_t> image_;
  std::uint32_t block_bytes_;
  std::int64_t timeout_ns_;
  std::uint32_t arrived_ = 0;                      // all before it
  std::uint32_t next_ = 0;                         // to be sent
  std::optional<std::uint16_t> first_since_back_;  // answers to frames before it are of blocks sent again
  std::uint64_t blocks_sent_ = 0;
};

}  // namespace pharos::tools
