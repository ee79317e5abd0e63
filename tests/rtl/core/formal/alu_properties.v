// SPDX-License-Identifier: Apache-2.0
// Every operation of the ALU, for all operands, against Verilog's own operators.
module alu_properties (
    input [31:0] a,
    input [31:0] b,
    input [2:0] operation,
    input other,  // SUB, SRA
    input branch,
    input [2:0] condition
);
  wire compares = operation[2:1] == 2'b01;
  wire [31:0] sum, result;
  wire equal, less;
  core_alu alu (
      .a(a),
      .b(b),
      .operation(operation),
      .arithmetic_shift(other),
      .subtract(branch || compares || (operation == 3'd0 && other)),
      .compare_unsigned(branch ? condition[1] : operation[0]),
      .sum(sum),
      .equal(equal),
      .less(less),
      .result(result)
  );
  always @* begin
    if (!branch && !(operation == 3'd1 && other))
      case (operation)
        3'd0: assert (result == (other ? a - b : a + b));
        3'd1: assert (result == a << b[4:0]);
        3'd2: assert (result == ($signed(a) < $signed(b)));
        3'd3: assert (result == (a < b));
        3'd4: assert (result == (a ^ b));
        3'd5: if (other) assert ($signed(result) == $signed(a) >>> b[4:0]);
              else assert (result == a >> b[4:0]);
        3'd6: assert (result == (a | b));
        3'd7: assert (result == (a & b));
      endcase
    if (branch) begin
      assert (equal == (a == b));
      assert (less == (condition[1] ? a < b : $signed(a) < $signed(b)));
    end
    if (!branch && operation == 3'd0 && !other) assert (sum == a + b);
  end
endmodule
