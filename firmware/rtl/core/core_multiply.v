// SPDX-License-Identifier: Apache-2.0
// MUL, MULH, MULHSU, MULHU in three ticks: operands, four partial products, sum. `done` with the result in the third.
`default_nettype none

module core_multiply #(
    parameter WIDTH = 32  // even; less for proofs
) (
    input  wire             clock,
    input  wire             reset,
    input  wire             start,
    input  wire [      1:0] operation,  // funct3[1:0]
    input  wire [WIDTH-1:0] a,
    input  wire [WIDTH-1:0] b,
    output wire             done,
    output wire [WIDTH-1:0] result
);

  localparam HALF = WIDTH / 2;

  reg started;
  reg multiplied;
  always @(posedge clock)
    if (reset) begin
      started    <= 1'b0;
      multiplied <= 1'b0;
    end else begin
      started    <= start;
      multiplied <= started;
    end
  assign done = multiplied;

  reg [WIDTH-1:0] a_held;
  reg [WIDTH-1:0] b_held;
  reg a_negative;
  reg b_negative;
  reg high_half;
  always @(posedge clock)
    if (start) begin
      a_held     <= a;
      b_held     <= b;
      a_negative <= a[WIDTH-1] && (operation == 2'd1 || operation == 2'd2);
      b_negative <= b[WIDTH-1] && operation == 2'd1;
      high_half  <= operation != 2'd0;
    end

  wire [WIDTH-1:0] low_low;
  wire [WIDTH-1:0] low_high;
  wire [WIDTH-1:0] high_low;
  wire [WIDTH-1:0] high_high;
  core_multiplier #(.WIDTH(HALF)) multiplier_0 (
      .clock(clock), .a(a_held[HALF-1:0]), .b(b_held[HALF-1:0]), .product(low_low));
  core_multiplier #(.WIDTH(HALF)) multiplier_1 (
      .clock(clock), .a(a_held[HALF-1:0]), .b(b_held[WIDTH-1:HALF]), .product(low_high));
  core_multiplier #(.WIDTH(HALF)) multiplier_2 (
      .clock(clock), .a(a_held[WIDTH-1:HALF]), .b(b_held[HALF-1:0]), .product(high_low));
  core_multiplier #(.WIDTH(HALF)) multiplier_3 (
      .clock(clock), .a(a_held[WIDTH-1:HALF]), .b(b_held[WIDTH-1:HALF]), .product(high_high));

  // A negative operand read as unsigned is 2^WIDTH too large: the other one is subtracted from the upper half.
  reg [WIDTH-1:0] excess;
  always @(posedge clock) excess <= (a_negative ? b_held : {WIDTH{1'b0}}) + (b_negative ? a_held : {WIDTH{1'b0}});

  wire [WIDTH:0] middle = {1'b0, low_high} + {1'b0, high_low};
  wire [2*WIDTH-1:0] product = {high_high - excess, low_low} + {{(HALF - 1) {1'b0}}, middle, {HALF{1'b0}}};
  assign result = high_half ? product[2*WIDTH-1:WIDTH] : product[WIDTH-1:0];

endmodule
`default_nettype wire
