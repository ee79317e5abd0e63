// SPDX-License-Identifier: Apache-2.0
// What the bus sees of the capture block: its registers, the FIFO of records, and the count of what was lost. Edges and time
// come from outside, in this clock.
//
// Register map: capture_registers.h. Bus: Avalon-MM agent timing, word addresses, fixed read latency of 1, no wait
// states. Reset: synchronous, active high.
`default_nettype none

module capture_queue #(
    parameter INPUTS = 12,        // 1 to 32
    parameter DEPTH = 512,        // records, a power of two, 2 to 32,768
    parameter FILTER_WIDTH = 4,   // bits of the glitch filter's length, 1 to 16; 0: there is no filter
    parameter LOST_WIDTH = 32     // bits of the counter of lost edges, 6 to 32
) (
    input  wire                                                clock,
    input  wire                                                reset,
    // Edges of this tick.
    input  wire [                                        31:0] stamp,
    input  wire [                                  INPUTS-1:0] changed,
    input  wire [                                  INPUTS-1:0] levels,         // after it
    input  wire [                              LOST_WIDTH-1:0] lost_before,    // edges that got lost on their way here
    input  wire [                                  INPUTS-1:0] levels_now,
    input  wire                                                glitch,
    input  wire [                                        63:0] now,
    output wire [                                  INPUTS-1:0] watched,        // inputs whose edges are wanted
    output wire [(FILTER_WIDTH == 0 ? 1 : FILTER_WIDTH) - 1:0] filter,
    output wire                                                at_time,        // the address is that of TIME_LOW
    input  wire [                                         3:0] bus_address,
    input  wire                                                bus_read,
    input  wire                                                bus_write,
    input  wire [                                        31:0] bus_writedata,
    output reg  [                                        31:0] bus_readdata,
    output reg                                                 bus_irq
);

  localparam COUNT_WIDTH = $clog2(DEPTH) + 1;
  localparam RECORD_WIDTH = 1 + 32 + 2 * INPUTS;
  localparam FILTER_BITS = FILTER_WIDTH == 0 ? 1 : FILTER_WIDTH;

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
  reg [FILTER_BITS-1:0] filter_length;

  wire write_control = bus_write && bus_address == ADDRESS_CONTROL;
  wire write_input_enable = bus_write && bus_address == ADDRESS_INPUT_ENABLE;
  wire clear_fifo = write_control && bus_writedata[CONTROL_CLEAR_FIFO];
  wire clear_overflow = bus_write && bus_address == ADDRESS_STATUS && bus_writedata[STATUS_OVERFLOW];

  always @(posedge clock)
    if (reset) begin
      enabled       <= 1'b0;
      threshold     <= {COUNT_WIDTH{1'b0}};
      input_enable  <= {INPUTS{1'b1}};
      filter_length <= {FILTER_BITS{1'b0}};
    end else begin
      if (write_control) enabled <= bus_writedata[CONTROL_ENABLE];
      if (bus_write && bus_address == ADDRESS_THRESHOLD) threshold <= bus_writedata[COUNT_WIDTH-1:0];
      if (write_input_enable) input_enable <= bus_writedata[INPUTS-1:0];
      if (FILTER_WIDTH != 0 && bus_write && bus_address == ADDRESS_FILTER) filter_length <= bus_writedata[FILTER_BITS-1:0];
    end

  assign watched = enabled ? input_enable : {INPUTS{1'b0}};
  assign filter = filter_length;
  assign at_time = bus_address == ADDRESS_TIME_LOW;

  reg [31:0] now_high;
  always @(posedge clock)
    if (reset) now_high <= 32'd0;
    else if (bus_read && at_time) now_high <= now[63:32];

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
      .write_data({gap, stamp, changed, levels}),
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
      .lost_before(lost_before),
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
      ADDRESS_TIME_LOW: answer = now[31:0];
      ADDRESS_TIME_HIGH: answer = now_high;
      ADDRESS_LEVELS: answer[INPUTS-1:0] = levels_now;
      ADDRESS_INPUT_ENABLE: answer[INPUTS-1:0] = input_enable;
      ADDRESS_FILTER: answer[FILTER_BITS-1:0] = filter_length;
      ADDRESS_GLITCHES: answer[15:0] = glitches;
      default: answer = 32'd0;
    endcase
  end

  always @(posedge clock)
    if (reset) bus_readdata <= 32'd0;
    else bus_readdata <= answer;

endmodule
`default_nettype wire
