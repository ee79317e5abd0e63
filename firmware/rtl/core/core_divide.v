// SPDX-License-Identifier: Apache-2.0
// DIV, DIVU, REM, REMU: a bit a tick on magnitudes, signs at the end. `done` with the result WIDTH + 1 ticks after start.
// Operation and divisor stay until then.
`default_nettype none

module core_divide #(
    parameter WIDTH = 32  // less for proofs
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

  localparam COUNT_WIDTH = $clog2(WIDTH + 1);

  reg [COUNT_WIDTH-1:0] left;  // bits
  reg busy;
  reg negative;  // the result
  reg [WIDTH-1:0] remainder;
  reg [WIDTH-1:0] quotient;  // in its upper bits what is left of the dividend

  wire has_signs = !operation[0];
  wire a_negative = has_signs && a[WIDTH-1];
  wire b_negative = has_signs && b[WIDTH-1];

  wire [WIDTH:0] shifted = {remainder, quotient[WIDTH-1]};
  // Less the magnitude of b: a negative b is added as it is.
  wire [WIDTH:0] difference;
  wire carry_in;
  assign {difference, carry_in} = {shifted, 1'b1} + {1'b1, b_negative ? b : ~b, !b_negative};
  wire fits = !difference[WIDTH];
  wire unused = &{1'b0, carry_in};

  always @(posedge clock)
    if (reset) begin
      busy <= 1'b0;
      left <= {COUNT_WIDTH{1'b0}};
    end else if (start) begin
      busy <= 1'b1;
      left <= WIDTH[COUNT_WIDTH-1:0];
    end else if (done) busy <= 1'b0;
    else if (busy) left <= left - 1'b1;
  assign done = busy && left == 0;

  always @(posedge clock)
    if (start) begin
      // Division by zero gives a quotient of ones, which no sign changes, and the dividend as remainder.
      negative  <= operation[1] ? a_negative : (a_negative != b_negative) && b != 0;
      quotient  <= a_negative ? -a : a;
      remainder <= {WIDTH{1'b0}};
    end else if (!done) begin
      quotient  <= {quotient[WIDTH-2:0], fits};
      remainder <= fits ? difference[WIDTH-1:0] : shifted[WIDTH-1:0];
    end

  wire [WIDTH-1:0] magnitude = operation[1] ? remainder : quotient;
  assign result = negative ? -magnitude : magnitude;

endmodule
`default_nettype wire
