// SPDX-License-Identifier: Apache-2.0
// The cells of an iCE40UP5K that firmware/rtl/up5k names, as far as a simulation needs them.
`default_nettype none
/* verilator lint_off DECLFILENAME */

module SB_SPRAM256KA (
    input  wire [13:0] ADDRESS,
    input  wire [15:0] DATAIN,
    input  wire [ 3:0] MASKWREN,
    input  wire        WREN,
    input  wire        CHIPSELECT,
    input  wire        CLOCK,
    input  wire        STANDBY,
    input  wire        SLEEP,
    input  wire        POWEROFF,
    output reg  [15:0] DATAOUT
);
  reg [15:0] memory[0:16383]  /* verilator public_flat_rw */;
  wire on = CHIPSELECT && POWEROFF && !SLEEP && !STANDBY;
  always @(posedge CLOCK)
    if (on) begin
      if (WREN) begin
        if (MASKWREN[0]) memory[ADDRESS][3:0] <= DATAIN[3:0];
        if (MASKWREN[1]) memory[ADDRESS][7:4] <= DATAIN[7:4];
        if (MASKWREN[2]) memory[ADDRESS][11:8] <= DATAIN[11:8];
        if (MASKWREN[3]) memory[ADDRESS][15:12] <= DATAIN[15:12];
        DATAOUT <= 16'hDEAD;  // unspecified
      end else DATAOUT <= memory[ADDRESS];
    end
endmodule

// Only linted: the clock as it is, and pads that read.
/* verilator lint_off UNUSED */
module SB_PLL40_PAD #(
    parameter FEEDBACK_PATH = "SIMPLE",
    parameter [3:0] DIVR = 0,
    parameter [6:0] DIVF = 0,
    parameter [2:0] DIVQ = 0,
    parameter [2:0] FILTER_RANGE = 0
) (
    input  wire PACKAGEPIN,
    output wire PLLOUTGLOBAL,
    input  wire RESETB,
    input  wire BYPASS,
    output wire LOCK
);
  assign PLLOUTGLOBAL = PACKAGEPIN;
  assign LOCK = 1'b1;
endmodule

module SB_GB (
    input  wire USER_SIGNAL_TO_GLOBAL_BUFFER,
    output wire GLOBAL_BUFFER_OUTPUT
);
  assign GLOBAL_BUFFER_OUTPUT = USER_SIGNAL_TO_GLOBAL_BUFFER;
endmodule

module SB_IO #(
    parameter [5:0] PIN_TYPE = 0,
    parameter [0:0] PULLUP = 0
) (
    inout  wire PACKAGE_PIN,
    input  wire OUTPUT_ENABLE,
    input  wire D_OUT_0,
    output wire D_IN_0
);
  assign D_IN_0 = PACKAGE_PIN;
endmodule
/* verilator lint_on UNUSED */
`default_nettype wire
