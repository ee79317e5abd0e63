// SPDX-License-Identifier: Apache-2.0
// A byte of every word of soc_ram.
`default_nettype none

module soc_ram_lane (
    input  wire        clock,
    input  wire        read_a,
    input  wire [12:0] address_a,
    output reg  [ 7:0] data_a,
    input  wire        read_b,
    input  wire        write_b,
    input  wire [12:0] address_b,
    input  wire [ 7:0] write_data_b,
    output reg  [ 7:0] data_b
);

  (* ramstyle = "M9K, no_rw_check" *)
  reg [7:0] memory[0:8191]  /* verilator public_flat_rw */;
  always @(posedge clock) if (read_a) data_a <= memory[address_a];
  always @(posedge clock) begin
    if (write_b) memory[address_b] <= write_data_b;
    if (read_b) data_b <= memory[address_b];
  end

endmodule
`default_nettype wire
