// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocation_guard.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

namespace pharos::test {
namespace {

// Keeps the compiler from removing an allocation whose result is not used.
void keep(void* block) { asm volatile("" : : "r"(block) : "memory"); }

TEST(AllocationGuard, CountsNothingWhereNothingIsTaken) {
  const AllocationGuard guard;
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Identity();
  keep(matrix.data());
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(AllocationGuard, FiresOnNew) {
  const AllocationGuard guard;
  const auto one = std::make_unique<int>(1);
  keep(one.get());
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST(AllocationGuard, FiresOnMallocAndItsRelatives) {
  const AllocationGuard guard;
  void* block = std::malloc(8);
  keep(block);
  block = std::realloc(block, 4096);
  keep(block);
  std::free(block);
  block = std::calloc(2, 8);
  keep(block);
  std::free(block);
  block = std::aligned_alloc(64, 128);
  keep(block);
  std::free(block);
  EXPECT_EQ(guard.allocations(), 4u);
}

TEST(AllocationGuard, FiresOnAContainerThatGrows) {
  std::vector<int> numbers;
  const AllocationGuard guard;
  numbers.push_back(1);
  keep(numbers.data());
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST(AllocationGuard, FiresOnEigenMatricesWithoutFixedSize) {
  const AllocationGuard guard;
  Eigen::MatrixXd matrix(6, 6);
  keep(matrix.data());
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST(AllocationGuard, CountsItsOwnThreadOnly) {
  std::size_t in_thread = 0;
  std::thread other;
  const AllocationGuard guard;
  other = std::thread([&in_thread] {
    const AllocationGuard own;
    for (int i = 0; i < 1000; ++i) keep(std::make_unique<int>(i).get());
    in_thread = own.allocations();
  });
  other.join();
  EXPECT_EQ(in_thread, 1000u);
  EXPECT_LT(guard.allocations(), 1000u);
}

}  // namespace
}  // namespace pharos::test
