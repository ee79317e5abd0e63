// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a JPEG.
bool is_jpeg(std::span<const std::uint8_t> bytes);

/// See decode_picture. Grey or colour of 8 bits; files for print (CMYK) are refused.
Picture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::host
