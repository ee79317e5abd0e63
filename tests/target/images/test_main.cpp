// SPDX-License-Identifier: Apache-2.0
// Runs every case of the image under QEMU and ends the machine with 0 when all passed.
#include <bit>
#include <cstdint>
#include <cstdio>

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "gtest/gtest.h"

namespace testing {

void Test::RecordProperty(const char* key, int value) { std::printf("  %s %d\n", key, value); }

namespace internal {
namespace {

bool failed = false;
bool skipped = false;

}  // namespace

std::vector<Case>& cases() {
  static std::vector<Case> list;
  return list;
}

void broken(const char* what) {
  std::printf("%s\n", what);
  pharos::board::exit_emulator(1);
}

void Verdict::operator=(const Message& message) const {
  (kind_ == kFailed ? failed : skipped) = true;
  std::printf("%s:%d: %s %s\n", file_, line_, what_.c_str(), message.text().c_str());
}

bool EqualDoubles::operator()(double a, double b) const {
  if (std::isnan(a) || std::isnan(b)) return false;
  // From sign and magnitude to one ascending scale.
  const auto place = [](double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
    return (bits & kSign) != 0 ? ~bits + 1 : bits | kSign;
  };
  const std::uint64_t x = place(a);
  const std::uint64_t y = place(b);
  return (x > y ? x - y : y - x) <= 4;
}

bool run(const Case& test) {
  failed = skipped = false;
  std::printf("[ RUN      ] %s\n", test.name.c_str());
  const std::uint64_t before = pharos::board::instructions_retired();
  const auto fixture = test.make();
  fixture->SetUp();
  if (!failed && !skipped) fixture->TestBody();
  fixture->TearDown();
  const auto thousands = static_cast<unsigned long>((pharos::board::instructions_retired() - before) / 1000);
  const char* const verdict = failed ? " FAILED " : skipped ? "SKIPPED " : "      OK";
  std::printf("[ %s ] %s (%lu k instructions)\n", verdict, test.name.c_str(), thousands);
  return !failed;
}

}  // namespace internal
}  // namespace testing

// Cases that this image leaves out, ending with null; by CMakeLists.txt.
extern const char* const kLeftOut[];

int main() {
  using testing::internal::Case;
  using testing::internal::cases;
  for (const char* const* name = kLeftOut; *name != nullptr; ++name) {
    if (std::erase_if(cases(), [&](const Case& test) { return test.name == *name; }) == 0) {
      std::printf("there is no case %s to leave out\n", *name);
      return 1;
    }
    std::printf("[ LEFT OUT ] %s\n", *name);
  }
  std::size_t failures = 0;
  for (const auto& test : cases()) failures += testing::internal::run(test) ? 0u : 1u;
  std::printf("%zu of %zu tests passed on RV32IM\n", cases().size() - failures, cases().size());
  return failures == 0 && !cases().empty() ? 0 : 1;
}
