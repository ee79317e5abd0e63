// SPDX-License-Identifier: Apache-2.0
// The whole design on a chip whose block RAM has two ports, all on one clock of 50 MHz (EP4CE10; the simulation).
`default_nettype none

module pharos_chip #(
    parameter INPUTS = 12,
    parameter ROM_FILE = "loader.hex",
    parameter CACHE_INDEX_BITS = 7
) (
    input  wire              clock,
    input  wire              power_on_reset,
    input  wire [INPUTS-1:0] photodiodes,
    input  wire              uart_receive,
    output wire              uart_transmit,
    output wire              spi_clock,
    output wire              spi_select_n,
    output wire              spi_out,
    input  wire              spi_in,
    output wire [       3:0] leds,
    input  wire [       7:0] pin_levels,
    output wire [       7:0] pin_outputs,
    output wire [       7:0] pin_driven,
    // SDRAM of 16 bits.
    output wire              sdram_ras_n,
    output wire              sdram_cas_n,
    output wire              sdram_we_n,
    output wire [       1:0] sdram_bank,
    output wire [      12:0] sdram_address,
    output wire [       1:0] sdram_mask,
    output wire              sdram_drive,
    output wire [      15:0] sdram_data_out,
    input  wire [      15:0] sdram_data_in,
    output wire              trace_ends
);

  wire reset  /* verilator public_flat_rd */;
  wire code_read, ram_read;
  wire [3:0] ram_write;
  wire [22:2] code_address, code_next, ram_address;
  wire [31:0] code_data, ram_write_data, ram_data;
  wire external_code_read  /* verilator public_flat_rd */, external_code_wait  /* verilator public_flat_rd */;
  wire code_jumps, external_read, external_wait;
  wire [3:0] external_write;
  wire [31:0] external_code_data, external_data;
  wire capture_read, capture_write, capture_interrupt;
  wire [5:2] capture_address;
  wire [31:0] capture_write_data, capture_data;

  pharos_soc #(
      .CLOCK_HZ(50000000),
      .ROM_FILE(ROM_FILE),
      .LAST_RAM_PAGE(5'd8),
      .EXTERNAL(1)
  ) soc (
      .clock(clock),
      .power_on_reset(power_on_reset),
      .reset(reset),
      .code_read(code_read),
      .code_address(code_address),
      .code_wait(1'b0),
      .code_data(code_data),
      .ram_read(ram_read),
      .ram_write(ram_write),
      .ram_address(ram_address),
      .ram_write_data(ram_write_data),
      .ram_wait(1'b0),
      .ram_data(ram_data),
      .external_code_read(external_code_read),
      .code_next(code_next),
      .code_jumps(code_jumps),
      .external_code_wait(external_code_wait),
      .external_code_data(external_code_data),
      .external_read(external_read),
      .external_write(external_write),
      .external_wait(external_wait),
      .external_data(external_data),
      .capture_read(capture_read),
      .capture_write(capture_write),
      .capture_address(capture_address),
      .capture_write_data(capture_write_data),
      .capture_wait(1'b0),
      .capture_data(capture_data),
      .uart_receive(uart_receive),
      .uart_transmit(uart_transmit),
      .spi_clock(spi_clock),
      .spi_select_n(spi_select_n),
      .spi_out(spi_out),
      .spi_in(spi_in),
      .leds(leds),
      .pin_levels(pin_levels),
      .pin_outputs(pin_outputs),
      .pin_driven(pin_driven),
      .trace_ends(trace_ends)
  );

  // Page 8 of the RAM is stored where page 0, the ROM's, would be: addresses need no subtraction.
  soc_ram ram (
      .clock(clock),
      .read_a(code_read),
      .address_a(code_address[14:2]),
      .data_a(code_data),
      .read_b(ram_read),
      .write_b(ram_write),
      .address_b(ram_address[14:2]),
      .write_data_b(ram_write_data),
      .data_b(ram_data)
  );

  soc_cache #(
      .INDEX_BITS(CACHE_INDEX_BITS)
  ) cache (
      .clock(clock),
      .power_on_reset(power_on_reset),
      .reset(reset),
      .code_read(external_code_read),
      .code_address(code_address),
      .code_next(code_next),
      .code_jumps(code_jumps),
      .code_wait(external_code_wait),
      .code_data(external_code_data),
      .read(external_read),
      .write(external_write),
      .address(ram_address),
      .write_data(ram_write_data),
      .wait_data(external_wait),
      .read_data(external_data),
      .sdram_ras_n(sdram_ras_n),
      .sdram_cas_n(sdram_cas_n),
      .sdram_we_n(sdram_we_n),
      .sdram_bank(sdram_bank),
      .sdram_address(sdram_address),
      .sdram_mask(sdram_mask),
      .sdram_drive(sdram_drive),
      .sdram_data_out(sdram_data_out),
      .sdram_data_in(sdram_data_in)
  );

  pharos_capture #(
      .INPUTS(INPUTS),
      .DEPTH(256)
  ) capture (
      .clock(clock),
      .reset(reset),
      .pins(photodiodes),
      .bus_address(capture_address),
      .bus_read(capture_read),
      .bus_write(capture_write),
      .bus_writedata(capture_write_data),
      .bus_readdata(capture_data),
      .bus_irq(capture_interrupt)
  );

  wire unused = &{1'b0, capture_interrupt};

endmodule
`default_nettype wire
