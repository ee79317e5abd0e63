// SPDX-License-Identifier: Apache-2.0
#include "host/images/jpeg_format.hpp"

#include <turbojpeg.h>

#include <memory>

#include "host/images/limits.hpp"
#include "host/images/samples.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Decoding a progressive file with many scans of a few bytes takes minutes; cameras write ten scans. The
// library's own limit (TJFLAG_LIMITSCANS) is 500.
constexpr int kMaxScans = 100;
// A block of 8 x 8 takes one bit at least.
constexpr std::size_t kMaxPixelsPerByte = 8 * 64;
constexpr std::uint8_t kMarker = 0xFF, kStartOfScan = 0xDA;

struct Destroy {
  void operator()(void* codec) const { tjDestroy(codec); }
};
struct FreeFile {
  void operator()(unsigned char* bytes) const { tjFree(bytes); }
};

// Within a scan's data a byte of 0xFF is followed by 0 or a restart: each 0xFF 0xDA begins a scan (or one of a small
// picture within the comments).
int scans_in(Bytes bytes) {
  int scans = 0;
  for (std::size_t k = 1; k < bytes.size(); ++k) {
    if (bytes[k] == kStartOfScan && bytes[k - 1] == kMarker) ++scans;
  }
  return scans;
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == kMarker && bytes[1] == 0xD8 && bytes[2] == kMarker;
}

Picture decode_jpeg(Bytes bytes, const std::string& name) {
  const std::unique_ptr<void, Destroy> decoder(tjInitDecompress());
  if (!decoder) throw InputError(name + ": no memory to read it");
  int width = 0, height = 0, subsampling = 0, colours = 0;
  const auto size = static_cast<unsigned long>(bytes.size());
  if (tjDecompressHeader3(decoder.get(), bytes.data(), size, &width, &height, &subsampling, &colours) != 0) {
    refuse_damaged(name, "JPEG", tjGetErrorStr2(decoder.get()));
  }
  require_readable_size(static_cast<std::size_t>(width), static_cast<std::size_t>(height), name);
  if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
    throw InputError(name +
                     ": has 4 colours; grey or red, green and blue are needed (convert IN -colorspace sRGB OUT)");
  }
  Picture picture{width, height, colours == TJCS_GRAY ? 1 : 3, 8, {}};
  if (picture.pixels() > kMaxPixelsPerByte * bytes.size()) refuse_damaged(name, "JPEG", kLessData);
  if (scans_in(bytes) > kMaxScans) {
    refuse_damaged(name, "JPEG", "more than " + std::to_string(kMaxScans) + " scans");
  }
  std::vector<std::uint8_t> rows(picture.pixels() * static_cast<std::size_t>(picture.channels));
  const int format = picture.channels == 1 ? TJPF_GRAY : TJPF_RGB;
  // The library fills in missing data and warns; here such a file is damaged.
  if (tjDecompress2(decoder.get(), bytes.data(), size, rows.data(), width, 0, height, format, TJFLAG_STOPONWARNING) !=
      0) {
    refuse_damaged(name, "JPEG", tjGetErrorStr2(decoder.get()));
  }
  picture.values = widened(rows);
  return picture;
}

std::vector<std::uint8_t> encode_jpeg(std::int32_t width_px, std::int32_t height_px, Bytes rgb, int quality) {
  const std::unique_ptr<void, Destroy> encoder(tjInitCompress());
  unsigned char* file = nullptr;
  unsigned long size = 0;
  const int failed = encoder ? tjCompress2(encoder.get(), rgb.data(), width_px, 0, height_px, TJPF_RGB, &file, &size,
                                           TJSAMP_444, quality, 0)
                             : -1;
  const std::unique_ptr<unsigned char, FreeFile> owner(file);
  if (failed != 0) return {};
  return {file, file + size};
}

}  // namespace pharos::host
