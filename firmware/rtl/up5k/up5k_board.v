// SPDX-License-Identifier: Apache-2.0
// Top of the design on the board that README names: clocks, reset, pads, receivers.
`default_nettype none

module up5k_board #(
    parameter ROM_FILE = "loader.hex"
) (
    input  wire       clock_12,
    inout  wire [3:0] receiver_e,      // TS4231, envelope: low is light
    inout  wire [3:0] receiver_d,
    input  wire       uart_receive,
    output wire       uart_transmit,
    output wire       flash_clock,
    output wire       flash_select_n,
    output wire       flash_out,       // to the flash
    input  wire       flash_in,
    output wire [2:0] leds_n,
    inout  wire       development_n    // jumper to ground
);

  // 48 MHz of the crystal's 12, and a third of it for the core.
  wire capture_clock, locked;
  SB_PLL40_PAD #(
      .FEEDBACK_PATH("SIMPLE"),
      .DIVR(4'd0),
      .DIVF(7'd63),
      .DIVQ(3'd4),
      .FILTER_RANGE(3'd1)
  ) pll (
      .PACKAGEPIN(clock_12),
      .PLLOUTGLOBAL(capture_clock),
      .RESETB(1'b1),
      .BYPASS(1'b0),
      .LOCK(locked)
  );
  reg [1:0] third = 2'd0;
  reg divided = 1'b0;
  always @(posedge capture_clock) begin
    third   <= third == 2'd2 ? 2'd0 : third + 2'd1;
    divided <= third == 2'd0;
  end
  wire clock;
  SB_GB clock_buffer (
      .USER_SIGNAL_TO_GLOBAL_BUFFER(divided),
      .GLOBAL_BUFFER_OUTPUT(clock)
  );

  // The configuration clears registers: the chip starts in reset, until the clock is good.
  reg [2:0] good = 3'b000;
  always @(posedge clock) good <= {good[1:0], locked};

  wire reset;
  wire [3:0] e_levels, d_levels, e_driven, d_driven, ready;
  wire e_out, d_out;
  ts4231_start #(
      .RECEIVERS(4),
      .STEP_TICKS(32)
  ) start (
      .clock(clock),
      .reset(!good[2]),
      .e_levels(e_levels),
      .d_levels(d_levels),
      .e_driven(e_driven),
      .d_driven(d_driven),
      .e_out(e_out),
      .d_out(d_out),
      .ready(ready)
  );
  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : receiver
      SB_IO #(
          .PIN_TYPE(6'b101001)  // output with enable, input as it is; no pull-up
      ) e_pad (
          .PACKAGE_PIN(receiver_e[i]),
          .OUTPUT_ENABLE(e_driven[i]),
          .D_OUT_0(e_out),
          .D_IN_0(e_levels[i])
      );
      SB_IO #(
          .PIN_TYPE(6'b101001)
      ) d_pad (
          .PACKAGE_PIN(receiver_d[i]),
          .OUTPUT_ENABLE(d_driven[i]),
          .D_OUT_0(d_out),
          .D_IN_0(d_levels[i])
      );
    end
  endgenerate

  wire jumper_n;
  SB_IO #(
      .PIN_TYPE(6'b000001),
      .PULLUP(1'b1)
  ) jumper_pad (
      .PACKAGE_PIN(development_n),
      .OUTPUT_ENABLE(1'b0),
      .D_OUT_0(1'b0),
      .D_IN_0(jumper_n)
  );

  wire [3:0] leds;
  assign leds_n = ~leds[2:0];
  wire [7:0] outputs, driven;
  wire trace_ends;
  up5k_chip #(
      .INPUTS(4),
      .CLOCK_HZ(16000000),
      .ROM_FILE(ROM_FILE)
  ) chip (
      .clock(clock),
      .capture_clock(capture_clock),
      .power_on_reset(!good[2]),
      .photodiodes(ready & ~e_levels),
      .uart_receive(uart_receive),
      .uart_transmit(uart_transmit),
      .spi_clock(flash_clock),
      .spi_select_n(flash_select_n),
      .spi_out(flash_out),
      .spi_in(flash_in),
      .leds(leds),
      .pin_levels({jumper_n, 7'h7F}),
      .pin_outputs(outputs),
      .pin_driven(driven),
      .reset(reset),
      .trace_ends(trace_ends)
  );

  wire unused = &{1'b0, reset, trace_ends, leds[3], outputs, driven};

endmodule
`default_nettype wire
