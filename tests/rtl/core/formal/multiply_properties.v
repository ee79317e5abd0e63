// SPDX-License-Identifier: Apache-2.0
// The multiplier in 4 bits: all operands, all four operations, against Verilog's multiplication; result in the second tick.
module multiply_properties #(
    parameter WIDTH = 4
) (
    input clock,
    input [1:0] operation,
    input [WIDTH-1:0] a,
    input [WIDTH-1:0] b
);
  reg [2:0] tick = 0;
  always @(posedge clock) tick <= tick + (tick != 7);
  reg [1:0] operation_held;
  reg [WIDTH-1:0] a_held, b_held;
  always @(posedge clock)
    if (tick == 1) begin
      operation_held <= operation;
      a_held <= a;
      b_held <= b;
    end
  wire [WIDTH-1:0] result;
  core_multiply #(.WIDTH(WIDTH)) multiply (
      .clock(clock), .operation(tick == 1 ? operation : operation_held), .a(a), .b(b), .result(result));

  wire a_signed = operation_held == 2'd1 || operation_held == 2'd2;
  wire b_signed = operation_held == 2'd1;
  wire signed [2*WIDTH-1:0] a_wide = {{WIDTH{a_signed && a_held[WIDTH-1]}}, a_held};
  wire signed [2*WIDTH-1:0] b_wide = {{WIDTH{b_signed && b_held[WIDTH-1]}}, b_held};
  wire [2*WIDTH-1:0] product = a_wide * b_wide;
  always @* if (tick == 2) assert (result == (operation_held == 0 ? product[WIDTH-1:0] : product[2*WIDTH-1:WIDTH]));
endmodule
