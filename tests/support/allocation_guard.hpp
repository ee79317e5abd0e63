// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pharos::test {

/// Counts heap allocations of the calling thread (malloc, calloc, realloc, aligned forms, and so operator new and
/// Eigen) between its construction and the call of allocations(). Guards may be nested. Link pharos_allocation_guard.
class AllocationGuard {
 public:
  AllocationGuard();

  /// Allocations of this thread since construction.
  std::size_t allocations() const;

 private:
  std::size_t at_start_;
};

}  // namespace pharos::test
