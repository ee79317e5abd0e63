// SPDX-License-Identifier: Apache-2.0
// Half words of soc_cache, with two ports.
`default_nettype none

module soc_cache_half #(
    parameter ADDRESS_BITS = 9
) (
    input  wire                    clock,
    input  wire                    read_a,
    input  wire [ADDRESS_BITS-1:0] address_a,
    output reg  [            15:0] data_a,
    input  wire                    read_b,
    input  wire                    write_b,
    input  wire [ADDRESS_BITS-1:0] address_b,
    input  wire [            15:0] write_data_b,
    output reg  [            15:0] data_b
);

  (* ramstyle = "M9K, no_rw_check" *)
  reg [15:0] memory[0:(1 << ADDRESS_BITS) - 1];
  always @(posedge clock) if (read_a) data_a <= memory[address_a];
  always @(posedge clock) begin
    if (write_b) memory[address_b] <= write_data_b;
    if (read_b) data_b <= memory[address_b];
  end

endmodule
`default_nettype wire
