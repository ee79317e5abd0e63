// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_directory.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

#include "host/device/pixel_format.hpp"
#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIntensity = "_intensity.png";
constexpr const char* kDepth = "_depth.png";
constexpr const char* kRaw = "_abcy16.raw";

bool take_suffix(std::string_view& name, std::string_view suffix) {
  if (!name.ends_with(suffix)) return false;
  name.remove_suffix(suffix.size());
  return true;
}

void read_raw(const fs::path& path, std::int32_t width_px, std::int32_t height_px, DepthFrame& frame) {
  const std::size_t size = payload_bytes(kCoord3dAbcy16, width_px, height_px);
  std::error_code error;
  if (fs::file_size(path, error) != size || error) {
    throw InputError(path.string() + ": is not the " + std::to_string(size) + " bytes of " + std::to_string(width_px) +
                     " x " + std::to_string(height_px) + " pixels; is it of this camera?");
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw InputError(path.string() + ": cannot be read; check its permissions");
  }
  frame.resize(width_px, height_px);
  unpack_abcy16(bytes, frame.depth, frame.intensity);
}

void read_image(const fs::path& path, std::int32_t width_px, std::int32_t height_px,
                std::vector<std::uint16_t>& pixels) {
  GreyImage image = read_grey_image(path.string());
  if (image.width_px != width_px || image.height_px != height_px || image.bits != 16) {
    throw InputError(path.string() + ": has " + std::to_string(image.width_px) + " x " +
                     std::to_string(image.height_px) + " pixels of " + std::to_string(image.bits) + " bits, not " +
                     std::to_string(width_px) + " x " + std::to_string(height_px) + " of 16; is it of this camera?");
  }
  pixels = std::move(image.pixels);
}

}  // namespace

FrameDirectory::FrameDirectory(const std::string& path) : folder_(path) {
  std::error_code error;
  fs::directory_iterator files(folder_, error);
  if (error) throw InputError(path + ": cannot be read: " + error.message() + "; give a directory of frames");
  for (const fs::directory_entry& file : files) {
    const std::string full = file.path().filename().string();
    std::string_view name = full;
    const bool raw = take_suffix(name, kRaw);
    const bool intensity = !raw && take_suffix(name, kIntensity);
    const bool depth = !raw && !intensity && take_suffix(name, kDepth);
    std::uint64_t number = 0;
    const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (!(raw || intensity || depth) || bad != std::errc() || end != name.data() + name.size()) continue;
    Entry& entry = entry_of(std::string(name), number);
    entry.raw |= raw;
    entry.intensity |= intensity;
    entry.depth |= depth;
  }
  if (entries_.empty()) throw InputError(path + ": holds no frames (NNNN_intensity.png and NNNN_depth.png)");
  for (const Entry& entry : entries_) {
    if (!entry.raw && entry.intensity != entry.depth) {
      throw InputError(path_of(entry, entry.depth ? kIntensity : kDepth).string() +
                       ": is missing; intensity and depth belong together");
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.number < b.number; });
}

FrameDirectory::Entry& FrameDirectory::entry_of(const std::string& name, std::uint64_t number) {
  const auto [place, is_new] = places_.try_emplace(name, entries_.size());
  if (is_new) entries_.push_back({name, number, false, false, false});
  return entries_[place->second];
}

fs::path FrameDirectory::path_of(const Entry& entry, const char* suffix) const {
  return folder_ / (entry.name + suffix);
}

void FrameDirectory::read(std::size_t index, std::int32_t width_px, std::int32_t height_px, DepthFrame& frame) const {
  const Entry& entry = entries_[index];
  if (entry.raw) return read_raw(path_of(entry, kRaw), width_px, height_px, frame);
  frame.resize(width_px, height_px);
  read_image(path_of(entry, kIntensity), width_px, height_px, frame.intensity);
  read_image(path_of(entry, kDepth), width_px, height_px, frame.depth);
}

}  // namespace pharos::host
