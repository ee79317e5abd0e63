# SPDX-License-Identifier: Apache-2.0
# First instructions of the verifier: called by the loader as a function, on a stack of its own.
  .section .text.start, "ax"
  .globl _start
_start:
  la    t0, __stack_top
  sw    sp, -4(t0)
  sw    ra, -8(t0)
  addi  sp, t0, -16
  call  pharos_verifier
  lw    ra, 8(sp)
  lw    sp, 12(sp)
  ret
