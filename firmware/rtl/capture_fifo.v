// SPDX-License-Identifier: Apache-2.0
// FIFO in block RAM whose oldest word is always present at `head`. DEPTH is a power of two.
//
// `count` leaves out a word written in the last tick: block RAM needs that tick before it can be read, so the head is
// right whenever count is not 0, and the RAM's output while it is written at the same address does not matter.
`default_nettype none

module capture_fifo #(
    parameter WIDTH = 57,
    parameter DEPTH = 512
) (
    input  wire                   clock,
    input  wire                   clear,
    input  wire                   write,
    input  wire [      WIDTH-1:0] write_data,
    output wire                   full,
    input  wire                   pop,
    output reg  [      WIDTH-1:0] head,
    output wire [$clog2(DEPTH):0] count
);

  localparam ADDRESS_WIDTH = $clog2(DEPTH);

  (* ramstyle = "M9K, no_rw_check" *)
  reg [WIDTH-1:0] memory[0:DEPTH-1];
  // One bit more than an address: distinguishes full from empty.
  reg [ADDRESS_WIDTH:0] write_index;
  reg [ADDRESS_WIDTH:0] readable_index;
  reg [ADDRESS_WIDTH:0] read_index;

  wire store = write && !full;
  wire remove = pop && count != 0;
  wire [ADDRESS_WIDTH:0] next_read_index = read_index + {{ADDRESS_WIDTH{1'b0}}, remove};

  assign count = readable_index - read_index;
  assign full  = write_index == (read_index ^ {1'b1, {ADDRESS_WIDTH{1'b0}}});

  always @(posedge clock) begin
    head <= memory[next_read_index[ADDRESS_WIDTH-1:0]];
    if (store) memory[write_index[ADDRESS_WIDTH-1:0]] <= write_data;
  end

  always @(posedge clock)
    if (clear) begin
      write_index    <= 0;
      readable_index <= 0;
      read_index     <= 0;
    end else begin
      write_index    <= write_index + {{ADDRESS_WIDTH{1'b0}}, store};
      readable_index <= write_index;
      read_index     <= next_read_index;
    end

endmodule
`default_nettype wire
