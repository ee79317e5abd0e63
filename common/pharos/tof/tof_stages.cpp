// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_stages.hpp"

#include <array>

namespace pharos::tof {
namespace {

// In the order of TofStage.
constexpr std::array<const char*, kTofStages> kNames = {"check", "edges", "ellipses",  "plane",
                                                        "ring",  "face",  "connector", "pose"};
static_assert(static_cast<std::size_t>(TofStage::kPose) + 1 == kTofStages);

}  // namespace

const char* name_of(TofStage stage) { return kNames[static_cast<std::size_t>(stage)]; }

}  // namespace pharos::tof
