// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::host {

enum class ImageDefect : std::uint8_t {
  kNone,
  kBlack,      // almost no grey value above the lowest: lens cover, no light
  kSaturated,  // most of it at the highest value
  kEven,       // bright, but without contrast
};
const char* name_of(ImageDefect fault);

/// Whether an image can be used, by its grey values alone.
ImageDefect fault_of(ImageView<const std::uint16_t> image);

}  // namespace pharos::host
