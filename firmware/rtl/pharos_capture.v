// SPDX-License-Identifier: Apache-2.0
// Edge capture for up to 32 photodiodes: both edges of every input stamped by a free-running counter of `clock`, all
// edges of one tick in one record, records in a FIFO of block RAM, read over a register bus.
//
// Registers and bus: capture_queue.v. Reset: synchronous, active high. Everything runs on the one clock; only `pins` is
// asynchronous to it.
`default_nettype none

module pharos_capture #(
    parameter INPUTS = 12,        // 1 to 32
    parameter DEPTH = 512,        // records, a power of two, 2 to 32,768
    parameter FILTER_WIDTH = 4,   // bits of the glitch filter's length, 1 to 16
    parameter LOST_WIDTH = 32     // bits of the counter of lost edges, 6 to 32
) (
    input  wire              clock,
    input  wire              reset,
    input  wire [INPUTS-1:0] pins,
    input  wire [       3:0] bus_address,
    input  wire              bus_read,
    input  wire              bus_write,
    input  wire [      31:0] bus_writedata,
    output wire [      31:0] bus_readdata,
    output wire              bus_irq
);

  // Ticks since reset; records carry the low half. Simulation may set it, to reach a wrap soon.
  reg [63:0] ticks  /* verilator public_flat_rw */;
  always @(posedge clock)
    if (reset) ticks <= 64'd0;
    else ticks <= ticks + 64'd1;

  wire [INPUTS-1:0] levels  /* verilator public_flat_rd */;
  wire [INPUTS-1:0] changed  /* verilator public_flat_rd */;
  wire [INPUTS-1:0] watched;
  wire [FILTER_WIDTH-1:0] filter_length;
  wire glitch;
  capture_inputs #(
      .INPUTS(INPUTS),
      .FILTER_WIDTH(FILTER_WIDTH)
  ) inputs (
      .clock(clock),
      .reset(reset),
      .pins(pins),
      .watched(watched),
      .filter_length(filter_length),
      .levels(levels),
      .changed(changed),
      .glitch(glitch)
  );

  wire at_time;
  capture_queue #(
      .INPUTS(INPUTS),
      .DEPTH(DEPTH),
      .FILTER_WIDTH(FILTER_WIDTH),
      .LOST_WIDTH(LOST_WIDTH)
  ) queue (
      .clock(clock),
      .reset(reset),
      .stamp(ticks[31:0]),
      .changed(changed),
      .levels(levels),
      .lost_before({LOST_WIDTH{1'b0}}),
      .levels_now(levels),
      .glitch(glitch),
      .now(ticks),
      .watched(watched),
      .filter(filter_length),
      .at_time(at_time),
      .bus_address(bus_address),
      .bus_read(bus_read),
      .bus_write(bus_write),
      .bus_writedata(bus_writedata),
      .bus_readdata(bus_readdata),
      .bus_irq(bus_irq)
  );

  wire unused = &{1'b0, at_time};

endmodule
`default_nettype wire
