// SPDX-License-Identifier: Apache-2.0
// The machine timer: mtime, which is the core's cycle counter, at 0 and 4, mtimecmp at 8 and 12; the interrupt is high while
// mtime >= mtimecmp. Without COMPARE there is mtime only, and no interrupt.
`default_nettype none

module soc_timer #(
    parameter COMPARE = 1
) (
    input  wire        clock,
    input  wire        reset,
    input  wire [63:0] now,
    input  wire [ 1:0] address,
    input  wire        write,
    input  wire [31:0] write_data,
    output reg  [31:0] read_data,
    output reg         interrupt
);

  reg [63:0] compare;
  always @(posedge clock)
    if (reset || COMPARE == 0) begin
      compare   <= {64{1'b1}};
      interrupt <= 1'b0;
    end else begin
      if (write && address == 2'd2) compare[31:0] <= write_data;
      if (write && address == 2'd3) compare[63:32] <= write_data;
      interrupt <= now >= compare;
    end

  always @(posedge clock)
    case (address)
      2'd0: read_data <= now[31:0];
      2'd1: read_data <= now[63:32];
      2'd2: read_data <= compare[31:0];
      default: read_data <= compare[63:32];
    endcase

endmodule
`default_nettype wire
