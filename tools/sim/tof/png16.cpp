// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/png16.hpp"

#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

void append_be32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift & 0xFFu));
}

void append_chunk(std::string& out, const std::string& type_and_data) {
  append_be32(out, static_cast<std::uint32_t>(type_and_data.size() - 4));
  out += type_and_data;
  append_be32(out, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(type_and_data.data()),
                                                    static_cast<uInt>(type_and_data.size()))));
}

}  // namespace

void write_png16(const std::filesystem::path& path, int width_px, int height_px,
                 const std::vector<std::uint16_t>& pixels) {
  std::string rows;
  rows.reserve(pixels.size() * 2 + static_cast<std::size_t>(height_px));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % static_cast<std::size_t>(width_px) == 0) rows.push_back('\0');  // row as it is
    rows.push_back(static_cast<char>(pixels[i] >> 8));
    rows.push_back(static_cast<char>(pixels[i] & 0xFF));
  }
  uLongf size = compressBound(rows.size());
  std::string data(size, '\0');
  compress2(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size(),
            Z_BEST_SPEED);
  data.resize(size);

  std::string file("\x89PNG\r\n\x1a\n", 8);
  std::string header = "IHDR";
  append_be32(header, static_cast<std::uint32_t>(width_px));
  append_be32(header, static_cast<std::uint32_t>(height_px));
  header += std::string("\x10\0\0\0\0", 5);  // 16 bits, grey, the one compression and filter, not interlaced
  append_chunk(file, header);
  append_chunk(file, "IDAT" + data);
  append_chunk(file, "IEND");
  std::ofstream out(path, std::ios::binary);
  out << file << std::flush;
  if (!out) {
    throw host::InputError(path.string() + ": cannot be written: " + std::strerror(errno) +
                           "; choose another --output");
  }
}

}  // namespace pharos::sim
