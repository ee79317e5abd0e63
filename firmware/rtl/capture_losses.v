// SPDX-License-Identifier: Apache-2.0
// Counts edges that were lost, because the FIFO was full or on their way here, and marks where in the stream of records they
// are missing.
`default_nettype none

module capture_losses #(
    parameter INPUTS = 12,
    parameter LOST_WIDTH = 32  // at least 6
) (
    input  wire                  clock,
    input  wire                  reset,
    input  wire [    INPUTS-1:0] changed,         // edges of this tick
    input  wire [LOST_WIDTH-1:0] lost_before,     // edges that got lost before this block; then there are none in this tick
    input  wire                  full,            // they do not fit
    input  wire                  interrupted,     // for another reason records do not continue those before
    input  wire                  clear_overflow,
    output reg                   overflow,
    output reg                   gap,             // the record stored now does not continue the one before
    output reg  [LOST_WIDTH-1:0] lost
);

  function [5:0] ones(input [INPUTS-1:0] mask);
    integer k;
    begin
      ones = 6'd0;
      for (k = 0; k < INPUTS; k = k + 1) ones = ones + {5'd0, mask[k]};
    end
  endfunction

  wire any = |changed;
  wire elsewhere = |lost_before;
  wire lose = (any && full) || elsewhere;
  wire [LOST_WIDTH:0] number = elsewhere ? {1'b0, lost_before} : {{(LOST_WIDTH - 5) {1'b0}}, ones(changed)};
  wire [LOST_WIDTH:0] sum = {1'b0, lost} + number;

  always @(posedge clock)
    if (reset) begin
      overflow <= 1'b0;
      gap      <= 1'b1;
      lost     <= {LOST_WIDTH{1'b0}};
    end else begin
      if (lose) overflow <= 1'b1;
      else if (clear_overflow) overflow <= 1'b0;

      if (lose || interrupted) gap <= 1'b1;
      else if (any) gap <= 1'b0;

      if (lose) lost <= sum[LOST_WIDTH] ? {LOST_WIDTH{1'b1}} : sum[LOST_WIDTH-1:0];
    end

endmodule
`default_nettype wire
