// SPDX-License-Identifier: Apache-2.0
// Asynchronous pins to levels of this clock, the edges between them, and the filter against short glitches.
//
// A pin that is sampled at tick c has its edge in `changed` during tick c + 3 + filter_length, with `levels` after it.
// A new level is taken when it was sampled filter_length + 1 times in a row; a shorter one is a glitch.
// A new filter_length holds for edges that begin later. An edge counts when its input is enabled in that tick.
`default_nettype none

module capture_inputs #(
    parameter INPUTS = 12,
    parameter FILTER_WIDTH = 4
) (
    input  wire                    clock,
    input  wire                    reset,
    input  wire [      INPUTS-1:0] pins,
    input  wire [      INPUTS-1:0] watched,
    input  wire [FILTER_WIDTH-1:0] filter_length,
    output reg  [      INPUTS-1:0] levels,
    output reg  [      INPUTS-1:0] changed,
    output reg                     glitch
);

  // The first flop may go metastable; it has a whole tick to settle before the second one samples it. Neither may be
  // merged, moved or turned into a memory by the fitter.
  (* altera_attribute = "-name SYNCHRONIZER_IDENTIFICATION FORCED; -name AUTO_SHIFT_REGISTER_RECOGNITION OFF" *)
  reg [INPUTS-1:0] sampled;
  reg [INPUTS-1:0] settled;
  always @(posedge clock) begin
    sampled <= pins;
    settled <= sampled;
  end

  wire [INPUTS-1:0] differs = settled ^ levels;
  wire [INPUTS-1:0] taken;
  reg  [INPUTS-1:0] waiting;  // a new level has been seen, but not for long enough

  genvar i;
  generate
    for (i = 0; i < INPUTS; i = i + 1) begin : filter
      reg [FILTER_WIDTH-1:0] remaining;
      assign taken[i] = differs[i] && remaining == 0;
      always @(posedge clock)
        if (reset || !differs[i] || taken[i]) remaining <= filter_length;
        else remaining <= remaining - 1'b1;
    end
  endgenerate

  always @(posedge clock)
    if (reset) begin
      levels  <= settled;  // a pin that is high at reset gives no edge
      changed <= {INPUTS{1'b0}};
      waiting <= {INPUTS{1'b0}};
      glitch  <= 1'b0;
    end else begin
      levels  <= levels ^ taken;
      changed <= taken & watched;
      waiting <= differs & ~taken;
      glitch  <= |(waiting & ~differs & watched);
    end

endmodule
`default_nettype wire
