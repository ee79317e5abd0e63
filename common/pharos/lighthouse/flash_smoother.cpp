// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_smoother.hpp"

namespace pharos::lighthouse {

SmoothedFlash FlashSmoother::push(const Sweep& sweep) {
  return {0.0, static_cast<double>(sweep.period_sixteenth_ticks) / 16.0};
}

}  // namespace pharos::lighthouse
