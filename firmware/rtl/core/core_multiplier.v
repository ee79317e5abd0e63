// SPDX-License-Identifier: Apache-2.0
// The chip's multiplier: unsigned, product in the next tick. Synthesis takes a hard block; a count of logic elements by
// yosys takes this module as a black box.
`default_nettype none

module core_multiplier #(
    parameter WIDTH = 16
) (
    input  wire               clock,
    input  wire [  WIDTH-1:0] a,
    input  wire [  WIDTH-1:0] b,
    output reg  [2*WIDTH-1:0] product
);

  always @(posedge clock) product <= {{WIDTH{1'b0}}, a} * {{WIDTH{1'b0}}, b};

endmodule
`default_nettype wire
