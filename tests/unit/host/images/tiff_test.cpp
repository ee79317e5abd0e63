// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstring>
#include <optional>

#include "tests/unit/host/images/image_bytes.hpp"

namespace pharos::host {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Words = std::initializer_list<std::uint16_t>;

// The image for libtiff to write: values of a pattern that each test can compute.
struct Tiff {
  std::uint32_t width = 37, height = 29;
  std::uint16_t bits = 8, samples = 1;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK, compression = COMPRESSION_NONE;
  std::uint16_t planar = PLANARCONFIG_CONTIG, format = SAMPLEFORMAT_UINT;
  std::uint32_t rows_per_strip = 7, tile = 0;
  std::optional<std::uint16_t> opacity;  // the last sample's value, of all pixels
  const char* mode = "w";

  std::uint16_t value(std::uint32_t u, std::uint32_t v, std::uint32_t c) const {
    if (opacity && c + 1 == samples) return *opacity;
    const std::uint32_t number = 3 * u + 2 * v + 30 * c;
    return static_cast<std::uint16_t>(bits == 8 ? number : 219 * number);
  }
  // The expected result of read_picture.
  std::vector<std::uint16_t> wanted() const {
    std::vector<std::uint16_t> values;
    const std::uint32_t colours = opacity ? samples - 1U : samples;
    for (std::uint32_t v = 0; v < height; ++v) {
      for (std::uint32_t u = 0; u < width; ++u) {
        for (std::uint32_t c = 0; c < colours; ++c) {
          values.push_back(static_cast<std::uint16_t>(value(u, v, c) * (bits == 8 ? 257 : 1)));
        }
      }
    }
    return values;
  }
};

class TiffFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = (std::filesystem::temp_directory_path() / (std::string("pharos_tiff_") + test->name())).string();
  }
  void TearDown() override { std::filesystem::remove(path_); }

  // A part of the image: `width` x `height` pixels from (u, v), all samples or one.
  static Bytes piece(const Tiff& tiff, std::uint32_t u0, std::uint32_t v0, std::uint32_t width, std::uint32_t height,
                     std::uint32_t first, std::uint32_t count) {
    Bytes out;
    for (std::uint32_t v = v0; v < v0 + height; ++v) {
      for (std::uint32_t u = u0; u < u0 + width; ++u) {
        for (std::uint32_t c = first; c < first + count; ++c) {
          const std::uint16_t value = tiff.value(u, v, c);
          if (tiff.bits == 8) out.push_back(static_cast<std::uint8_t>(value));
          if (tiff.bits == 16)
            out.insert(out.end(), reinterpret_cast<const std::uint8_t*>(&value),
                       reinterpret_cast<const std::uint8_t*>(&value) + 2);
        }
      }
    }
    return out;
  }

  Bytes written(const Tiff& tiff, const std::vector<std::uint16_t>& palette = {}) const {
    TIFF* file = TIFFOpen(path_.c_str(), tiff.mode);
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, tiff.width);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, tiff.height);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, tiff.bits);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, tiff.samples);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, tiff.photometric);
    TIFFSetField(file, TIFFTAG_COMPRESSION, tiff.compression);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, tiff.planar);
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, tiff.format);
    if (tiff.photometric == PHOTOMETRIC_YCBCR) TIFFSetField(file, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    std::uint16_t extra = EXTRASAMPLE_UNASSALPHA;
    if (tiff.opacity) TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &extra);
    if (!palette.empty()) TIFFSetField(file, TIFFTAG_COLORMAP, &palette[0], &palette[256], &palette[512]);
    const bool apart = tiff.planar == PLANARCONFIG_SEPARATE;
    if (tiff.tile > 0) {
      TIFFSetField(file, TIFFTAG_TILEWIDTH, tiff.tile);
      TIFFSetField(file, TIFFTAG_TILELENGTH, tiff.tile);
    } else {
      TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, tiff.rows_per_strip);
    }
    std::uint32_t index = 0;
    for (std::uint32_t plane = 0; plane < (apart ? tiff.samples : 1U); ++plane) {
      const std::uint32_t count = apart ? 1 : tiff.samples;
      for (std::uint32_t v = 0; v<tiff.height; v += tiff.tile> 0 ? tiff.tile : tiff.rows_per_strip) {
        if (tiff.tile == 0) {
          Bytes strip = piece(tiff, 0, v, tiff.width, std::min(tiff.rows_per_strip, tiff.height - v), plane, count);
          TIFFWriteEncodedStrip(file, index++, strip.data(), static_cast<tmsize_t>(strip.size()));
        }
        for (std::uint32_t u = 0; tiff.tile > 0 && u < tiff.width; u += tiff.tile) {
          Bytes tile = piece(tiff, u, v, tiff.tile, tiff.tile, plane, count);
          TIFFWriteEncodedTile(file, index++, tile.data(), static_cast<tmsize_t>(tile.size()));
        }
      }
    }
    TIFFClose(file);
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void expect_read_back(const Tiff& tiff, const std::string& what) const {
    const Picture picture = decode_picture(written(tiff), what);
    EXPECT_EQ(picture.width_px, 37) << what;
    EXPECT_EQ(picture.height_px, 29) << what;
    EXPECT_EQ(picture.bits, tiff.bits) << what;
    EXPECT_EQ(picture.channels, tiff.photometric == PHOTOMETRIC_RGB ? 3 : 1) << what;
    EXPECT_EQ(picture.values, tiff.wanted()) << what;
  }

  std::string path_;
};

