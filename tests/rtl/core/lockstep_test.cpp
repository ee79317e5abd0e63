// SPDX-License-Identifier: Apache-2.0
// Random instructions on the Verilated core and on the reference model.
#include "rtl/core/lockstep.hpp"

#include <gtest/gtest.h>

namespace pharos::rtl {
namespace {

constexpr std::uint64_t kInstructions = 100'000;

TEST(CoreLockstep, AgreesWithTheModelAfterEveryRandomInstruction) {
  Lockstep bench(1);
  ASSERT_TRUE(bench.run_random(kInstructions)) << bench.difference();
  // A kind that was not executed would not have been compared.
  for (std::size_t kind = 0; kind + 3 < kInstructionKinds.size(); ++kind) {
    const auto name = kInstructionKinds[kind].name;
    if (name == "ecall" || name == "ebreak") continue;  // these trap, below
    EXPECT_GT(bench.ended()[kind], kInstructions / 2000) << name;
  }
  for (const std::size_t cause : {0u, 1u, 2u, 3u, 5u, 7u, 11u}) EXPECT_GT(bench.trapped()[cause], 20u) << cause;
  EXPECT_GT(bench.interrupts(), 20u);
}

}  // namespace
}  // namespace pharos::rtl
