// SPDX-License-Identifier: Apache-2.0
// The loader's ROM of 6 KiB, filled by the chip's configuration. Both ports read; data a tick later.
`default_nettype none

module soc_rom #(
    parameter FILE = "loader.hex"  // words in hexadecimal, a line each
) (
    input  wire        clock,
    input  wire        read_a,
    input  wire [10:0] address_a,
    output reg  [31:0] data_a,
    input  wire        read_b,
    input  wire [10:0] address_b,
    output reg  [31:0] data_b
);

  (* ramstyle = "M9K" *)
  reg [31:0] memory[0:1535]  /* verilator public_flat_rw */;
  initial if (FILE != "") $readmemh(FILE, memory);

  always @(posedge clock) if (read_a) data_a <= memory[address_a];
  always @(posedge clock) if (read_b) data_b <= memory[address_b];

endmodule
`default_nettype wire
