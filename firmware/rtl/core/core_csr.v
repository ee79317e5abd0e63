// SPDX-License-Identifier: Apache-2.0
// The control registers of machine mode that the firmware uses, and the counters. Everything else does not exist:
// reading or writing it is an illegal instruction.
`default_nettype none

module core_csr (
    input  wire        clock,
    input  wire        reset,
    // Access by an instruction: `access` and `commit` in the tick in which it ends.
    input  wire [11:0] number,
    input  wire        reads_only,     // CSRRS and CSRRC of no bits
    input  wire [ 1:0] operation,      // funct3[1:0]: 1 write, 2 set, 3 clear
    input  wire [31:0] operand,
    input  wire        commit,
    output wire        illegal,
    output reg  [31:0] value,          // before the write
    // Traps.
    input  wire        trap,
    input  wire        trap_interrupt,
    input  wire [ 3:0] trap_cause,
    input  wire [31:2] trap_address,   // of the instruction
    input  wire [31:0] trap_value,
    input  wire        trap_return,
    output wire [31:2] vector,
    output wire [31:2] return_address,
    // Machine timer.
    input  wire        timer_interrupt,
    output wire        interrupt,      // is to be taken
    input  wire        retired,
    output reg  [63:0] cycle  /* verilator public_flat_rw */  // since reset
);

  localparam [11:0] MSTATUS = 12'h300;
  localparam [11:0] MIE = 12'h304;
  localparam [11:0] MTVEC = 12'h305;
  localparam [11:0] MEPC = 12'h341;
  localparam [11:0] MCAUSE = 12'h342;
  localparam [11:0] MTVAL = 12'h343;
  localparam [11:0] MIP = 12'h344;
  localparam [11:0] CYCLE = 12'hC00;
  localparam [11:0] INSTRET = 12'hC02;
  localparam [11:0] CYCLEH = 12'hC80;
  localparam [11:0] INSTRETH = 12'hC82;

  reg enabled  /* verilator public_flat_rd */;         // mstatus.MIE
  reg enabled_before  /* verilator public_flat_rd */;  // mstatus.MPIE
  reg timer_enabled  /* verilator public_flat_rd */;   // mie.MTIE
  reg [31:2] mtvec  /* verilator public_flat_rd */;
  reg [31:2] mepc  /* verilator public_flat_rd */;
  reg [4:0] mcause  /* verilator public_flat_rd */;    // interrupt, code
  reg [31:0] mtval  /* verilator public_flat_rd */;
  reg [63:0] instret  /* verilator public_flat_rw */;

  reg known;
  always @* begin
    known = 1'b1;
    value = 32'd0;
    case (number)
      MSTATUS: value = {19'd0, 2'b11, 3'd0, enabled_before, 3'd0, enabled, 3'd0};
      MIE: value = {24'd0, timer_enabled, 7'd0};
      MTVEC: value = {mtvec, 2'd0};
      MEPC: value = {mepc, 2'd0};
      MCAUSE: value = {mcause[4], 27'd0, mcause[3:0]};
      MTVAL: value = mtval;
      MIP: value = {24'd0, timer_interrupt, 7'd0};
      CYCLE: value = cycle[31:0];
      INSTRET: value = instret[31:0];
      CYCLEH: value = cycle[63:32];
      INSTRETH: value = instret[63:32];
      default: known = 1'b0;
    endcase
  end
  assign illegal = !known || (number[11:10] == 2'b11 && !reads_only);
  assign vector = mtvec;
  assign return_address = mepc;
  assign interrupt = enabled && timer_enabled && timer_interrupt;

  wire [31:0] written = operation == 2'd1 ? operand : operation == 2'd2 ? value | operand : value & ~operand;
  wire write = commit && !reads_only;

  always @(posedge clock)
    if (reset) begin
      enabled        <= 1'b0;
      enabled_before <= 1'b0;
      timer_enabled  <= 1'b0;
      mtvec          <= 30'd0;
      mepc           <= 30'd0;
      mcause         <= 5'd0;
      mtval          <= 32'd0;
    end else if (trap) begin
      enabled        <= 1'b0;
      enabled_before <= enabled;
      mepc           <= trap_address;
      mcause         <= {trap_interrupt, trap_cause};
      mtval          <= trap_value;
    end else if (trap_return) begin
      enabled        <= enabled_before;
      enabled_before <= 1'b1;
    end else if (write) begin
      if (number == MSTATUS) enabled <= written[3];
      if (number == MSTATUS) enabled_before <= written[7];
      if (number == MIE) timer_enabled <= written[7];
      if (number == MTVEC) mtvec <= written[31:2];
      if (number == MEPC) mepc <= written[31:2];
      if (number == MCAUSE) mcause <= {written[31], written[3:0]};
      if (number == MTVAL) mtval <= written;
    end

  always @(posedge clock)
    if (reset) begin
      cycle   <= 64'd0;
      instret <= 64'd0;
    end else begin
      cycle <= cycle + 64'd1;
      if (retired) instret <= instret + 64'd1;
    end

endmodule
`default_nettype wire
