// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <string>

namespace pharos::host {

struct ModuleFunction {
  void* function = nullptr;
  std::string why_not;  // set when there is none
};

/// Looks for a function of a library that only few commands need (cmake: pharos_module): beside the program, in
/// ../lib/pharos where it is installed, or in ../bin for the tests of a build tree. Never unloaded.
inline ModuleFunction find_module_function(const std::string& library, const char* function) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  ModuleFunction result;
  for (const std::filesystem::path& place :
       {folder, folder.parent_path() / "lib" / "pharos", folder.parent_path() / "bin"}) {
    void* module = dlopen((place / library).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) result.function = dlsym(module, function);
    if (result.function != nullptr) return result;
    if (result.why_not.empty() || std::filesystem::exists(place / library, error)) result.why_not = dlerror();
  }
  return result;
}

}  // namespace pharos::host
