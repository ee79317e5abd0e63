// SPDX-License-Identifier: Apache-2.0
// Read inside crossing_fifo: an index that crosses changes by one bit.
  reg [2:0] last_write_gray = 0, last_read_gray = 0;
  always @(posedge write_clock) last_write_gray <= write_gray;
  always @(posedge read_clock) last_read_gray <= read_gray;
  wire [2:0] write_change = write_gray ^ last_write_gray;
  wire [2:0] read_change = read_gray ^ last_read_gray;
  always @* begin
    assert ((write_change & (write_change - 3'd1)) == 3'd0);
    assert ((read_change & (read_change - 3'd1)) == 3'd0);
  end
