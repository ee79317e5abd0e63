// SPDX-License-Identifier: Apache-2.0
// MUL, MULH, MULHSU, MULHU in two ticks: four partial products, their sum. The result is there in the tick after
// the operands, while the operation stays.
`default_nettype none

module core_multiply #(
    parameter WIDTH = 32  // even; less for proofs
) (
    input  wire             clock,
    input  wire [      1:0] operation,  // funct3[1:0]
    input  wire [WIDTH-1:0] a,
    input  wire [WIDTH-1:0] b,
    output wire [WIDTH-1:0] result
);

  localparam HALF = WIDTH / 2;

  // Halves with a sign: a lower half has none, and of an upper half of an unsigned operand it is 0.
  wire a_negative = a[WIDTH-1] && (operation == 2'd1 || operation == 2'd2);
  wire b_negative = b[WIDTH-1] && operation == 2'd1;
  wire [HALF:0] a_low = {1'b0, a[HALF-1:0]};
  wire [HALF:0] b_low = {1'b0, b[HALF-1:0]};
  wire [HALF:0] a_high = {a_negative, a[WIDTH-1:HALF]};
  wire [HALF:0] b_high = {b_negative, b[WIDTH-1:HALF]};

  wire [WIDTH+1:0] low_low;
  wire [WIDTH+1:0] low_high;
  wire [WIDTH+1:0] high_low;
  wire [WIDTH+1:0] high_high;
  core_multiplier #(.WIDTH(HALF + 1)) multiplier_0 (.clock(clock), .a(a_low), .b(b_low), .product(low_low));
  core_multiplier #(.WIDTH(HALF + 1)) multiplier_1 (.clock(clock), .a(a_low), .b(b_high), .product(low_high));
  core_multiplier #(.WIDTH(HALF + 1)) multiplier_2 (.clock(clock), .a(a_high), .b(b_low), .product(high_low));
  core_multiplier #(.WIDTH(HALF + 1)) multiplier_3 (.clock(clock), .a(a_high), .b(b_high), .product(high_high));

  wire [WIDTH+1:0] middle = low_high + high_low;
  wire [WIDTH+HALF-1:0] upper = {high_high[WIDTH-1:0], low_low[WIDTH-1:HALF]} + {{(HALF - 1) {middle[WIDTH+1]}}, middle[WIDTH:0]};
  assign result = operation == 2'd0 ? {upper[HALF-1:0], low_low[HALF-1:0]} : upper[WIDTH+HALF-1:HALF];

  wire unused = &{1'b0, low_low[WIDTH+1:WIDTH], high_high[WIDTH+1:WIDTH]};

endmodule
`default_nettype wire
