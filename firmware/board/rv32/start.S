# SPDX-License-Identifier: Apache-2.0
# First instructions after reset or after the loader's jump: stack, trap handler, initial data, constructors, main.
# The value of main is passed to pharos_exit (the board's).
  .option arch, +zicsr

  .section .text.start, "ax"
  .globl _start
_start:
  csrci mstatus, 8                # no interrupts until the program asks for them
  csrw  mie, zero
  .option push
  .option norelax
  la    gp, __global_pointer$
  .option pop
  la    sp, __stack_top
  la    tp, __tls_base            # the C library's errno
  la    t0, pharos_trap
  csrw  mtvec, t0

  la    t0, __data_load           # initial data, and code that runs from on-chip memory
  la    t1, __data_start
  la    t2, __data_end
  beq   t0, t1, 2f                # already where it belongs
1:bgeu  t1, t2, 2f
  lw    t3, 0(t0)
  sw    t3, 0(t1)
  addi  t0, t0, 4
  addi  t1, t1, 4
  j     1b
2:la    t1, __bss_start
  la    t2, __bss_end
3:bgeu  t1, t2, 4f
  sw    zero, 0(t1)
  addi  t1, t1, 4
  j     3b
4:la    t1, __stack_bottom        # for the high-water mark (stack_mark.hpp)
  li    t3, 0x5AA5F00D
5:bgeu  t1, sp, 6f
  sw    t3, 0(t1)
  addi  t1, t1, 4
  j     5b

6:la    s0, __init_array_start
  la    s1, __init_array_end
7:bgeu  s0, s1, 8f
  lw    t0, 0(s0)
  jalr  t0
  addi  s0, s0, 4
  j     7b
8:li    a0, 0
  li    a1, 0
  call  main
  call  pharos_exit
9:j     9b
