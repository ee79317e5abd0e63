// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "firmware/board/rv32/restart.hpp"
#include "firmware/board/rv32/stack_mark.hpp"
#include "firmware/hal/system.hpp"

namespace pharos::board {

/// Functions that are the same on every board, from the loader's retained data and from the stack's mark.
class CommonSystem : public hal::System {
 public:
  void confirm_start() override { boot::confirm_start(retained()); }
  void restart(bool stay_in_loader) override {
    boot::announce_reset(retained(), wire::ResetCause::kCommand, stay_in_loader);
    reset_machine();
  }
  wire::ResetCause reset_cause() override { return boot::last_reset(retained()); }
  std::uint16_t start_count() override { return static_cast<std::uint16_t>(retained().start_count); }
  std::uint32_t stack_never_used_bytes() override { return board::stack_never_used_bytes(); }
  std::uint32_t unique_id() override { return 0; }

 protected:
  ~CommonSystem() = default;
};

}  // namespace pharos::board
