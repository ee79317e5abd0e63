// SPDX-License-Identifier: Apache-2.0
// The divider in 6 bits: all operands, all four operations, against Verilog's division; the result comes after 7 ticks.
module divide_properties #(
    parameter WIDTH = 6
) (
    input clock,
    input [1:0] operation,
    input [WIDTH-1:0] a,
    input [WIDTH-1:0] b
);
  reg [4:0] tick = 0;
  always @(posedge clock) tick <= tick + 1;
  reg [1:0] operation_held;
  reg signed [WIDTH-1:0] a_held, b_held;  // the divider's operands stay
  always @(posedge clock)
    if (tick == 1) begin
      operation_held <= operation;
      a_held <= a;
      b_held <= b;
    end
  wire done;
  wire [WIDTH-1:0] result;
  core_divide #(.WIDTH(WIDTH)) divide (
      .clock(clock), .reset(tick == 0), .start(tick == 1), .operation(tick == 1 ? operation : operation_held), .a(a),
      .b(tick == 1 ? b : b_held), .done(done), .result(result));

  localparam [WIDTH-1:0] LOWEST = 1 << (WIDTH - 1);
  reg [WIDTH-1:0] expected;
  always @* begin
    if (b_held == 0) expected = operation_held[1] ? a_held : {WIDTH{1'b1}};
    else if (!operation_held[0] && a_held == LOWEST && b_held == {WIDTH{1'b1}}) expected = operation_held[1] ? 0 : LOWEST;
    else
      case (operation_held)
        2'd0: expected = a_held / b_held;
        2'd1: expected = $unsigned(a_held) / $unsigned(b_held);
        2'd2: expected = a_held % b_held;
        default: expected = $unsigned(a_held) % $unsigned(b_held);
      endcase
  end
  always @* if (tick > 0) assert (done == (tick == WIDTH + 2));
  always @* if (done && tick > 0) assert (result == expected);
endmodule
