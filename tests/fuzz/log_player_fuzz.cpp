// SPDX-License-Identifier: Apache-2.0
// Any bytes as an LCM log: an InputError, or a replay from start to end and from any place, which never goes back.
#include <cstdint>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/view/log_player.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos;
  const test::MemoryFile file(data, size);
  try {
    tools::LogPlayer player(file.path());
    const double duration_s = player.state().duration_s;
    test::require(duration_s >= 0.0);
    for (const double part : {0.5, 0.0, 1.0}) {
      tools::ControlRequest request;
      request.seek_s = part * duration_s;
      player.control(request);
      test::require(player.state().position_s <= duration_s);
      player.advance(duration_s / 7.0);
    }
  } catch (const host::InputError& error) {
    test::require(error.what()[0] != '\0');
  }
  return 0;
}
