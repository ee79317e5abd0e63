// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/camera_module.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "host/support/input_error.hpp"

namespace pharos::sim {

CameraPlaySummary serve_camera_by_module(const FrameReel& reel, const CameraPlay& play) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path folder = program.parent_path();
  void* module = nullptr;
  // In the build tree beside the program, installed in lib/pharos.
  for (const std::filesystem::path& place : {folder, folder.parent_path() / "lib" / "pharos"}) {
    if (module == nullptr) module = ::dlopen((place / kCameraModuleName).c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  void* function = module == nullptr ? nullptr : ::dlsym(module, kCameraFunctionName);
  if (function == nullptr) throw host::InputError("the simulated camera is not there: " + std::string(::dlerror()));
  CameraPlaySummary summary;
  reinterpret_cast<CameraFunction>(function)(reel, play, summary);
  return summary;
}

}  // namespace pharos::sim
