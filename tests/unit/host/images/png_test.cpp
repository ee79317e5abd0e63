// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <spng.h>

#include <cstdlib>
#include <memory>

#include "host/images/png_format.hpp"
#include "tests/unit/host/images/image_bytes.hpp"

namespace pharos::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two pixels beside each other, as libspng writes them.
Bytes encoded(std::uint8_t colour, std::uint8_t bits, const Bytes& row, spng_trns* key = nullptr,
              spng_plte* palette = nullptr) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{2, 1, bits, colour, 0, 0, 0};
  spng_set_ihdr(context.get(), &header);
  if (palette != nullptr) spng_set_plte(context.get(), palette);
  if (key != nullptr) spng_set_trns(context.get(), key);
  EXPECT_EQ(spng_encode_image(context.get(), row.data(), row.size(), SPNG_FMT_RAW, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int error = 0;
  auto* data = static_cast<std::uint8_t*>(spng_get_png_buffer(context.get(), &size, &error));
  Bytes bytes(data, data + size);
  std::free(data);
  return bytes;
}

TEST(Png, NarrowGreyFillsTheRange) {
  EXPECT_THAT(decode_picture(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 1, {0x40}), "p").values, ElementsAre(0, 65535));
  EXPECT_THAT(decode_picture(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 2, {0x60}), "p").values,
              ElementsAre(85 * 257, 170 * 257));
  EXPECT_THAT(decode_picture(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 4, {0x1F}), "p").values, ElementsAre(17 * 257, 65535));
}

TEST(Png, OpacityIsDroppedWhereFullAndRefusedElse) {
  const Picture grey = decode_picture(encoded(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 8, {7, 255, 9, 255}), "p");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_THAT(grey.values, ElementsAre(7 * 257, 9 * 257));
  const Picture colour = decode_picture(
      encoded(SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 16, {1, 2, 3, 4, 5, 6, 255, 255, 7, 8, 9, 10, 11, 12, 255, 255}), "p");
  EXPECT_EQ(colour.channels, 3);
  EXPECT_EQ(colour.bits, 16);
  EXPECT_THAT(colour.values, ElementsAre(0x0102, 0x0304, 0x0506, 0x0708, 0x090A, 0x0B0C));
  EXPECT_THAT(error_message_of(encoded(SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 8, {7, 255, 9, 254})),
              HasSubstr("transparency"));
}

TEST(Png, AColourForTransparencyDoesHarmOnlyWhereAPixelHasIt) {
  spng_trns key{};
  key.gray = 8;
  EXPECT_THAT(decode_picture(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 8, {7, 9}, &key), "p").values,
              ElementsAre(7 * 257, 9 * 257));
  EXPECT_THAT(error_message_of(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 8, {7, 8}, &key)), HasSubstr("transparency"));
  key.gray = 3;
  EXPECT_THAT(error_message_of(encoded(SPNG_COLOR_TYPE_GRAYSCALE, 4, {0x23}, &key)), HasSubstr("transparency"));
  key.red = 1;
  key.green = 2;
  key.blue = 3;
  EXPECT_EQ(decode_picture(encoded(SPNG_COLOR_TYPE_TRUECOLOR, 8, {1, 2, 4, 3, 2, 1}, &key), "p").channels, 3);
  EXPECT_THAT(error_message_of(encoded(SPNG_COLOR_TYPE_TRUECOLOR, 8, {1, 2, 4, 1, 2, 3}, &key)),
              HasSubstr("transparency"));
}

TEST(Png, AWrongChunkSizeIsNoWrongCheck) {
  const Bytes good = encoded(SPNG_COLOR_TYPE_GRAYSCALE, 8, {7, 9});
  constexpr std::size_t kImageData = 8 + 25;  // after the signature and the header's chunk
  for (const int more : {-1, 1, 2}) {
    Bytes bytes = good;
    bytes[kImageData + 3] = static_cast<std::uint8_t>(bytes[kImageData + 3] + more);
    EXPECT_THAT(error_message_of(bytes), HasSubstr("size of a chunk is wrong")) << more;
  }
  Bytes bytes = good;
  bytes[kImageData + 8] ^= 0x55;
  EXPECT_THAT(error_message_of(bytes), testing::Not(HasSubstr("size of a chunk")));
}

TEST(Png, AGreyPaletteIsGrey) {
  spng_plte palette{};
  palette.n_entries = 2;
  palette.entries[0] = {5, 5, 5, 255};
  palette.entries[1] = {200, 200, 200, 255};
  const Picture grey = decode_picture(encoded(SPNG_COLOR_TYPE_INDEXED, 8, {1, 0}, nullptr, &palette), "p");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_THAT(grey.values, ElementsAre(200 * 257, 5 * 257));
  EXPECT_NE(error_message_of(encoded(SPNG_COLOR_TYPE_INDEXED, 8, {1, 2}, nullptr, &palette)), "none");
}

}  // namespace
}  // namespace pharos::host
