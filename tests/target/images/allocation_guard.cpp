// SPDX-License-Identifier: Apache-2.0
// The target's implementation of tests/support/allocation_guard.hpp. Images are linked with --wrap=malloc: every call
// of malloc, also from operator new, is counted here.
#include "tests/support/allocation_guard.hpp"

namespace {

std::size_t allocation_count = 0;

}  // namespace

extern "C" void* __real_malloc(std::size_t size);
extern "C" void* __wrap_malloc(std::size_t size) {
  ++allocation_count;
  return __real_malloc(size);
}

namespace pharos::test {

AllocationGuard::AllocationGuard() : at_start_(allocation_count) {}

std::size_t AllocationGuard::allocations() const { return allocation_count - at_start_; }

}  // namespace pharos::test
