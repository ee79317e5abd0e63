// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocation_guard.hpp"

#include <cerrno>
#include <cstdlib>

namespace {

thread_local std::size_t allocation_count = 0;

}  // namespace

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PHAROS_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define PHAROS_ADDRESS_SANITIZER
#endif

#if defined(PHAROS_ADDRESS_SANITIZER)

// The sanitizer defines malloc and has hooks instead. Declared here because clang 14's headers are a separate package.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void* block,
                                                                           std::size_t size),
                                                         void (*on_free)(const volatile void* block));

namespace {

[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { ++allocation_count; }, [](const volatile void*) {});

}  // namespace

#else

// A program may replace malloc and related functions of the C library as a set; the originals have these names.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the C library's names.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) noexcept {
  ++allocation_count;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocation_count;
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) noexcept {
  ++allocation_count;
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
  *block = memalign(alignment, size);
  return *block != nullptr ? 0 : ENOMEM;
}

void free(void* block) noexcept { __libc_free(block); }
}

#endif

namespace pharos::test {

AllocationGuard::AllocationGuard() : at_start_(allocation_count) {}

std::size_t AllocationGuard::allocations() const { return allocation_count - at_start_; }

}  // namespace pharos::test
