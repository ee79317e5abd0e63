// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "host/cameras/camera_file.hpp"
#include "host/cameras/docking_target.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/support/input_error.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;
using namespace pharos::host;

// Any bytes are either a file that is read back as written, or an InputError of one line; never anything else.
template <class Parse, class Write>
void check(std::string_view text, Parse parse, Write write) {
  try {
    const auto file = parse(text, "fuzz.toml");
    const std::string written = write(file);
    require(write(parse(written, "fuzz.toml")) == written);
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz.toml:") && message.find('\n') == std::string_view::npos);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(text, parse_camera, camera_text);
  check(text, parse_rig, rig_text);
  check(text, parse_docking_target, docking_target_text);
  return 0;
}
