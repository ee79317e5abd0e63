// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publish_gate.hpp"

#include <cstdlib>

namespace pharos::host {

bool PublishGate::fresh(std::int64_t age_ns) {
  if (!limit_ || std::abs(age_ns) <= limit_->max_age_ns) return true;
  ++limit_->stale;
  return false;
}

}  // namespace pharos::host
