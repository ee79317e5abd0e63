// SPDX-License-Identifier: Apache-2.0
// The design on an iCE40UP5K without its pads: core and devices on one clock, inputs and stamps of the capture block on one of
// 48 MHz, of any phase to it.
`default_nettype none

module up5k_chip #(
    parameter INPUTS = 4,
    parameter CLOCK_HZ = 16000000,
    parameter ROM_FILE = "loader.hex"
) (
    input  wire              clock,
    input  wire              capture_clock,
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
    output wire              reset,
    output wire              trace_ends
);

  wire code_read, code_wait, ram_read;
  wire [3:0] ram_write;
  wire [22:2] code_address, ram_address;
  // There is no memory outside.
  wire [22:2] code_next;
  wire external_code_read, code_jumps, external_read;
  wire [3:0] external_write;
  wire [31:0] code_data, ram_write_data, ram_data;
  wire capture_read, capture_write, capture_wait;
  wire [5:2] capture_address;
  wire [31:0] capture_write_data, capture_data;

  pharos_soc #(
      .CLOCK_HZ(CLOCK_HZ),
      .ROM_FILE(ROM_FILE),
      .ROM_PORTS(1),
      .LAST_RAM_PAGE(5'd31),
      .TIMER_COMPARE(0),
      .ADDRESS_TICK(1)
  ) soc (
      .clock(clock),
      .power_on_reset(power_on_reset),
      .reset(reset),
      .code_read(code_read),
      .code_address(code_address),
      .code_wait(code_wait),
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
      .external_code_wait(1'b0),
      .external_code_data(32'd0),
      .external_read(external_read),
      .external_write(external_write),
      .external_wait(1'b0),
      .external_data(32'd0),
      .capture_read(capture_read),
      .capture_write(capture_write),
      .capture_address(capture_address),
      .capture_write_data(capture_write_data),
      .capture_wait(capture_wait),
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

  up5k_ram ram (
      .clock(clock),
      .read_a(code_read),
      .address_a(code_address[16:2]),
      .wait_a(code_wait),
      .data_a(code_data),
      .read_b(ram_read),
      .write_b(ram_write),
      .address_b(ram_address[16:2]),
      .write_data_b(ram_write_data),
      .data_b(ram_data)
  );

  up5k_capture #(
      .INPUTS(INPUTS),
      .DEPTH(512)
  ) capture (
      .capture_clock(capture_clock),
      .clock(clock),
      .reset(reset),
      .pins(photodiodes),
      .bus_address(capture_address),
      .bus_read(capture_read),
      .bus_write(capture_write),
      .bus_writedata(capture_write_data),
      .bus_wait(capture_wait),
      .bus_readdata(capture_data)
  );

  wire unused = &{1'b0, code_address[22:17], ram_address[22:17], code_next, external_code_read, code_jumps, external_read, external_write};

endmodule
`default_nettype wire
