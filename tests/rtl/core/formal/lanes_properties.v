// SPDX-License-Identifier: Apache-2.0
// A load returns what a store of the same width and address wrote, extended as its kind says, within a word or across two;
// other bytes are not touched.
module lanes_properties (
    input [2:0] width,
    input [1:0] offset,
    input [31:0] value,
    input [31:0] lower_before,
    input [31:0] upper_before
);
  wire crosses;
  wire [3:0] lower_bytes, upper_bytes;
  wire [31:0] lanes, loaded;
  wire [31:0] lower_mask = {{8{lower_bytes[3]}}, {8{lower_bytes[2]}}, {8{lower_bytes[1]}}, {8{lower_bytes[0]}}};
  wire [31:0] upper_mask = {{8{upper_bytes[3]}}, {8{upper_bytes[2]}}, {8{upper_bytes[1]}}, {8{upper_bytes[0]}}};
  wire [31:0] lower = (lower_before & ~lower_mask) | (lanes & lower_mask);
  wire [31:0] upper = (upper_before & ~upper_mask) | (lanes & upper_mask);
  core_lanes core_lanes (
      .width(width), .offset(offset), .crosses(crosses), .lower_bytes(lower_bytes), .upper_bytes(upper_bytes),
      .store_value(value), .store_lanes(lanes), .lower_lanes(lower), .upper_lanes(crosses ? upper : lower), .load_value(loaded));
  wire [7:0] size_mask = width[1:0] == 0 ? 8'd1 : width[1:0] == 1 ? 8'd3 : 8'd15;
  wire [7:0] bytes = size_mask << offset;
  always @*
    if (width != 3 && width < 6) begin
      assert ({upper_bytes, lower_bytes} == bytes);
      assert (crosses == (upper_bytes != 0));
      if (width == 0) assert (loaded == {{24{value[7]}}, value[7:0]});
      if (width == 4) assert (loaded == {24'd0, value[7:0]});
      if (width == 1) assert (loaded == {{16{value[15]}}, value[15:0]});
      if (width == 5) assert (loaded == {16'd0, value[15:0]});
      if (width == 2) assert (loaded == value);
    end
endmodule
