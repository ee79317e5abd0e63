// SPDX-License-Identifier: Apache-2.0
// LEDs and general pins: 0 LEDs, 4 levels, 8 outputs, 12 which pins are driven. All dark and undriven at reset.
`default_nettype none

module soc_pins (
    input  wire       clock,
    input  wire       reset,
    input  wire [1:0] address,
    input  wire       write,
    input  wire [7:0] write_data,
    output reg  [7:0] read_data,
    output reg  [3:0] leds,
    input  wire [7:0] levels,
    output reg  [7:0] outputs,
    output reg  [7:0] driven
);

  reg [7:0] sampled;
  reg [7:0] settled;
  always @(posedge clock) begin
    sampled <= levels;
    settled <= sampled;
    if (reset) begin
      leds    <= 4'd0;
      outputs <= 8'd0;
      driven  <= 8'd0;
    end else if (write) begin
      if (address == 2'd0) leds <= write_data[3:0];
      if (address == 2'd2) outputs <= write_data;
      if (address == 2'd3) driven <= write_data;
    end
    case (address)
      2'd0: read_data <= {4'd0, leds};
      2'd1: read_data <= settled;
      2'd2: read_data <= outputs;
      default: read_data <= driven;
    endcase
  end

endmodule
`default_nettype wire
