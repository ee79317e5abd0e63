// SPDX-License-Identifier: Apache-2.0
// Edge capture for up to 32 photodiodes: both edges of every input stamped by a free-running counter of `clock`, all
// edges of one tick in one record, records in a FIFO of block RAM, read over a register bus.
//
// Register map: capture_registers.h. Bus: Avalon-MM agent timing, word addresses, fixed read latency of 1, no wait
// states. Reset: synchronous, active high. Everything runs on the one clock; only `pins` is asynchronous to it.
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
    output reg  [      31:0] bus_readdata,
    output reg               bus_irq
);

  localparam COUNT_WIDTH = $clog2(DEPTH) + 1;
  localparam RECORD_WIDTH = 1 + 32 + 2 * INPUTS;

  localparam [31:0] ID = 32'h50484350;
  localparam [31:0] BUILD = (32'd1 << 24) | (FILTER_WIDTH << 16) | ($clog2(DEPTH) << 8) | INPUTS;  // version 1

  localparam [3:0] ADDRESS_ID = 4'h0;
  localparam [3:0] ADDRESS_BUILD = 4'h1;
  localparam [3:0] ADDRESS_CONTROL = 4'h2;
  localparam [3:0] ADDRESS_THRESHOLD = 4'h3;
  localparam [3:0] ADDRESS_STATUS = 4'h4;
  localparam [3:0] ADDRESS_FIFO_TIME = 4'h5;
  localparam [3:0] ADDRESS_FIFO_CHANGED = 4'h6;
  localparam [3:0] ADDRESS_FIFO_LEVELS = 4'h7;
  localparam [3:0] ADDRESS_LOST = 4'h8;
  localparam [3:0] ADDRESS_TIME_LOW = 4'h9;
  localparam [3:0] ADDRESS_TIME_HIGH = 4'hA;
  localparam [3:0] ADDRESS_LEVELS = 4'hB;
  localparam [3:0] ADDRESS_INPUT_ENABLE = 4'hC;
  localparam [3:0] ADDRESS_FILTER = 4'hD;
  localparam [3:0] ADDRESS_GLITCHES = 4'hE;

  localparam CONTROL_ENABLE = 0;
  localparam CONTROL_CLEAR_FIFO = 1;
  localparam STATUS_OVERFLOW = 17;

  // Set from the bus.
  reg enabled;
  reg [COUNT_WIDTH-1:0] threshold;
  reg [INPUTS-1:0] input_enable;
  reg [FILTER_WIDTH-1:0] filter_length;

  wire write_control = bus_write && bus_address == ADDRESS_CONTROL;
  wire write_input_enable = bus_write && bus_address == ADDRESS_INPUT_ENABLE;
  wire clear_fifo = write_control && bus_writedata[CONTROL_CLEAR_FIFO];
  wire clear_overflow = bus_write && bus_address == ADDRESS_STATUS && bus_writedata[STATUS_OVERFLOW];

  always @(posedge clock)
    if (reset) begin
      enabled       <= 1'b0;
      threshold     <= {COUNT_WIDTH{1'b0}};
      input_enable  <= {INPUTS{1'b1}};
      filter_length <= {FILTER_WIDTH{1'b0}};
    end else begin
      if (write_control) enabled <= bus_writedata[CONTROL_ENABLE];
      if (bus_write && bus_address == ADDRESS_THRESHOLD) threshold <= bus_writedata[COUNT_WIDTH-1:0];
      if (write_input_enable) input_enable <= bus_writedata[INPUTS-1:0];
      if (bus_write && bus_address == ADDRESS_FILTER) filter_length <= bus_writedata[FILTER_WIDTH-1:0];
    end

  // Ticks since reset; records carry the low half. Simulation may set it, to reach a wrap soon.
  reg [63:0] ticks  /* verilator public_flat_rw */;
  reg [31:0] ticks_high_latched;
  always @(posedge clock)
    if (reset) begin
      ticks              <= 64'd0;
      ticks_high_latched <= 32'd0;
    end else begin
      ticks <= ticks + 64'd1;
      if (bus_read && bus_address == ADDRESS_TIME_LOW) ticks_high_latched <= ticks[63:32];
    end

  // Pins to edges to records.
  wire [INPUTS-1:0] levels;
  wire [INPUTS-1:0] changed;
  wire glitch;
  capture_inputs #(
      .INPUTS(INPUTS),
      .FILTER_WIDTH(FILTER_WIDTH)
  ) inputs (
      .clock(clock),
      .reset(reset),
      .pins(pins),
      .watched(enabled ? input_enable : {INPUTS{1'b0}}),
      .filter_length(filter_length),
      .levels(levels),
      .changed(changed),
      .glitch(glitch)
  );

  wire full;
  wire gap;
  wire [RECORD_WIDTH-1:0] head;
  wire [COUNT_WIDTH-1:0] count  /* verilator public_flat_rd */;
  capture_fifo #(
      .WIDTH(RECORD_WIDTH),
      .DEPTH(DEPTH)
  ) fifo (
      .clock(clock),
      .clear(reset || clear_fifo),
      .write(|changed),
      .write_data({gap, ticks[31:0], changed, levels}),
      .full(full),
      .pop(bus_read && bus_address == ADDRESS_FIFO_LEVELS),
      .head(head),
      .count(count)
  );

  wire overflow;
  wire [LOST_WIDTH-1:0] lost;
  capture_losses #(
      .INPUTS(INPUTS),
      .LOST_WIDTH(LOST_WIDTH)
  ) losses (
      .clock(clock),
      .reset(reset),
      .changed(changed),
      .full(full),
      .interrupted(!enabled || clear_fifo || write_input_enable),
      .clear_overflow(clear_overflow),
      .overflow(overflow),
      .gap(gap),
      .lost(lost)
  );

  reg [15:0] glitches;
  always @(posedge clock)
    if (reset) glitches <= 16'd0;
    else if (glitch && !(&glitches)) glitches <= glitches + 16'd1;

  always @(posedge clock)
    if (reset) bus_irq <= 1'b0;
    else bus_irq <= threshold != 0 && count >= threshold;

  // Read data of the bus.
  wire some = count != 0;
  wire [31:0] head_time = head[2*INPUTS+:32];
  wire [INPUTS-1:0] head_changed = head[INPUTS+:INPUTS];
  wire [INPUTS-1:0] head_levels = head[0+:INPUTS];
  wire head_gap = head[RECORD_WIDTH-1];

  reg [31:0] answer;
  always @* begin
    answer = 32'd0;
    case (bus_address)
      ADDRESS_ID: answer = ID;
      ADDRESS_BUILD: answer = BUILD;
      ADDRESS_CONTROL: answer[CONTROL_ENABLE] = enabled;
      ADDRESS_THRESHOLD: answer[COUNT_WIDTH-1:0] = threshold;
      ADDRESS_STATUS: begin
        answer[COUNT_WIDTH-1:0] = count;
        answer[18:16] = {gap, overflow, some && head_gap};
      end
      ADDRESS_FIFO_TIME: if (some) answer = head_time;
      ADDRESS_FIFO_CHANGED: if (some) answer[INPUTS-1:0] = head_changed;
      ADDRESS_FIFO_LEVELS: if (some) answer[INPUTS-1:0] = head_levels;
      ADDRESS_LOST: answer[LOST_WIDTH-1:0] = lost;
      ADDRESS_TIME_LOW: answer = ticks[31:0];
      ADDRESS_TIME_HIGH: answer = ticks_high_latched;
      ADDRESS_LEVELS: answer[INPUTS-1:0] = levels;
      ADDRESS_INPUT_ENABLE: answer[INPUTS-1:0] = input_enable;
      ADDRESS_FILTER: answer[FILTER_WIDTH-1:0] = filter_length;
      ADDRESS_GLITCHES: answer[15:0] = glitches;
      default: answer = 32'd0;
    endcase
  end

  always @(posedge clock)
    if (reset) bus_readdata <= 32'd0;
    else bus_readdata <= answer;

endmodule
`default_nettype wire
