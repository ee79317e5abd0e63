// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>

#include "pharos/boot_image/slot.hpp"
#include "pharos/wire/crc32.hpp"
#include "unit/boot/images.hpp"

namespace pharos::boot_image {
namespace {

using boot::test::Bytes;
using boot::test::make_image;

/// The file with one field of its header changed, and the header's CRC recomputed.
template <class Change>
Bytes changed(Bytes file, Change&& change) {
  BootImageHeader header;
  std::memcpy(&header, file.data(), sizeof header);
  change(header);
  header.header_crc32 = wire::crc32(bytes_of(header).first(offsetof(BootImageHeader, header_crc32)));
  std::memcpy(file.data(), &header, sizeof header);
  return file;
}

const Bytes kGood = make_image(1, {.body_bytes = 1200, .version = {1, 2, 3}, .board = "a board"});

TEST(Image, ComesBackAsItWasMade) {
  const auto header = check_image(kGood);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->body_bytes, 1200u);
  EXPECT_EQ(header->version, (Version{1, 2, 3}));
  EXPECT_STREQ(header->board.data(), "a board");
  EXPECT_STREQ(header->name.data(), "test");
}

TEST(Image, CutAnywhereIsCutShort) {
  for (std::size_t size = 0; size < kGood.size(); ++size) {
    EXPECT_EQ(check_image(std::span(kGood).first(size)).error(), BootImageError::kCutShort) << size;
  }
}

TEST(Image, WithAnyBitFlippedIsNoImage) {
  for (std::size_t at = 0; at < kGood.size(); ++at) {
    if (at >= 96 && at < sizeof(SealedHeader)) continue;  // the signature: the target verifies it
    for (int bit = 0; bit < 8; ++bit) {
      Bytes file = kGood;
      file[at] ^= static_cast<std::uint8_t>(1 << bit);
      ASSERT_FALSE(check_image(file)) << at << " bit " << bit;
    }
  }
  Bytes flipped = kGood;
  flipped[700] ^= 1;
  EXPECT_EQ(check_image(flipped).error(), BootImageError::kBadBody);
}

TEST(Image, WithBytesBehindItIsTooLong) {
  Bytes longer = kGood;
  longer.push_back(0);
  EXPECT_EQ(check_image(longer).error(), BootImageError::kTooLong);
}

TEST(Image, SomethingElseIsReported) {
  EXPECT_EQ(check_image(Bytes(1000, 0x7F)).error(), BootImageError::kNoImage);
  EXPECT_EQ(check_image(changed(kGood, [](BootImageHeader& h) { h.format = 1; })).error(),
            BootImageError::kOtherFormat);
}

TEST(Image, AFieldThatMeansNothingIsRefused) {
  const auto fault = [](auto&& change) { return check_image(changed(kGood, change)).error(); };
  EXPECT_EQ(fault([](BootImageHeader& h) { h.body_bytes = 0; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.body_bytes -= 2; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.load_address += 2; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.entry_address += 2; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.entry_address = h.load_address - 4; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.entry_address = h.load_address + h.body_bytes; }),
            BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.board[2] = '\n'; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.name[11] = 'x'; }), BootImageError::kBadHeader);
  EXPECT_EQ(fault([](BootImageHeader& h) { h.version.major = 9; }), BootImageError::kNone);
}

TEST(Slot, AMarkHoldsForItsOwnHeaderOnly) {
  SlotHead head;
  std::memcpy(&head.image, kGood.data(), sizeof head.image);
  head.mark = make_mark(head.image, 41);
  EXPECT_EQ(sequence_of(head), 41u);
  SlotHead other = head;
  const Bytes image = make_image(2);
  std::memcpy(&other.image, image.data(), sizeof other.image);
  EXPECT_EQ(sequence_of(other), 0u);
}

TEST(Slot, AMarkWithBitsNotYetWrittenIsNone) {
  SlotHead head;
  std::memcpy(&head.image, kGood.data(), sizeof head.image);
  std::mt19937 random(1);
  for (std::uint32_t sequence = 1; sequence < 2000; ++sequence) {
    const SlotMark whole = make_mark(head.image, sequence);
    head.mark = {whole.sequence | static_cast<std::uint32_t>(random()),
                 whole.check | static_cast<std::uint32_t>(random())};
    const bool changed = head.mark.sequence != whole.sequence || head.mark.check != whole.check;
    ASSERT_EQ(sequence_of(head), changed ? 0 : sequence);
    head.mark = {UINT32_MAX, UINT32_MAX};
    ASSERT_EQ(sequence_of(head), 0u);
  }
}

}  // namespace
}  // namespace pharos::boot_image
