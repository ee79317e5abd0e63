// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/result.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::test {

// Each prints the results of one part of the core for an input that is identical on every machine.
void decoder_vectors();
void pose_vectors();
void track_vectors();

void print_result(const Result<LighthousePoseEstimate, pose::Refusal>& result);

}  // namespace pharos::test
