// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "host/support/input_error.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::host {

/// What every command says of left and right images that cannot be a rig's.
enum class PairFault : std::uint8_t { kNone, kExchanged, kEqual };

/// In words for people: what it is and how it shows; empty for none.
std::string text_of(PairFault fault);

/// Left and right images that were read and cannot be a rig's: exchanged, equal, or out of step. Commands end with 1,
/// as no answer can be had of such images, where other invalid input ends them with 2.
class NoPairError : public InputError {
 public:
  using InputError::InputError;
};

/// kEqual where both images have the same pixels: noise alone makes two cameras' images differ.
PairFault pair_fault(const std::array<ImageView<const std::uint16_t>, 2>& images);
/// kExchanged where the right camera stands on the left camera's left: `right_in_left_m` is its position in the left
/// camera's frame. A camera more above or below than beside the other is on neither side.
PairFault pair_fault(const std::array<double, 3>& right_in_left_m);

}  // namespace pharos::host
