// SPDX-License-Identifier: Apache-2.0
#include "tools/bench/peer_module.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace pharos::tools {

namespace {

void* function_named(const char* name) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return nullptr;
  // Never closed: the function is used until the program ends.
  void* module = dlopen((program.parent_path() / kPeerModuleName).c_str(), RTLD_NOW | RTLD_LOCAL);
  return module == nullptr ? nullptr : dlsym(module, name);
}

}  // namespace

PeerFunction load_peers() { return reinterpret_cast<PeerFunction>(function_named(kPeerFunctionName)); }

EdgeDrawingFunction load_edge_drawing() {
  return reinterpret_cast<EdgeDrawingFunction>(function_named(kEdgeDrawingName));
}

}  // namespace pharos::tools
