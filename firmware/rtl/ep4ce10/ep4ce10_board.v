// SPDX-License-Identifier: Apache-2.0
// Top of the design on the board that README names: PLL, reset, pins.
`default_nettype none

module ep4ce10_board (
    input  wire        clock_50,
    input  wire        reset_n,         // key to ground
    input  wire [11:0] photodiodes,     // high: light
    input  wire        uart_receive,
    output wire        uart_transmit,
    output wire        flash_clock,
    output wire        flash_select_n,
    output wire        flash_out,       // to the flash
    input  wire        flash_in,
    output wire        sdram_clock,
    output wire        sdram_clock_enable,
    output wire        sdram_select_n,
    output wire        sdram_ras_n,
    output wire        sdram_cas_n,
    output wire        sdram_we_n,
    output wire [ 1:0] sdram_bank,
    output wire [12:0] sdram_address,
    output wire [ 1:0] sdram_mask,
    inout  wire [15:0] sdram_data,
    output wire [ 3:0] leds,
    inout  wire [ 7:0] pins             // pin 7 to ground: development jumper
);

  wire clock, locked;
  chip_pll pll (
      .clock_in(clock_50),
      .clock(clock),
      .sdram_clock(sdram_clock),
      .locked(locked)
  );

  // The configuration sets these registers: the chip starts in reset, until the clock is good.
  reg [2:0] waiting = 3'b111;
  wire ready = locked && reset_n;
  always @(posedge clock) waiting <= {waiting[1:0], !ready};

  wire [7:0] outputs, driven;
  wire sdram_drive;
  wire [15:0] sdram_data_out;
  assign sdram_clock_enable = 1'b1;
  assign sdram_select_n = 1'b0;
  assign sdram_data = sdram_drive ? sdram_data_out : 16'hzzzz;
  wire trace_ends;
  pharos_chip #(
      .INPUTS(12),
      .ROM_FILE("loader.hex")
  ) chip (
      .clock(clock),
      .power_on_reset(waiting[2]),
      .photodiodes(photodiodes),
      .uart_receive(uart_receive),
      .uart_transmit(uart_transmit),
      .spi_clock(flash_clock),
      .spi_select_n(flash_select_n),
      .spi_out(flash_out),
      .spi_in(flash_in),
      .leds(leds),
      .pin_levels(pins),
      .pin_outputs(outputs),
      .pin_driven(driven),
      .sdram_ras_n(sdram_ras_n),
      .sdram_cas_n(sdram_cas_n),
      .sdram_we_n(sdram_we_n),
      .sdram_bank(sdram_bank),
      .sdram_address(sdram_address),
      .sdram_mask(sdram_mask),
      .sdram_drive(sdram_drive),
      .sdram_data_out(sdram_data_out),
      .sdram_data_in(sdram_data),
      .trace_ends(trace_ends)
  );

  genvar i;
  generate
    for (i = 0; i < 8; i = i + 1) begin : pin
      assign pins[i] = driven[i] ? outputs[i] : 1'bz;
    end
  endgenerate

  wire unused = &{1'b0, trace_ends};

endmodule
`default_nettype wire
