// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before a function that a soft core should run from on-chip memory: the linker script puts the section `.hot` there.
/// For firmware that has room for it (PharosCompile.cmake); else nothing.
#ifdef PHAROS_HOT_ON_CHIP
#define PHAROS_HOT [[gnu::section(".hot")]]
#else
#define PHAROS_HOT
#endif
