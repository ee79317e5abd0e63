// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/version_floor.hpp"
#include "pharos/boot_image/slot.hpp"
#include "pharos/signature/sha2.hpp"

namespace pharos::boot {

/// Content of a board's slots: known after find().
template <BootBoard Board>
class Slots {
 public:
  /// Reads the slots, and copies the newest whole image to its load address; `older`: the one before it, if that is
  /// whole.
  void find(bool older) {
    for (std::size_t slot = 0; slot < boot_image::kSlots; ++slot) sequences_[slot] = read(slot, head_);
    const std::size_t newest = extreme(true);
    next_sequence_ = sequences_[newest] + 2;
    if (older) sequences_[newest] = 1;  // after all others
    std::size_t first = extreme(true);
    for (; sequences_[first] != 0; first = extreme(true)) {
      if (read(first, head_) != 0 && load(first, head_.image)) {
        loaded_ = &head_.image.header;
        break;
      }
      sequences_[first] = 0;  // no fallback either
    }
    // What stays silent is no fallback: it is written over.
    spare_ = older && first != newest ? newest : extreme(false);
  }

  /// The image that was copied to its load address; null when no slot holds a whole one.
  const boot_image::BootImageHeader* loaded() const { return loaded_; }
  /// After a start of the newest image that was confirmed: what is older than both is not written any more. Nothing
  /// where there is no fallback, or where one of the two is not signed.
  template <class Idle>
  void raise_floor(Idle&& idle) const {
    std::uint32_t oldest = UINT32_MAX;
    for (std::size_t slot = 0; slot < boot_image::kSlots; ++slot) {
      boot_image::SlotHead head;
      if (slot == spare_) continue;
      if (read(slot, head) == 0 || !boot_image::is_signed(head.image.seal)) return;
      oldest = std::min(oldest, number_of(head.image.header.version));
    }
    (void)VersionFloor<Board>::raise(oldest, std::forward<Idle>(idle));  // failed: the next start tries again
  }
  /// The slot that is to be written: neither of the image that was copied nor of its fallback.
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
  /// The slot of the greatest or least sequence number; 0, of nothing that can run, is the least.
  [[gnu::noinline]] std::size_t extreme(bool greatest) const {
    std::size_t best = 0;
    for (std::size_t slot = 1; slot < boot_image::kSlots; ++slot) {
      if ((sequences_[slot] > sequences_[best]) == greatest) best = slot;
    }
    return best;
  }

  std::array<std::uint32_t, boot_image::kSlots> sequences_{};  // 0: nothing that can run
  boot_image::SlotHead head_{};                                // of the image that was copied
  const boot_image::BootImageHeader* loaded_ = nullptr;
  std::size_t spare_ = 0;
  std::uint32_t next_sequence_ = 0;
};

}  // namespace pharos::boot
