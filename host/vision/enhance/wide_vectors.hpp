// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Attribute of a function with loops that gain from eight floats at a time: it is compiled for AVX2 too, with all
/// functions that it calls, and the loader chooses. Without fused multiply-add, so that both give identical results.
/// Sanitizers are not ready when the loader asks.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PHAROS_WIDE_VECTORS __attribute__((target_clones("avx2", "default"), flatten))
#else
#define PHAROS_WIDE_VECTORS
#endif
