// SPDX-License-Identifier: Apache-2.0
// For proofs of bus rules: registers that return anything.
module core_registers (
    input clock,
    input read,
    input [4:0] number_1,
    input [4:0] number_2,
    output reg [31:0] value_1,
    output reg [31:0] value_2,
    input write,
    input [4:0] write_number,
    input [31:0] write_value
);
  wire [31:0] any_1 = $anyseq;
  wire [31:0] any_2 = $anyseq;
  always @(posedge clock)
    if (read) begin
      value_1 <= any_1;
      value_2 <= any_2;
    end
endmodule
