// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <filesystem>

#include "tools/cli/reproduce/tof/orb/orb_motion.hpp"

namespace pharos::tools {

OrbMotionFunction load_orb_motion() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return nullptr;
  // Never closed: the function is used until the program ends.
  void* module = dlopen((program.parent_path() / kOrbModuleName).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return nullptr;
  return reinterpret_cast<OrbMotionFunction>(dlsym(module, kOrbFunctionName));
}

}  // namespace pharos::tools
