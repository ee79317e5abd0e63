// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/result.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::test {

// Each prints what one part of the core makes of an input that is the same bits on every machine.
void decoder_vectors();
void pose_vectors();
void track_vectors();

void print_answer(const Result<LighthousePoseEstimate, pose::Refusal>& answer);

}  // namespace pharos::test