TEST_F(TiffFile, GreyAndColourOfEachDepthLayoutAndPackingComeBack) {
  for (const std::uint16_t bits : Words{8, 16}) {
    for (const std::uint16_t samples : Words{1, 3}) {
      for (const std::uint32_t tile : {0U, 16U}) {
        for (const std::uint16_t planar : Words{PLANARCONFIG_CONTIG, PLANARCONFIG_SEPARATE}) {
          for (const std::uint16_t packing :
               Words{COMPRESSION_NONE, COMPRESSION_PACKBITS, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
            Tiff tiff;
            tiff.bits = bits;
            tiff.samples = samples;
            tiff.photometric = samples == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
            tiff.tile = tile;
            tiff.planar = planar;
            tiff.compression = packing;
            expect_read_back(tiff, std::to_string(bits) + " bits, " + std::to_string(samples) + " samples, tile " +
                                       std::to_string(tile) + ", planar " + std::to_string(planar) + ", packing " +
                                       std::to_string(packing));
          }
        }
      }
    }
  }
}

TEST_F(TiffFile, BothByteOrdersAndBigTiffAreRead) {
  for (const char* mode : {"wl", "wb", "wl8", "wb8"}) {
    Tiff tiff;
    tiff.bits = 16;
    tiff.mode = mode;
    expect_read_back(tiff, mode);
  }
}

TEST_F(TiffFile, OneStripOfTheWholeImageIsRead) {
  Tiff tiff;
  tiff.rows_per_strip = 29;
  expect_read_back(tiff, "one strip");
}

TEST_F(TiffFile, WhereWhiteIsZeroValuesAreTurnedRound) {
  for (const std::uint16_t bits : Words{8, 16}) {
    Tiff tiff;
    tiff.bits = bits;
    tiff.photometric = PHOTOMETRIC_MINISWHITE;
    std::vector<std::uint16_t> wanted = tiff.wanted();
    for (std::uint16_t& value : wanted) value = static_cast<std::uint16_t>(65535 - value);
    EXPECT_EQ(decode_picture(written(tiff), "t").values, wanted);
  }
}

TEST_F(TiffFile, APaletteBecomesColourOrGrey) {
  Tiff tiff;
  tiff.photometric = PHOTOMETRIC_PALETTE;
  std::vector<std::uint16_t> palette;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 256; ++k) palette.push_back(static_cast<std::uint16_t>((c == 0 ? k : 255 - k) * 257));
  }
  const Picture colour = decode_picture(written(tiff, palette), "t");
  ASSERT_EQ(colour.channels, 3);
  EXPECT_EQ(colour.bits, 8);
  EXPECT_THAT(std::vector<std::uint16_t>(colour.values.begin() + 3, colour.values.begin() + 6),
              ElementsAre(3 * 257, 252 * 257, 252 * 257));
  std::copy_n(palette.begin(), 256, palette.begin() + 256);
  std::copy_n(palette.begin(), 256, palette.begin() + 512);
  const Picture grey = decode_picture(written(tiff, palette), "t");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_EQ(grey.values, tiff.wanted());
  for (std::uint16_t& entry : palette) entry = static_cast<std::uint16_t>(entry / 257);
  EXPECT_EQ(decode_picture(written(tiff, palette), "t").values, tiff.wanted()) << "entries of 8 bits";
}

TEST_F(TiffFile, JpegWithinIsReadToWithinItsLoss) {
  for (const std::uint16_t samples : Words{1, 3}) {
    Tiff tiff;
    tiff.samples = samples;
    tiff.rows_per_strip = 16;
    tiff.photometric = samples == 3 ? PHOTOMETRIC_YCBCR : PHOTOMETRIC_MINISBLACK;
    tiff.compression = COMPRESSION_JPEG;
    const Picture picture = decode_picture(written(tiff), "t");
    ASSERT_EQ(picture.channels, samples);
    const std::vector<std::uint16_t> wanted = tiff.wanted();
    for (std::size_t k = 0; k < wanted.size(); ++k) ASSERT_NEAR(picture.values[k], wanted[k], 24 * 257) << k;
  }
}

