// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "host/support/module_function.hpp"
#include "tools/evaluation/bench/edge_drawing.hpp"

namespace pharos::tools {

EdgeDrawingFunction load_edge_drawing() {
  const host::ModuleFunction found = host::find_module_function(kEdgeDrawingModule, kEdgeDrawingName);
  if (found.function == nullptr) {
    std::fprintf(stderr, "pharos bench: no EdgeDrawing beside ours: %s\n", found.why_not.c_str());
  }
  return reinterpret_cast<EdgeDrawingFunction>(found.function);
}

}  // namespace pharos::tools
