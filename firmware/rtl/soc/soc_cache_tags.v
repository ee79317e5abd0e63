// SPDX-License-Identifier: Apache-2.0
// Tags of soc_cache: all 0, not valid, at the start. What is read while it is written may be anything.
`default_nettype none

module soc_cache_tags #(
    parameter INDEX_BITS = 7,
    parameter WIDTH = 13
) (
    input  wire                  clock,
    input  wire [INDEX_BITS-1:0] read_address,
    output reg  [     WIDTH-1:0] read_data,
    input  wire                  write,
    input  wire [INDEX_BITS-1:0] write_address,
    input  wire [     WIDTH-1:0] write_data
);

  (* ramstyle = "M9K, no_rw_check" *)
  reg [WIDTH-1:0] memory[0:(1 << INDEX_BITS) - 1]  /* verilator public_flat_rw */;
  integer i;
  initial for (i = 0; i < 1 << INDEX_BITS; i = i + 1) memory[i] = {WIDTH{1'b0}};

  always @(posedge clock) begin
    read_data <= memory[read_address];
    if (write) memory[write_address] <= write_data;
  end

endmodule
`default_nettype wire
