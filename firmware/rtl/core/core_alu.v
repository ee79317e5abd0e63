// SPDX-License-Identifier: Apache-2.0
// Arithmetic of one tick: the sum for addresses too, and the comparisons for branches. Combinational.
`default_nettype none

module core_alu (
    input  wire [31:0] a,
    input  wire [31:0] b,
    input  wire [ 2:0] operation,          // funct3 of OP
    input  wire        arithmetic_shift,
    input  wire        subtract,           // for SUB, SLT, SLTU and branches
    input  wire        compare_unsigned,
    output wire [31:0] sum,                // a + b or a - b
    output wire        equal,
    output wire        less,               // valid while subtract
    output reg  [31:0] result
);

  localparam [2:0] ADD = 3'd0;
  localparam [2:0] SLL = 3'd1;
  localparam [2:0] SLT = 3'd2;
  localparam [2:0] SLTU = 3'd3;
  localparam [2:0] XOR = 3'd4;
  localparam [2:0] SR = 3'd5;
  localparam [2:0] OR = 3'd6;

  wire [32:0] wide = {1'b0, a} + {1'b0, b ^ {32{subtract}}} + {32'd0, subtract};
  assign sum = wide[31:0];
  assign equal = a == b;
  // a - b borrows when a < b without signs; with different signs the negative one is less.
  assign less = (!compare_unsigned && a[31] != b[31]) ? a[31] : !wide[32];

  // One shifter to the right; a shift to the left is one of the reversed word.
  function [31:0] reversed(input [31:0] word);
    integer i;
    begin
      for (i = 0; i < 32; i = i + 1) reversed[i] = word[31-i];
    end
  endfunction

  wire left = operation == SLL;
  wire fill = arithmetic_shift && a[31];
  wire [31:0] shift_0 = left ? reversed(a) : a;
  wire [31:0] shift_1 = b[0] ? {fill, shift_0[31:1]} : shift_0;
  wire [31:0] shift_2 = b[1] ? {{2{fill}}, shift_1[31:2]} : shift_1;
  wire [31:0] shift_4 = b[2] ? {{4{fill}}, shift_2[31:4]} : shift_2;
  wire [31:0] shift_8 = b[3] ? {{8{fill}}, shift_4[31:8]} : shift_4;
  wire [31:0] shifted = b[4] ? {{16{fill}}, shift_8[31:16]} : shift_8;

  always @*
    case (operation)
      ADD: result = sum;
      SLL: result = reversed(shifted);
      SLT: result = {31'd0, less};
      SLTU: result = {31'd0, less};
      XOR: result = a ^ b;
      SR: result = shifted;
      OR: result = a | b;
      default: result = a & b;
    endcase

endmodule
`default_nettype wire
