// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/delivery_assessment.hpp"

#include <cmath>

namespace pharos::host {

DeliveryAssessment assess_delivery(std::initializer_list<DeliveryStage> stages) {
  DeliveryAssessment assessment;
  for (const DeliveryStage& stage : stages) {
    const double fraction = stage.count.fraction();
    if (fraction >= kDegradedBelow) continue;
    if (fraction < kErrorBelow) assessment.state = SourceState::kError;
    if (assessment.state == SourceState::kOk) assessment.state = SourceState::kDegraded;
    if (!assessment.message.empty()) continue;
    assessment.message = std::to_string(std::lround(100.0 * fraction)) + " % of the expected " + stage.what +
                         " came in the last " + std::to_string(RollingCount::kWindow_s) + " s; " + stage.where;
  }
  return assessment;
}

}  // namespace pharos::host
