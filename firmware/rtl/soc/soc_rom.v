// SPDX-License-Identifier: Apache-2.0
// The loader's ROM of 6 KiB, filled by the chip's configuration. Two ports read, data a tick later; or one, and then B goes
// first: what A gets in that tick is not what it asked for.
`default_nettype none

module soc_rom #(
    parameter FILE = "loader.hex",  // words in hexadecimal, a line each
    parameter PORTS = 2
) (
    input  wire        clock,
    input  wire        read_a,
    input  wire [10:0] address_a,
    output wire [31:0] data_a,
    input  wire        read_b,
    input  wire [10:0] address_b,
    output wire [31:0] data_b
);

  (* ramstyle = "M9K" *)
  reg [31:0] memory[0:1535]  /* verilator public_flat_rw */;
  initial if (FILE != "") $readmemh(FILE, memory);

  generate
    if (PORTS == 1) begin : one_port
      reg [31:0] data;
      always @(posedge clock) if (read_a || read_b) data <= memory[read_b ? address_b : address_a];
      assign data_a = data;
      assign data_b = data;
    end else begin : two_ports
      reg [31:0] word_a, word_b;
      always @(posedge clock) if (read_a) word_a <= memory[address_a];
      always @(posedge clock) if (read_b) word_b <= memory[address_b];
      assign data_a = word_a;
      assign data_b = word_b;
    end
  endgenerate

endmodule
`default_nettype wire
