// SPDX-License-Identifier: Apache-2.0
// Bytes of a load or store within one word of the data bus, or within two where it crosses the border between them;
// little-endian. Combinational.
`default_nettype none

module core_lanes (
    input  wire [ 2:0] width,        // funct3: 0 byte, 1 half word, 2 word; 4, 5: loads without sign
    input  wire [ 1:0] offset,
    output wire        crosses,
    output wire [ 3:0] lower_bytes,
    output wire [ 3:0] upper_bytes,  // in the next word
    input  wire [31:0] store_value,
    output wire [31:0] store_lanes,  // for either word
    input  wire [31:0] lower_lanes,  // as read; of a load that does not cross, upper_lanes alone
    input  wire [31:0] upper_lanes,
    output wire [31:0] load_value
);

  wire byte_wide = width[1:0] == 2'd0;
  wire half_wide = width[1:0] == 2'd1;

  wire [7:0] bytes = {4'd0, byte_wide ? 4'b0001 : half_wide ? 4'b0011 : 4'b1111} << offset;
  assign lower_bytes = bytes[3:0];
  assign upper_bytes = bytes[7:4];
  assign crosses = bytes[7:4] != 4'd0;

  // Rotated to the left by the offset: right for both words.
  wire [31:0] by_one = offset[0] ? {store_value[23:0], store_value[31:24]} : store_value;
  assign store_lanes = offset[1] ? {by_one[15:0], by_one[31:16]} : by_one;

  wire [31:0] merged;
  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : lane
      assign merged[8*i+:8] = (crosses && bytes[i]) ? lower_lanes[8*i+:8] : upper_lanes[8*i+:8];
    end
  endgenerate
  wire [31:0] back_by_one = offset[0] ? {merged[7:0], merged[31:8]} : merged;
  wire [31:0] word = offset[1] ? {back_by_one[15:0], back_by_one[31:16]} : back_by_one;
  wire extend = !width[2] && (byte_wide ? word[7] : word[15]);
  assign load_value = byte_wide ? {{24{extend}}, word[7:0]} : half_wide ? {{16{extend}}, word[15:0]} : word;

endmodule
`default_nettype wire
