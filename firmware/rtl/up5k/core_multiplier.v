// SPDX-License-Identifier: Apache-2.0
// core_multiplier for the chip's multipliers, which have 16 bits: takes the place of core/core_multiplier.v. The product of
// the lower bits without sign, and what a sign takes from its upper half, each in a register.
`default_nettype none

module core_multiplier #(
    parameter WIDTH = 17
) (
    input  wire                      clock,
    input  wire signed [  WIDTH-1:0] a,
    input  wire signed [  WIDTH-1:0] b,
    output wire signed [2*WIDTH-1:0] product
);

  localparam BITS = WIDTH - 1;

  wire [BITS-1:0] a_bits = a[BITS-1:0];
  wire [BITS-1:0] b_bits = b[BITS-1:0];
  reg [2*BITS-1:0] plain;
  reg [BITS+1:0] taken;  // from bit BITS on, modulo its width
  always @(posedge clock) begin
    plain <= a_bits * b_bits;
    taken <= ({2'd0, b_bits} & {(BITS + 2) {a[BITS]}}) + ({2'd0, a_bits} & {(BITS + 2) {b[BITS]}}) - {1'b0, a[BITS] && b[BITS], {BITS{1'b0}}};
  end
  assign product = {{2'd0, plain[2*BITS-1:BITS]} - taken, plain[BITS-1:0]};

endmodule
`default_nettype wire