TEST_F(TiffFile, OpacityIsDroppedWhereFullAndRefusedElse) {
  for (const std::uint16_t samples : Words{2, 4}) {
    for (const std::uint16_t bits : Words{8, 16}) {
      Tiff tiff;
      tiff.samples = samples;
      tiff.bits = bits;
      tiff.photometric = samples == 4 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
      tiff.opacity = static_cast<std::uint16_t>(bits == 8 ? 255 : 65535);
      expect_read_back(tiff, "opaque");
      tiff.opacity = static_cast<std::uint16_t>(*tiff.opacity - 1);
      EXPECT_THAT(error_message_of(written(tiff)), HasSubstr("transparency"));
    }
  }
}

TEST_F(TiffFile, OtherKindsAreRefusedWithARemedy) {
  Tiff tiff;
  tiff.bits = 16;
  tiff.format = SAMPLEFORMAT_INT;
  EXPECT_THAT(error_message_of(written(tiff)), AllOf(HasSubstr("signed"), HasSubstr("convert")));
  tiff.format = SAMPLEFORMAT_IEEEFP;
  EXPECT_THAT(error_message_of(written(tiff)), HasSubstr("floating-point"));
  tiff = {};
  tiff.samples = 3;
  tiff.photometric = PHOTOMETRIC_CIELAB;
  EXPECT_THAT(error_message_of(written(tiff)), AllOf(HasSubstr("colour space"), HasSubstr("convert")));
  tiff.photometric = PHOTOMETRIC_RGB;
  tiff.samples = 5;
  EXPECT_THAT(error_message_of(written(tiff)), HasSubstr("5 values a pixel"));
}

TEST_F(TiffFile, EveryTruncationIsRefused) {
  for (const std::uint16_t packing : Words{COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
    Tiff tiff;
    tiff.compression = packing;
    const Bytes whole = written(tiff);
    for (std::size_t size = 0; size < whole.size(); size += 3) {
      EXPECT_NE(error_message_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "none")
          << size;
    }
  }
}

// A directory of entries (tag, type, count, value) directly after the header, and 64 bytes of zeros.
Bytes directory(const std::vector<std::array<std::uint32_t, 4>>& entries, std::uint32_t next = 0) {
  Bytes bytes = {'I', 'I', 42, 0, 8, 0, 0, 0};
  put(bytes, static_cast<std::uint32_t>(entries.size()), 2);
  for (const auto& [tag, type, count, value] : entries) {
    put(bytes, tag, 2);
    put(bytes, type, 2);
    put(bytes, count, 4);
    put(bytes, value, 4);
  }
  put(bytes, next, 4);
  bytes.resize(bytes.size() + 64);
  return bytes;
}

constexpr std::uint32_t kShort = 3, kLong = 4;

std::vector<std::array<std::uint32_t, 4>> entries(std::uint32_t width, std::uint32_t height) {
  return {{256, kLong, 1, width}, {257, kLong, 1, height}, {258, kShort, 1, 8},     {259, kShort, 1, 1},
          {262, kShort, 1, 1},    {273, kLong, 1, 8},      {278, kLong, 1, height}, {279, kLong, 1, width * height}};
}

TEST(HostileTiff, ADirectoryThatNamesItselfAsTheNextIsReadOnce) {
  const Picture picture = decode_picture(directory(entries(8, 4), 8), "t");
  EXPECT_EQ(picture.pixels(), 32U);
}

TEST(HostileTiff, ClaimsAreToldBeforeMemoryIsTaken) {
  EXPECT_THAT(error_message_of(directory(entries(100'000, 100'000))), HasSubstr("claims 100000 x 100000"));
  EXPECT_NE(error_message_of(directory(entries(4'000'000'000U, 4'000'000'000U))), "none");
  EXPECT_THAT(error_message_of(directory(entries(32767, 1000))), HasSubstr("less data"));
  EXPECT_NE(error_message_of(directory(entries(0, 4))), "none");
  auto strips = entries(8, 4'000'000'000U);
  strips[6][3] = 1;
  EXPECT_NE(error_message_of(directory(strips)), "none");
}

TEST(HostileTiff, TilesThatOverhangByFarAreRefused) {
  auto tiled = entries(32767, 1);
  tiled[5] = {322, kLong, 1, 16};
  tiled[6] = {323, kLong, 1, 4'000'000U};
  tiled[7] = {324, kLong, 1, 8};
  tiled.push_back({325, kLong, 1, 64});
  EXPECT_THAT(error_message_of(directory(tiled)), HasSubstr("damaged TIFF"));
}

TEST(HostileTiff, WithoutADirectoryItIsDamaged) {
  Bytes bytes = directory(entries(8, 4));
  bytes[7] = 0x70;
  EXPECT_THAT(error_message_of(bytes), HasSubstr("damaged TIFF"));
  EXPECT_THAT(error_message_of({'I', 'I', 42, 0}), HasSubstr("damaged TIFF"));
}

}  // namespace
}  // namespace pharos::host
