// SPDX-License-Identifier: Apache-2.0
#include "tools/bench/peer_module.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace pharos::tools {

PeerFunction load_peers() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return nullptr;
  // Never closed: the function is used until the program ends.
  void* module = dlopen((program.parent_path() / kPeerModuleName).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return nullptr;
  return reinterpret_cast<PeerFunction>(dlsym(module, kPeerFunctionName));
}

}  // namespace pharos::tools
