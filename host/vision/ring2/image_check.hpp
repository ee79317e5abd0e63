// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::host {

enum class ImageDefect : std::uint8_t {
  kNone,
  kBlack,      // almost all pixels at the lowest grey values: lens cover, no light
  kSaturated,  // most pixels at the highest value
  kEven,       // bright, but without contrast
};
const char* name_of(ImageDefect fault);

/// Whether an image can be used, judged by its grey values.
ImageDefect fault_of(ImageView<const std::uint16_t> image);

}  // namespace pharos::host
