// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/config/load_config.hpp"
#include "host/support/input_error.hpp"

namespace {

pharos::host::CameraFile a_camera() {
  pharos::host::CameraFile file;
  file.camera.intrinsics.width_px = 640;
  file.camera.intrinsics.height_px = 480;
  return file;
}

}  // namespace

// Any bytes are either a configuration that can be printed or an InputError of one line; never anything else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const pharos::host::Environment nothing{[](const std::string&) { return pharos::host::TargetFile{}; },
                                          [](const std::filesystem::path&, const std::string&) {},
                                          [](const std::string& path) { return path; },
                                          pharos::host::Environment::no_calibration,
                                          [](const std::string&) { return a_camera(); },
                                          [](const std::filesystem::path&, const std::string&) { return true; },
                                          [](const std::string&) { return pharos::host::RigFile{}; }};
  try {
    const auto config = pharos::host::parse_daemon_config(text, "fuzz.toml", "/nowhere", nothing);
    const bool nothing_to_do = config.targets.empty() && config.cameras.empty() && config.telescopes.empty() &&
                               config.stereos.empty() && config.remotes.empty();
    if (nothing_to_do || pharos::host::describe(config).empty()) std::abort();
  } catch (const pharos::host::InputError& error) {
    if (std::string_view(error.what()).rfind("fuzz.toml:", 0) != 0) std::abort();
  }
  return 0;
}
