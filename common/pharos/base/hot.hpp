// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Precedes a function that a soft core should run from on-chip memory: the linker script puts the section `.hot`
/// there. For firmware with memory for it (PharosCompile.cmake); else empty.
#ifdef PHAROS_HOT_ON_CHIP
#define PHAROS_HOT [[gnu::section(".hot")]]
#else
#define PHAROS_HOT
#endif
