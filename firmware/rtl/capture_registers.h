// SPDX-License-Identifier: Apache-2.0
// Register map of the capture block (capture_queue.v): byte offsets from its base, 32-bit words, read and written
// whole. The only definition for both board code and tests; tests/rtl/register_map.py checks Verilog and README against
// it.
#ifndef PHAROS_FIRMWARE_RTL_CAPTURE_REGISTERS_H
#define PHAROS_FIRMWARE_RTL_CAPTURE_REGISTERS_H

/* Offsets. R: read only; RW: reads back what was written; every other word of the 64 bytes reads 0. */
#define PHAROS_CAPTURE_ID_OFFSET 0x00           /* R: PHAROS_CAPTURE_ID, tells that the block is there */
#define PHAROS_CAPTURE_BUILD_OFFSET 0x04        /* R: what this block was built with */
#define PHAROS_CAPTURE_CONTROL_OFFSET 0x08      /* RW: enable; write-only clear of the FIFO */
#define PHAROS_CAPTURE_THRESHOLD_OFFSET 0x0C    /* RW: records from which the interrupt line is high; 0: never */
#define PHAROS_CAPTURE_STATUS_OFFSET 0x10       /* R: count and flags; writing OVERFLOW clears that flag */
#define PHAROS_CAPTURE_FIFO_TIME_OFFSET 0x14    /* R: oldest record: stamp in ticks; 0 when there is none */
#define PHAROS_CAPTURE_FIFO_CHANGED_OFFSET 0x18 /* R: oldest record: inputs that changed; 0 only when there is none */
#define PHAROS_CAPTURE_FIFO_LEVELS_OFFSET 0x1C  /* R: oldest record: levels after it; READING REMOVES THE RECORD */
#define PHAROS_CAPTURE_LOST_OFFSET 0x20         /* R: edges lost since reset, stays at its maximum */
#define PHAROS_CAPTURE_TIME_LOW_OFFSET 0x24     /* R: tick counter, low word; latches the high word */
#define PHAROS_CAPTURE_TIME_HIGH_OFFSET 0x28    /* R: high word as latched by the last read of TIME_LOW */
#define PHAROS_CAPTURE_LEVELS_OFFSET 0x2C       /* R: levels of all inputs now, one bit each */
#define PHAROS_CAPTURE_INPUT_ENABLE_OFFSET 0x30 /* RW: inputs whose edges are recorded, one bit each; all at reset */
#define PHAROS_CAPTURE_FILTER_OFFSET 0x34   /* RW: levels held for no more than this many ticks are dropped; 0: off */
#define PHAROS_CAPTURE_GLITCHES_OFFSET 0x38 /* R: ticks in which the filter dropped something; stays at 65,535 */

#define PHAROS_CAPTURE_ID 0x50484350 /* "PHCP" */

/* BUILD */
#define PHAROS_CAPTURE_BUILD_INPUTS_MASK 0x000000FF
#define PHAROS_CAPTURE_BUILD_DEPTH_LOG2_SHIFT 8
#define PHAROS_CAPTURE_BUILD_DEPTH_LOG2_MASK 0x0000FF00
#define PHAROS_CAPTURE_BUILD_FILTER_WIDTH_SHIFT 16
#define PHAROS_CAPTURE_BUILD_FILTER_WIDTH_MASK 0x00FF0000
#define PHAROS_CAPTURE_BUILD_VERSION_SHIFT 24
#define PHAROS_CAPTURE_VERSION 1 /* of this map; another number is another map */

/* CONTROL */
#define PHAROS_CAPTURE_CONTROL_ENABLE 0x00000001
#define PHAROS_CAPTURE_CONTROL_CLEAR_FIFO 0x00000002 /* reads 0; an edge of that very tick goes with the records */

/* STATUS: a record is read as the four words from STATUS on, in order. */
#define PHAROS_CAPTURE_STATUS_COUNT_MASK 0x0000FFFF
#define PHAROS_CAPTURE_STATUS_GAP 0x00010000 /* between the oldest record and the one before it edges are missing */
#define PHAROS_CAPTURE_STATUS_OVERFLOW 0x00020000 /* edges were lost since this was last cleared */
#define PHAROS_CAPTURE_STATUS_GAP_NEXT 0x00040000 /* the next record to be stored will carry GAP */

/* A record stamped t says: the pins changed during tick t - PHAROS_CAPTURE_LATENCY_TICKS - FILTER. */
#define PHAROS_CAPTURE_LATENCY_TICKS 3
/* A record stamped t is counted in STATUS from tick t + this on. */
#define PHAROS_CAPTURE_VISIBLE_AFTER_TICKS 2

#endif
