// SPDX-License-Identifier: Apache-2.0
// Bytes and half words within a word of the data bus, little-endian. Combinational.
`default_nettype none

module core_lanes (
    input  wire [ 2:0] width,          // funct3: 0 byte, 1 half word, 2 word; 4, 5: loads without sign
    input  wire [ 1:0] offset,
    input  wire [31:0] store_value,
    output wire        misaligned,
    output wire [ 3:0] bytes,
    output wire [31:0] store_lanes,
    input  wire [31:0] load_lanes,
    output wire [31:0] load_value
);

  wire byte_wide = width[1:0] == 2'd0;
  wire half_wide = width[1:0] == 2'd1;

  assign misaligned = byte_wide ? 1'b0 : half_wide ? offset[0] : offset != 2'd0;
  assign bytes = byte_wide ? 4'b0001 << offset : half_wide ? (offset[1] ? 4'b1100 : 4'b0011) : 4'b1111;
  assign store_lanes = byte_wide ? {4{store_value[7:0]}} : half_wide ? {2{store_value[15:0]}} : store_value;

  wire [15:0] half = offset[1] ? load_lanes[31:16] : load_lanes[15:0];
  wire [7:0] low_byte = offset[0] ? half[15:8] : half[7:0];
  wire extend = !width[2] && (byte_wide ? low_byte[7] : half[15]);
  assign load_value = byte_wide ? {{24{extend}}, low_byte} : half_wide ? {{16{extend}}, half} : load_lanes;

endmodule
`default_nettype wire
