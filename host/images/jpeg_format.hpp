// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin as a JPEG does.
bool is_jpeg(std::span<const std::uint8_t> bytes);

/// See decode_picture. Grey or colour of 8 bits; what was made for print (CMYK) is refused.
Picture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::host
