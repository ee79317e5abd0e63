// SPDX-License-Identifier: Apache-2.0
// An instruction word of RV32IM, Zicsr and Zifencei to what the execute stage does. Combinational. A word that is none
// of these is `illegal` and nothing else; which control registers exist is core_csr.v's.
`default_nettype none

module core_decode (
    input  wire [31:0] instruction,
    output reg  [31:0] immediate,
    output wire        illegal,
    output wire        writes,            // a register, if its number is not 0
    output wire        load,
    output wire        store,
    output wire        branch,
    output wire        jump,              // JAL, JALR
    output wire        jump_register,     // JALR alone
    output wire        load_upper,        // LUI: rs1 counts as 0
    output wire        add_upper,         // AUIPC
    output wire        multiply,
    output wire        divide,
    output wire        control_register,
    output wire        environment_call,
    output wire        breakpoint,
    output wire        trap_return,
    output wire        fence_instructions,
    output wire [ 2:0] operation,         // of the ALU
    output wire        arithmetic_shift,
    output wire        subtract,
    output wire        compare_unsigned,
    output wire        use_immediate      // the ALU's second operand
);

  wire [6:0] opcode = instruction[6:0];
  wire [2:0] funct3 = instruction[14:12];
  wire [6:0] funct7 = instruction[31:25];

  wire is_op = opcode == 7'b0110011;
  wire is_op_immediate = opcode == 7'b0010011;
  wire is_load = opcode == 7'b0000011;
  wire is_store = opcode == 7'b0100011;
  wire is_branch = opcode == 7'b1100011;
  wire is_jal = opcode == 7'b1101111;
  wire is_jalr = opcode == 7'b1100111;
  wire is_lui = opcode == 7'b0110111;
  wire is_auipc = opcode == 7'b0010111;
  wire is_fence = opcode == 7'b0001111;
  wire is_system = opcode == 7'b1110011;

  wire plain = funct7 == 7'b0000000;
  wire other = funct7 == 7'b0100000;
  wire shifts = funct3 == 3'd1 || funct3 == 3'd5;
  wire base_op = is_op && (plain || (other && (funct3 == 3'd0 || funct3 == 3'd5)));
  wire base_immediate = is_op_immediate && (!shifts || plain || (other && funct3 == 3'd5));
  wire m_op = is_op && funct7 == 7'b0000001;
  wire fence = is_fence && funct3 == 3'd0;
  wire wait_for_interrupt = instruction == 32'h10500073;

  assign load = is_load && funct3 != 3'd3 && funct3 != 3'd6 && funct3 != 3'd7;
  assign store = is_store && funct3 < 3'd3;
  assign branch = is_branch && funct3[2:1] != 2'b01;
  assign jump_register = is_jalr && funct3 == 3'd0;
  assign jump = is_jal || jump_register;
  assign load_upper = is_lui;
  assign add_upper = is_auipc;
  assign multiply = m_op && !funct3[2];
  assign divide = m_op && funct3[2];
  assign control_register = is_system && funct3[1:0] != 2'd0;
  assign environment_call = instruction == 32'h00000073;
  assign breakpoint = instruction == 32'h00100073;
  assign trap_return = instruction == 32'h30200073;
  assign fence_instructions = is_fence && funct3 == 3'd1;

  assign writes = base_op || base_immediate || m_op || load || jump || is_lui || is_auipc || control_register;
  assign illegal = !(writes || store || branch || fence || fence_instructions || environment_call || breakpoint ||
                     trap_return || wait_for_interrupt);

  assign operation = (base_op || base_immediate) ? funct3 : 3'd0;
  assign arithmetic_shift = instruction[30];
  assign subtract = branch || (is_op && funct3 == 3'd0 && instruction[30]) ||
                    ((is_op || is_op_immediate) && funct3[2:1] == 2'b01);
  assign compare_unsigned = branch ? funct3[1] : funct3[0];
  assign use_immediate = !(is_op || branch);

  always @* begin
    immediate = {{20{instruction[31]}}, instruction[31:20]};
    if (is_store) immediate = {{20{instruction[31]}}, instruction[31:25], instruction[11:7]};
    if (is_branch)
      immediate = {{20{instruction[31]}}, instruction[7], instruction[30:25], instruction[11:8], 1'b0};
    if (is_lui || is_auipc) immediate = {instruction[31:12], 12'd0};
    if (is_jal)
      immediate = {{12{instruction[31]}}, instruction[19:12], instruction[20], instruction[30:21], 1'b0};
  end

endmodule
`default_nettype wire
