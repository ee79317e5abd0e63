// SPDX-License-Identifier: Apache-2.0
// The chip's multiplier: signed, product in the next tick. Synthesis takes a hard block; a count of logic elements by
// yosys takes this module as a black box.
`default_nettype none

module core_multiplier #(
    parameter WIDTH = 17
) (
    input  wire                      clock,
    input  wire signed [  WIDTH-1:0] a,
    input  wire signed [  WIDTH-1:0] b,
    output reg  signed [2*WIDTH-1:0] product
);

  always @(posedge clock) product <= a * b;

endmodule
`default_nettype wire
