// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_directory.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

#include "host/device/pixel_format.hpp"
#include "host/images/grey_image.hpp"
#include "host/images/image_names.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIntensity = "_intensity";
constexpr const char* kDepth = "_depth";
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

GreyImage read_image(const fs::path& path, std::int32_t width_px, std::int32_t height_px) {
  GreyImage image = read_grey_image(path.string());
  if (image.width_px != width_px || image.height_px != height_px) {
    throw InputError(path.string() + ": has " + std::to_string(image.width_px) + " x " +
                     std::to_string(image.height_px) + " pixels, not " + std::to_string(width_px) + " x " +
                     std::to_string(height_px) + "; is it of this camera?");
  }
  return image;
}

// Depths are counts: 8 bits scaled to 16, or the luma of a colour image, are not accepted.
std::vector<std::uint16_t> depths_of(GreyImage&& image, const fs::path& path) {
  if (image.bits != 16 || image.from_colour) {
    throw InputError(path.string() + ": is " + (image.from_colour ? "in colour" : "of 8 bits") +
                     "; depths are grey values of 16 bits: is it a depth image?");
  }
  return std::move(image.pixels);
}

// One file each for intensity and depth of a frame.
void take(std::string& place, const std::string& file) {
  if (!place.empty()) throw InputError(file + " and " + place + " are one frame's; remove one");
  place = file;
}

}  // namespace

FrameDirectory::FrameDirectory(const std::string& path) : folder_(path) {
  std::error_code error;
  fs::directory_iterator files(folder_, error);
  if (error) throw InputError(path + ": cannot be read: " + error.message() + "; give a directory of frames");
  for (const fs::directory_entry& file : files) {
    const std::string full = file.path().filename().string(), stem = file.path().stem().string();
    std::string_view name = full;
    const bool raw = take_suffix(name, kRaw);
    if (!raw) name = stem;
    const bool image = !raw && has_image_ending(file.path());
    const bool intensity = image && take_suffix(name, kIntensity);
    const bool depth = image && !intensity && take_suffix(name, kDepth);
    std::uint64_t number = 0;
    const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (!(raw || intensity || depth) || bad != std::errc() || end != name.data() + name.size()) continue;
    Entry& entry = entry_of(std::string(name), number);
    entry.raw |= raw;
    if (intensity) take(entry.intensity, full);
    if (depth) take(entry.depth, full);
  }
  if (entries_.empty()) throw InputError(path + ": holds no frames (NNNN_intensity.png and NNNN_depth.png)");
  for (const Entry& entry : entries_) {
    if (!entry.raw && entry.intensity.empty() != entry.depth.empty()) {
      const std::string missing = entry.name + (entry.depth.empty() ? kDepth : kIntensity) + ".png";
      throw InputError((folder_ / missing).string() + ": is missing; intensity and depth belong together");
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.number < b.number; });
}

FrameDirectory::Entry& FrameDirectory::entry_of(const std::string& name, std::uint64_t number) {
  const auto [place, is_new] = places_.try_emplace(name, entries_.size());
  if (is_new) entries_.push_back({name, number, false, {}, {}});
  return entries_[place->second];
}

std::string FrameDirectory::read(std::size_t index, std::int32_t width_px, std::int32_t height_px,
                                 DepthFrame& frame) const {
  const Entry& entry = entries_[index];
  if (entry.raw) {
    read_raw(folder_ / (entry.name + kRaw), width_px, height_px, frame);
    return {};
  }
  frame.resize(width_px, height_px);
  const fs::path intensity = folder_ / entry.intensity, depth = folder_ / entry.depth;
  GreyImage image = read_image(intensity, width_px, height_px);
  frame.intensity = std::move(image.pixels);
  frame.depth = depths_of(read_image(depth, width_px, height_px), depth);
  return image.from_colour ? intensity.string() : std::string();
}

}  // namespace pharos::host
