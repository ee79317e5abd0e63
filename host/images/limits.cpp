// SPDX-License-Identifier: Apache-2.0
#include "host/images/limits.hpp"

#include "host/support/input_error.hpp"

namespace pharos::host {

void require_readable_size(std::size_t width_px, std::size_t height_px, const std::string& name) {
  constexpr auto kMaxSide = static_cast<std::size_t>(kMaxImageSide_px);
  if (width_px == 0 || height_px == 0) throw InputError(name + ": has no pixels; save or copy it again");
  if (width_px <= kMaxSide && height_px <= kMaxSide && width_px * height_px <= kMaxImagePixels) return;
  throw InputError(name + ": claims " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                   " pixels; at most " + std::to_string(kMaxImagePixels) + " and " + std::to_string(kMaxImageSide_px) +
                   " a side are read: cut it or scale it down");
}

void refuse_damaged(const std::string& name, const char* kind, const std::string& why) {
  throw InputError(name + ": damaged " + kind + " (" + why + "); save or copy it again");
}

}  // namespace pharos::host
