// SPDX-License-Identifier: Apache-2.0
#include "host/images/grey_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/host/images/image_bytes.hpp"

namespace pharos::host {
namespace {

using testing::HasSubstr;

class GreyImageFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = (std::filesystem::temp_directory_path() / (std::string("pharos_") + test->name() + ".img")).string();
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::vector<std::uint8_t> bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static GreyImage ramp(int width, int height) {
    GreyImage image{width, height, 16, {}};
    for (int k = 0; k < width * height; ++k) image.pixels.push_back(static_cast<std::uint16_t>(k * 97));
    return image;
  }

  std::string path_;
};

// CRC-32 of a chunk's type and data, so that a changed header is false but not a damaged file.
void mend_header_crc(std::vector<std::uint8_t>& png) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t k = 12; k < 29; ++k) {
    crc ^= png[k];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  crc = ~crc;
  for (std::size_t k = 0; k < 4; ++k) png[29 + k] = static_cast<std::uint8_t>(crc >> (24 - 8 * k));
}

void claim_size(std::vector<std::uint8_t>& png, std::uint32_t width, std::uint32_t height) {
  for (std::size_t k = 0; k < 4; ++k) {
    png[16 + k] = static_cast<std::uint8_t>(width >> (24 - 8 * k));
    png[20 + k] = static_cast<std::uint8_t>(height >> (24 - 8 * k));
  }
  mend_header_crc(png);
}

TEST_F(GreyImageFile, SixteenBitsComeBackAsTheyWere) {
  const GreyImage image = ramp(31, 17);
  write_grey_png(path_, image.view());
  const GreyImage again = read_grey_image(path_);
  EXPECT_EQ(again.width_px, 31);
  EXPECT_EQ(again.height_px, 17);
  EXPECT_EQ(again.bits, 16);
  EXPECT_EQ(again.pixels, image.pixels);
}

TEST_F(GreyImageFile, EightBitsFillTheRange) {
  GreyImage image = ramp(16, 16);
  for (std::size_t k = 0; k < 256; ++k) image.pixels[k] = static_cast<std::uint16_t>(257 * k);
  write_grey_png(path_, image.view(), 8);
  const GreyImage again = read_grey_image(path_);
  EXPECT_EQ(again.bits, 8);
  EXPECT_EQ(again.pixels, image.pixels);
}

TEST_F(GreyImageFile, OnePixelIsAnImage) {
  write_grey_png(path_, ramp(1, 1).view());
  EXPECT_EQ(read_grey_image(path_).pixels.size(), 1U);
}

TEST_F(GreyImageFile, EveryTruncationIsRefused) {
  write_grey_png(path_, ramp(31, 17).view());
  const std::vector<std::uint8_t> whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    EXPECT_NE(error_message_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "none")
        << size;
  }
}

TEST_F(GreyImageFile, WrongSizesAreReported) {
  write_grey_png(path_, ramp(31, 17).view());
  const std::vector<std::uint8_t> whole = bytes();
  std::vector<std::uint8_t> lie = whole;
  claim_size(lie, 31, 40);
  EXPECT_THAT(error_message_of(lie), HasSubstr("damaged"));
  claim_size(lie, 30000, 1000);
  EXPECT_THAT(error_message_of(lie), HasSubstr("less data"));
  claim_size(lie, 100000, 100000);
  EXPECT_THAT(error_message_of(lie), HasSubstr("claims 100000 x 100000"));
  claim_size(lie, 0, 17);
  EXPECT_NE(error_message_of(lie), "none");
}

TEST_F(GreyImageFile, APlaceThatCannotBeWrittenIsReported) {
  EXPECT_THROW(write_grey_png("/nowhere/at/all.png", ramp(4, 4).view()), InputError);
  EXPECT_THROW(read_grey_image("/nowhere/at/all.png"), InputError);
  EXPECT_THROW(read_grey_image("/tmp"), InputError);
}

TEST(Pgm, EightAndSixteenBits) {
  const std::string eight("P5 # a comment\n2 2\n255\n\x01\x02\x03\xFF", 27);
  const GreyImage image = decode_grey_image({reinterpret_cast<const std::uint8_t*>(eight.data()), eight.size()}, "p");
  EXPECT_THAT(image.pixels, testing::ElementsAre(257, 514, 771, 65535));
  const std::string sixteen("P5\n2 1\n65535\n\x01\x02\x03\x04", 17);
  const GreyImage wide =
      decode_grey_image({reinterpret_cast<const std::uint8_t*>(sixteen.data()), sixteen.size()}, "p");
  EXPECT_EQ(wide.bits, 16);
  EXPECT_THAT(wide.pixels, testing::ElementsAre(0x0102, 0x0304));
}

TEST(Pgm, WhatIsNotWholeIsRefused) {
  EXPECT_THAT(error_message_of(bytes_of("P5\n2 2\n255\nabc")), HasSubstr("less data"));
  EXPECT_THAT(error_message_of(bytes_of("P5\n2 2\n255\nabcde")), HasSubstr("more data"));
  EXPECT_THAT(error_message_of(bytes_of("P5\n40000 2\n255\nabcd")), HasSubstr("claims"));
  EXPECT_THAT(error_message_of(bytes_of("P5\n99999999999999 2\n255\n")), HasSubstr("header"));
  EXPECT_THAT(error_message_of(bytes_of("P5\n0 2\n255\n")), HasSubstr("header"));
  EXPECT_THAT(error_message_of(bytes_of("P5\n2")), HasSubstr("header"));
  EXPECT_THAT(error_message_of(bytes_of("P2\n2 2\n255\n1 2 3 4")), HasSubstr("no PNG"));
  EXPECT_THAT(error_message_of(bytes_of("")), HasSubstr("empty"));
}

}  // namespace
}  // namespace pharos::host
