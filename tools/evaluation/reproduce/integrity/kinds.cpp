// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/ellipse_kind.hpp"
#include "tools/evaluation/reproduce/integrity/pointing_kind.hpp"
#include "tools/evaluation/reproduce/integrity/ring2_kind.hpp"
#include "tools/evaluation/reproduce/integrity/tof_kind.hpp"

namespace pharos::tools {

const std::vector<IntegrityKind>& integrity_kinds() {
  static const std::vector<IntegrityKind> kinds = {ring2_kind(), pointing_kind(), ellipse_kind(), tof_kind()};
  return kinds;
}

}  // namespace pharos::tools
