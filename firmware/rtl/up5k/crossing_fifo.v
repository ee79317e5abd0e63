// SPDX-License-Identifier: Apache-2.0
// FIFO between two clocks of any relation: indices cross as Gray codes through two flops. What was written can be read
// three ticks of the reader later; a word that is there is taken, and is on `read_data` in the tick after.
// Resets: synchronous, each to its clock; both sides must be in reset at the same time.
`default_nettype none

module crossing_fifo #(
    parameter WIDTH = 40,
    parameter ADDRESS_WIDTH = 4  // depth: 2 to its power; at least 2
) (
    input  wire             write_clock,
    input  wire             write_reset,
    input  wire             write,
    input  wire [WIDTH-1:0] write_data,
    output wire             full,
    input  wire             read_clock,
    input  wire             read_reset,
    output wire             empty,
    output reg              valid,
    output reg  [WIDTH-1:0] read_data
);

  reg [WIDTH-1:0] memory[0:(1<<ADDRESS_WIDTH)-1];

  // One bit more than an address: distinguishes full from empty.
  reg [ADDRESS_WIDTH:0] write_index, write_gray, read_index, read_gray;
  reg [ADDRESS_WIDTH:0] sampled_read_gray, settled_read_gray;    // in the writer's clock
  reg [ADDRESS_WIDTH:0] sampled_write_gray, settled_write_gray;  // in the reader's

  wire store = write && !full;
  wire [ADDRESS_WIDTH:0] next_write_index = write_index + {{ADDRESS_WIDTH{1'b0}}, store};
  assign full = write_gray == {~settled_read_gray[ADDRESS_WIDTH:ADDRESS_WIDTH-1], settled_read_gray[ADDRESS_WIDTH-2:0]};
  always @(posedge write_clock) begin
    if (store) memory[write_index[ADDRESS_WIDTH-1:0]] <= write_data;
    if (write_reset) begin
      write_index       <= 0;
      write_gray        <= 0;
      sampled_read_gray <= 0;
      settled_read_gray <= 0;
    end else begin
      write_index       <= next_write_index;
      write_gray        <= next_write_index ^ (next_write_index >> 1);
      sampled_read_gray <= read_gray;
      settled_read_gray <= sampled_read_gray;
    end
  end

  assign empty = read_gray == settled_write_gray;
  wire [ADDRESS_WIDTH:0] next_read_index = read_index + {{ADDRESS_WIDTH{1'b0}}, !empty};
  always @(posedge read_clock) begin
    read_data <= memory[read_index[ADDRESS_WIDTH-1:0]];
    if (read_reset) begin
      read_index         <= 0;
      read_gray          <= 0;
      valid              <= 1'b0;
      sampled_write_gray <= 0;
      settled_write_gray <= 0;
    end else begin
      read_index         <= next_read_index;
      read_gray          <= next_read_index ^ (next_read_index >> 1);
      valid              <= !empty;
      sampled_write_gray <= write_gray;
      settled_write_gray <= sampled_write_gray;
    end
  end

endmodule
`default_nettype wire
