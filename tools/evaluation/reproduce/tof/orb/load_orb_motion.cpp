// SPDX-License-Identifier: Apache-2.0
#include "host/support/module_function.hpp"
#include "tools/evaluation/reproduce/tof/orb/orb_motion.hpp"

namespace pharos::tools {

OrbMotionFunction load_orb_motion() {
  return reinterpret_cast<OrbMotionFunction>(host::find_module_function(kOrbModuleName, kOrbFunctionName).function);
}

}  // namespace pharos::tools
