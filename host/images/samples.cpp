// SPDX-License-Identifier: Apache-2.0
#include "host/images/samples.hpp"

#include <algorithm>

#include "host/images/limits.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::uint16_t kOpaque = 65535;

std::uint16_t wide(std::uint8_t value) { return static_cast<std::uint16_t>(value * 257); }

}  // namespace

std::vector<std::uint16_t> widened(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint16_t> values(bytes.size());
  std::transform(bytes.begin(), bytes.end(), values.begin(), wide);
  return values;
}

void drop_opacity(Picture& picture, const std::string& name) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::size_t out = 0;
  for (std::size_t in = 0; in < picture.values.size(); in += channels + 1) {
    if (picture.values[in + channels] != kOpaque) {
      throw InputError(name + ": has transparency; an image without is needed (convert IN -alpha off OUT)");
    }
    for (std::size_t c = 0; c < channels; ++c) picture.values[out++] = picture.values[in + c];
  }
  picture.values.resize(out);
}

void apply_palette(Picture& picture, std::span<const std::uint8_t> indices, std::span<const PaletteEntry> palette,
                   const std::string& name, const char* kind) {
  if (!indices.empty() && *std::max_element(indices.begin(), indices.end()) >= palette.size()) {
    refuse_damaged(name, kind, "a pixel names a colour that its palette does not have");
  }
  const bool grey = std::all_of(palette.begin(), palette.end(),
                                [](const PaletteEntry& e) { return e.red == e.green && e.green == e.blue; });
  picture.channels = grey ? 1 : 3;
  picture.bits = 8;
  picture.values.clear();
  picture.values.reserve(indices.size() * static_cast<std::size_t>(picture.channels));
  for (const std::uint8_t index : indices) {
    const PaletteEntry& entry = palette[index];
    picture.values.push_back(wide(entry.red));
    if (grey) continue;
    picture.values.push_back(wide(entry.green));
    picture.values.push_back(wide(entry.blue));
  }
}

}  // namespace pharos::host
