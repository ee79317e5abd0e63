// SPDX-License-Identifier: Apache-2.0
// What of the capture block runs at 48 MHz: inputs, their stamps, and the writer's side of a small FIFO.
//
// Stamps are in ticks of 20 ns, as everywhere: the counter goes on by one, and by two in every 24th tick of the clock.
// A record without changed inputs tells how many edges the FIFO had no room for before it, in place of the stamp; it is
// written as soon as there is room, and until then every edge is lost.
`default_nettype none

module capture_front #(
    parameter INPUTS = 4
) (
    input  wire                   clock,
    input  wire                   reset,
    input  wire [     INPUTS-1:0] pins,
    output wire                   write,
    output wire [32+2*INPUTS-1:0] record,         // stamp, changed, levels
    input  wire                   full,
    output wire [     INPUTS-1:0] levels  /* verilator public_flat_rd */,
    // The time, for another clock: a change of time_wanted asks, time_shown equals it when the time stands in time.
    input  wire                   time_wanted,
    output reg                    time_shown,
    output reg  [           63:0] time_ticks
);

  // Short sums: the lower 16 bits run a tick ahead, and each part takes the carry of the one below a tick later.
  // Simulation may set all.
  reg [15:0] ahead  /* verilator public_flat_rw */;  // of the next tick
  reg ahead_carry  /* verilator public_flat_rw */;
  reg [31:0] low  /* verilator public_flat_rw */;
  reg carry  /* verilator public_flat_rw */;
  reg [31:0] high  /* verilator public_flat_rw */;
  reg [4:0] phase;  // 0 to 23
  reg two;
  wire [17:0] next = {1'b0, ahead, two} + {16'd0, 1'b1, two};  // one adder: the lowest bit only makes a carry
  wire [16:0] next_middle = {1'b0, low[31:16]} + {16'd0, ahead_carry};
  always @(posedge clock)
    if (reset) begin
      ahead       <= 16'd1;
      ahead_carry <= 1'b0;
      low         <= 32'd0;
      carry       <= 1'b0;
      high        <= 32'd0;
      phase       <= 5'd0;
      two         <= 1'b0;
    end else begin
      phase       <= two ? 5'd0 : phase + 5'd1;
      two         <= phase == 5'd22;
      ahead       <= next[16:1];
      ahead_carry <= next[17];
      low         <= {next_middle[15:0], ahead};
      carry       <= next_middle[16];
      high        <= high + {31'd0, carry};
    end

  wire [INPUTS-1:0] changed  /* verilator public_flat_rd */;
  wire glitch;
  capture_inputs #(
      .INPUTS(INPUTS),
      .FILTER_WIDTH(1)
  ) inputs (
      .clock(clock),
      .reset(reset),
      .pins(pins),
      .watched({INPUTS{1'b1}}),
      .filter_length(1'b0),
      .levels(levels),
      .changed(changed),
      .glitch(glitch)
  );

  function [5:0] ones(input [INPUTS-1:0] mask);
    integer k;
    begin
      // In logic, not by "+": of four inputs each bit is one table, where adders' carries take 5 ns more, too long before the sum.
      ones = 6'd0;
      for (k = 0; k < INPUTS; k = k + 1)
        ones = ones ^ {&{mask[k], ones[4:0]}, &{mask[k], ones[3:0]}, &{mask[k], ones[2:0]}, &{mask[k], ones[1:0]}, mask[k] & ones[0], mask[k]};
    end
  endfunction

  reg losing;
  reg [15:0] lost;  // stays near its maximum
  wire any = |changed;
  assign write = losing || any;
  assign record = losing ? {16'd0, lost, {INPUTS{1'b0}}, levels} : {low, changed, levels};
  always @(posedge clock)
    if (reset) begin
      losing <= 1'b0;
      lost   <= 16'd0;
    end else begin
      if (losing && !full) lost <= {10'd0, ones(changed)};
      else if (any && (losing || full) && !(&lost[15:6])) lost <= lost + {10'd0, ones(changed)};
      losing <= any ? losing || full : losing && full;
    end

  reg sampled, settled, asked, latched;
  always @(posedge clock)
    if (reset) begin
      sampled    <= 1'b0;
      settled    <= 1'b0;
      asked      <= 1'b0;
      latched    <= 1'b0;
      time_shown <= 1'b0;
      time_ticks <= 64'd0;
    end else begin
      sampled <= time_wanted;
      settled <= sampled;
      asked   <= settled;
      latched <= asked;
      if (settled != asked) time_ticks[31:0] <= low;
      if (asked != latched) time_ticks[63:32] <= high;  // with the carry of the tick that was latched
      time_shown <= latched;
    end

  wire unused = &{1'b0, glitch, next[0]};

endmodule
`default_nettype wire
