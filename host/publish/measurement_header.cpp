// SPDX-License-Identifier: Apache-2.0
#include "host/publish/measurement_header.hpp"

namespace pharos::host {

std::string status_word(const MeasurementHeader& header) {
  if (!header.answered()) return "refused_" + header.refusal;
  return header.ambiguous ? "ambiguous" : "ok";
}

}  // namespace pharos::host
