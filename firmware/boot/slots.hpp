// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/version_floor.hpp"
#include "pharos/boot_image/slot.hpp"
#include "pharos/signature/sha2.hpp"

namespace pharos::boot {

/// Content of a board's slots: known after find().
template <BootBoard Board>
class Slots {
 public:
  /// Reads the slots, and copies the newest whole image to its load address; `older`: the other one, if it is whole.
  void find(bool older) {
    for (std::size_t slot = 0; slot < boot_image::kSlots; ++slot) heads_[slot].mark.sequence = read(slot, heads_[slot]);
    const std::size_t newest = heads_[1].mark.sequence > heads_[0].mark.sequence ? 1 : 0;
    next_sequence_ = heads_[newest].mark.sequence + 1;
    const std::size_t first = older ? 1 - newest : newest;
    if (!take(first)) (void)take(1 - first);
  }

  /// The image that was copied to its load address; null when no slot holds a whole one.
  const boot_image::BootImageHeader* loaded() const { return loaded_; }
  /// After a start of the newest image that was confirmed: what is older than both is not written any more. Nothing
  /// where there is no fallback, or where one of the two is not signed.
  template <class Idle>
  void raise_floor(Idle&& idle) const {
    std::uint32_t oldest = UINT32_MAX;
    for (const boot_image::SlotHead& head : heads_) {
      if (head.mark.sequence == 0 || !boot_image::is_signed(head.image.seal)) return;
      oldest = std::min(oldest, number_of(head.image.header.version));
    }
    (void)VersionFloor<Board>::raise(oldest, idle);  // failed: the next start tries again
  }
  /// The slot that does not hold it.
  std::size_t spare() const { return spare_; }
  /// Greater than any in the slots.
  std::uint32_t next_sequence() const { return next_sequence_; }

  /// Whether 24 characters are this board's name.
  static bool is_name(const std::array<char, 24>& board) {
    return std::memcmp(board.data(), Board::kName.data(), board.size()) == 0;
  }
  /// Whether this board can hold and run the image of the header.
  static bool fits(const boot_image::BootImageHeader& header) {
    return is_name(header.board) && header.body_bytes <= Board::kSlotBytes - boot_image::kPageBytes &&
           Board::memory(header.load_address, header.body_bytes) != nullptr;
  }
  /// A slot's sequence number, 0 when it holds nothing that can run here.
  static std::uint32_t read(std::size_t slot, boot_image::SlotHead& head) {
    Board::flash().read(Board::slot_offset(slot), {reinterpret_cast<std::uint8_t*>(&head), sizeof head});
    // A marked signature was verified; an image without one starts only where the jumper still says so.
    const bool may_run = fits(head.image.header) && (boot_image::is_signed(head.image.seal) || Board::development());
    return may_run ? boot_image::sequence_of(head) : 0;
  }
  /// Copies the body to its load address and computes its SHA-256 there: the checked copy is the one that runs, even
  /// where the flash returns other bytes when read again.
  static bool load(std::size_t slot, const boot_image::SealedHeader& image) {
    const boot_image::BootImageHeader& header = image.header;
    const std::span body(Board::memory(header.load_address, header.body_bytes), header.body_bytes);
    Board::flash().read(Board::slot_offset(slot) + boot_image::kPageBytes, body);
    return signature::is_sha256(image.seal.body_sha256, body);
  }

 private:
  bool take(std::size_t slot) {
    const boot_image::SlotHead& head = heads_[slot];
    if (head.mark.sequence == 0 || !load(slot, head.image)) return false;
    loaded_ = &head.image.header;
    spare_ = 1 - slot;
    return true;
  }

  std::array<boot_image::SlotHead, boot_image::kSlots> heads_{};  // sequence 0: nothing that can run
  const boot_image::BootImageHeader* loaded_ = nullptr;
  std::size_t spare_ = 0;
  std::uint32_t next_sequence_ = 0;
};

}  // namespace pharos::boot
