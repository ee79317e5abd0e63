// SPDX-License-Identifier: Apache-2.0
// RAM of 32 KiB in block RAM with two ports: A reads instructions, B reads and writes data, bytes by their enables.
`default_nettype none

module soc_ram (
    input  wire        clock,
    input  wire        read_a,
    input  wire [12:0] address_a,
    output wire [31:0] data_a,
    input  wire        read_b,
    input  wire [ 3:0] write_b,
    input  wire [12:0] address_b,
    input  wire [31:0] write_data_b,
    output wire [31:0] data_b
);

  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : lane
      soc_ram_lane bytes (
          .clock(clock),
          .read_a(read_a),
          .address_a(address_a),
          .data_a(data_a[8*i+:8]),
          .read_b(read_b),
          .write_b(write_b[i]),
          .address_b(address_b),
          .write_data_b(write_data_b[8*i+:8]),
          .data_b(data_b[8*i+:8])
      );
    end
  endgenerate

endmodule
`default_nettype wire
