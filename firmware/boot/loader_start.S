# SPDX-License-Identifier: Apache-2.0
# First instructions after reset. Any fault in the loader restarts here.
  .option arch, +zicsr
  .section .text.start, "ax"
  .globl _start
_start:
  csrw  mie, zero
  .option push
  .option norelax
  la    gp, __global_pointer$
  .option pop
  la    sp, __retained
  la    t0, _start
  csrw  mtvec, t0
  la    t0, __loader_start
1:sw    zero, 0(t0)
  addi  t0, t0, 4
  bne   t0, sp, 1b
  j     pharos_loader
