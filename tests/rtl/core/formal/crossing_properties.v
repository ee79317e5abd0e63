// SPDX-License-Identifier: Apache-2.0
// crossing_fifo, with four words of two bits, between clocks whose edges come in any order: words come out in the order in which they
// went in, none twice and none that did not go in; an index that crosses changes by one bit; neither full nor empty is ever wrong on
// the unsafe side.
`default_nettype none

module crossing_properties (
    input wire       write_clock,
    input wire       read_clock,
    input wire       write,
    input wire [1:0] write_data
);

  wire full, empty, valid;
  wire [1:0] read_data;
  crossing_fifo #(
      .WIDTH(2),
      .ADDRESS_WIDTH(2)
  ) fifo (
      .write_clock(write_clock),
      .write_reset(1'b0),
      .write(write),
      .write_data(write_data),
      .full(full),
      .read_clock(read_clock),
      .read_reset(1'b0),
      .empty(empty),
      .valid(valid),
      .read_data(read_data)
  );

  // Words so far, and the last of them.
  reg [3:0] stored = 0;
  reg [3:0] taken = 0;
  reg [1:0] words[0:7];
  always @(posedge write_clock)
    if (write && !full) begin
      stored <= stored + 1'b1;
      words[stored[2:0]] <= write_data;
    end
  always @(posedge read_clock) if (!empty) taken <= taken + 1'b1;

  wire [3:0] inside = stored - taken;
  reg [3:0] shown = 0;  // the number of the word that is on read_data
  always @(posedge read_clock) shown <= taken;
  always @* begin
    assert (inside <= 4'd4);
    if (!empty) assert (inside != 4'd0);
    if (inside == 4'd4) assert (full);
    if (valid) assert (read_data == words[shown[2:0]]);
  end

endmodule
`default_nettype wire
