// SPDX-License-Identifier: Apache-2.0
// Any bytes as a table of Lighthouse 2.0's light: changes with times in range, or an InputError of one line.
#include <cstdint>
#include <string_view>

#include "host/support/input_error.hpp"
#include "host/table/lh2_light_reader.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pharos::test::require;
  const pharos::test::MemoryFile file(data, size);
  try {
    pharos::host::Lh2LightReader reader{pharos::host::ByteSource(file.path())};
    while (const auto edge = reader.next()) (void)edge;
    (void)reader.ended_unfinished();
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
