// SPDX-License-Identifier: Apache-2.0
// Watchdog: once started (control, 4: bit 2) it ends a second after the last write to 8.
`default_nettype none

module soc_watchdog #(
    parameter CLOCK_HZ = 50000000
) (
    input  wire        clock,
    input  wire        reset,
    input  wire [ 1:0] address,
    input  wire        write,
    input  wire        start_bit,
    output wire        ended
);

  reg running;
  reg [25:0] left  /* verilator public_flat_rw */;
  assign ended = running && left == 26'd0;
  always @(posedge clock)
    if (reset) begin
      running <= 1'b0;
      left    <= CLOCK_HZ[25:0];
    end else begin
      if (write && address == 2'd1 && start_bit) running <= 1'b1;
      if (!running || (write && address == 2'd2)) left <= CLOCK_HZ[25:0];
      else if (left != 26'd0) left <= left - 26'd1;
    end

endmodule
`default_nettype wire
