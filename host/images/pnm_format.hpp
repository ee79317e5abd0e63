// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a binary PGM or PPM.
bool is_pnm(std::span<const std::uint8_t> bytes);

/// See decode_picture.
Picture decode_pnm(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::host
