// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "host/support/input_error.hpp"

namespace pharos::host {

/// A function of a library that only few commands need, loaded when one of them runs: from beside the program, from
/// ../lib/pharos where it is installed, or from ../bin for the tests of a build tree. Throws InputError saying what is
/// missing. Never unloaded.
inline void* module_function(const std::string& library, const char* function) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::string why;
  for (const std::filesystem::path& place :
       {folder, folder.parent_path() / "lib" / "pharos", folder.parent_path() / "bin"}) {
    void* module = dlopen((place / library).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) {
      void* found = dlsym(module, function);
      if (found != nullptr) return found;
    }
    if (why.empty() || std::filesystem::exists(place / library, error)) why = dlerror();
  }
  throw InputError(library + " cannot be loaded (" + why +
                   "); build or install all of Pharos, and what `tools/install-dependencies build` names");
}

}  // namespace pharos::host
