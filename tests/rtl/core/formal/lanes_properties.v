// SPDX-License-Identifier: Apache-2.0
// A load returns what a store of the same width and address wrote, extended as its kind says; a word has no other bytes.
module lanes_properties (
    input [2:0] width,
    input [1:0] offset,
    input [31:0] value,
    input [31:0] memory
);
  wire misaligned;
  wire [3:0] bytes;
  wire [31:0] lanes, loaded;
  wire [31:0] mask = {{8{bytes[3]}}, {8{bytes[2]}}, {8{bytes[1]}}, {8{bytes[0]}}};
  core_lanes core_lanes (
      .width(width), .offset(offset), .store_value(value), .misaligned(misaligned), .bytes(bytes), .store_lanes(lanes),
      .load_lanes((memory & ~mask) | (lanes & mask)), .load_value(loaded));
  always @* begin
    if (width == 0) assert (!misaligned && bytes == 1 << offset && loaded == {{24{value[7]}}, value[7:0]});
    if (width == 4) assert (!misaligned && bytes == 1 << offset && loaded == {24'd0, value[7:0]});
    if (width == 1 || width == 5) assert (misaligned == offset[0]);
    if (width == 1 && !misaligned) assert (bytes == 3 << offset && loaded == {{16{value[15]}}, value[15:0]});
    if (width == 5 && !misaligned) assert (bytes == 3 << offset && loaded == {16'd0, value[15:0]});
    if (width == 2) assert (misaligned == (offset != 0));
    if (width == 2 && !misaligned) assert (bytes == 15 && loaded == value);
  end
endmodule
