// SPDX-License-Identifier: Apache-2.0
// Core, bus, boot ROM and devices. RAM and capture block are the chip's: RAM has two ports on one chip and one on another,
// and the capture block may have a faster clock. Addresses: addresses.toml.
`default_nettype none

module pharos_soc #(
    parameter CLOCK_HZ = 50000000,
    parameter ROM_FILE = "loader.hex",
    parameter ROM_PORTS = 2,  // 1: a fetch from the ROM waits while data are read there
    parameter [4:0] LAST_RAM_PAGE = 5'd8,  // RAM is the pages of 4 KiB from 1 to this one, after the ROM
    parameter EXTERNAL = 0,  // 1: there is memory outside the chip
    parameter TIMER_COMPARE = 1,
    parameter ADDRESS_TICK = 0  // of the core
) (
    input  wire        clock,
    input  wire        power_on_reset,
    output reg         reset,             // of all but the memories: power on, watchdog
    // RAM: word addresses from the ROM on; data in the tick after a request without wait.
    output wire        code_read,
    output wire [22:2] code_address,
    input  wire        code_wait,
    input  wire [31:0] code_data,
    output wire        ram_read,
    output wire [ 3:0] ram_write,
    output wire [22:2] ram_address,
    output wire [31:0] ram_write_data,
    input  wire        ram_wait,
    input  wire [31:0] ram_data,
    // Memory outside the chip, where EXTERNAL: the same addresses and data to write, data in the tick after.
    output wire        external_code_read,
    output wire [22:2] code_next,               // code_address of the next tick
    output wire        code_jumps,              // it does not follow this one
    input  wire        external_code_wait,
    input  wire [31:0] external_code_data,
    output wire        external_read,
    output wire [ 3:0] external_write,
    input  wire        external_wait,
    input  wire [31:0] external_data,
    // Capture block: a request is held until a tick without wait, data in the tick after.
    output wire        capture_read,
    output wire        capture_write,
    output wire [ 5:2] capture_address,
    output wire [31:0] capture_write_data,
    input  wire        capture_wait,
    input  wire [31:0] capture_data,
    input  wire        uart_receive,
    output wire        uart_transmit,
    output wire        spi_clock,
    output wire        spi_select_n,
    output wire        spi_out,
    input  wire        spi_in,
    output wire [ 3:0] leds,
    input  wire [ 7:0] pin_levels,
    output wire [ 7:0] pin_outputs,
    output wire [ 7:0] pin_driven,
    output wire        trace_ends         // an instruction, for test benches
);

  `include "soc_addresses.vh"

  // Reset: 16 ticks after power on or the watchdog's end.
  reg [3:0] reset_left;
  wire watchdog_ended;
  always @(posedge clock)
    if (power_on_reset || watchdog_ended) begin
      reset      <= 1'b1;
      reset_left <= 4'd15;
    end else begin
      if (reset_left != 4'd0) reset_left <= reset_left - 4'd1;
      else reset <= 1'b0;
    end

  // The core.
  wire ibus_read, dbus_read, dbus_write, timer_interrupt;
  wire [31:2] ibus_address, ibus_next, dbus_address;
  wire [3:0] dbus_bytes;
  wire [31:0] dbus_writedata;
  reg [31:0] dbus_readdata;
  wire ibus_wait, dbus_wait, dbus_fault;
  reg ibus_fault;
  wire [31:0] ibus_readdata;
  wire [63:0] cycle;
  wire [31:0] trace_address;
  wire trace_trapped, trace_interrupted;
  pharos_core #(
      .ADDRESS_TICK(ADDRESS_TICK)
  ) core (
      .clock(clock),
      .reset(reset),
      .ibus_read(ibus_read),
      .ibus_address(ibus_address),
      .ibus_next(ibus_next),
      .ibus_jumps(code_jumps),
      .ibus_wait(ibus_wait),
      .ibus_readdata(ibus_readdata),
      .ibus_fault(ibus_fault),
      .dbus_read(dbus_read),
      .dbus_write(dbus_write),
      .dbus_address(dbus_address),
      .dbus_bytes(dbus_bytes),
      .dbus_writedata(dbus_writedata),
      .dbus_wait(dbus_wait),
      .dbus_readdata(dbus_readdata),
      .dbus_fault(dbus_fault),
      .timer_interrupt(timer_interrupt),
      .cycle(cycle),
      .trace_ends(trace_ends),
      .trace_address(trace_address),
      .trace_trapped(trace_trapped),
      .trace_interrupted(trace_interrupted)
  );

  // Instructions: ROM, RAM, memory outside.
  /* verilator lint_off CMPCONST */  // the last page may be the last of all
  function is_ram(input [31:12] page);
    is_ram = page[31:17] == PAGE_OF_RAM[31:17] && page[16:12] != 5'd0 && page[16:12] <= LAST_RAM_PAGE;
  endfunction
  /* verilator lint_on CMPCONST */

  // The ROM is 1,024 words at one page and 512 at another.
  wire i_upper = ibus_address[31:12] == PAGE_OF_ROM_UPPER && !ibus_address[11];
  wire i_rom = ibus_address[31:12] == PAGE_OF_ROM || i_upper;
  wire i_ram = is_ram(ibus_address[31:12]);
  wire i_external = EXTERNAL != 0 && ibus_address[31:23] == PAGE_OF_EXTERNAL[31:23];
  assign code_read = ibus_read && i_ram;
  assign external_code_read = ibus_read && i_external;
  assign code_address = ibus_address[22:2];
  assign code_next = ibus_next[22:2];
  wire rom_taken;
  assign ibus_wait = (i_ram && code_wait) || (i_rom && rom_taken) || (i_external && external_code_wait);
  reg i_from_ram, i_from_external;
  wire [31:0] rom_code, rom_data;
  always @(posedge clock) begin
    ibus_fault      <= !i_rom && !i_ram && !i_external;
    i_from_ram      <= i_ram;
    i_from_external <= i_external;
  end
  assign ibus_readdata = i_from_external ? external_code_data : i_from_ram ? code_data : rom_code;

  // Data.
  wire [31:12] page = dbus_address[31:12];
  wire d_upper = page == PAGE_OF_ROM_UPPER && !dbus_address[11];
  wire d_rom = page == PAGE_OF_ROM || d_upper;
  wire d_ram = is_ram(page);
  wire d_external = EXTERNAL != 0 && page[31:23] == PAGE_OF_EXTERNAL[31:23];
  wire d_uart = page == PAGE_OF_UART;
  wire d_capture = page == PAGE_OF_CAPTURE;
  wire d_spi = page == PAGE_OF_SPI;
  wire d_watchdog = page == PAGE_OF_WATCHDOG;
  wire d_timer = page == PAGE_OF_TIMER;
  wire d_pins = page == PAGE_OF_PINS;
  assign dbus_fault = !(d_ram || d_external || (d_rom && !dbus_write) || d_uart || d_capture || d_spi || d_watchdog || d_timer || d_pins);
  assign dbus_wait = (d_ram && ram_wait) || (d_external && external_wait) || (d_capture && capture_wait);

  assign ram_read = dbus_read && d_ram;
  assign ram_write = dbus_bytes & {4{dbus_write && d_ram}};
  assign ram_address = dbus_address[22:2];
  assign ram_write_data = dbus_writedata;
  assign external_read = dbus_read && d_external;
  assign external_write = dbus_bytes & {4{dbus_write && d_external}};
  assign capture_read = dbus_read && d_capture;
  assign capture_write = dbus_write && d_capture;
  assign capture_address = dbus_address[5:2];
  assign capture_write_data = dbus_writedata;

  wire uart_read = dbus_read && d_uart;
  wire uart_write = dbus_write && d_uart;
  wire spi_read = dbus_read && d_spi;
  wire spi_write = dbus_write && d_spi;
  wire watchdog_write = dbus_write && d_watchdog;
  wire timer_write = dbus_write && d_timer;
  wire pins_write = dbus_write && d_pins;

  assign rom_taken = ROM_PORTS == 1 && dbus_read && d_rom;
  soc_rom #(
      .FILE(ROM_FILE),
      .PORTS(ROM_PORTS)
  ) rom (
      .clock(clock),
      .read_a(ibus_read),
      .address_a({i_upper, ibus_address[11:2]}),
      .data_a(rom_code),
      .read_b(dbus_read && d_rom),
      .address_b({d_upper, dbus_address[11:2]}),
      .data_b(rom_data)
  );

  wire [7:0] uart_data;
  soc_uart uart (
      .clock(clock),
      .reset(reset),
      .address(dbus_address[4:2]),
      .read(uart_read),
      .write(uart_write),
      .write_data(dbus_writedata[7:0]),
      .read_data(uart_data),
      .receive(uart_receive),
      .transmit(uart_transmit)
  );

  wire [31:0] spi_data;
  soc_spi spi (
      .clock(clock),
      .reset(reset),
      .address(dbus_address[3:2]),
      .read(spi_read),
      .write(spi_write),
      .write_data(dbus_writedata),
      .read_data(spi_data),
      .spi_clock(spi_clock),
      .spi_select_n(spi_select_n),
      .spi_out(spi_out),
      .spi_in(spi_in)
  );

  soc_watchdog #(
      .CLOCK_HZ(CLOCK_HZ)
  ) watchdog (
      .clock(clock),
      .reset(reset),
      .address(dbus_address[3:2]),
      .write(watchdog_write),
      .start_bit(dbus_writedata[2]),
      .ended(watchdog_ended)
  );

  wire [31:0] timer_data;
  soc_timer #(
      .COMPARE(TIMER_COMPARE)
  ) timer (
      .clock(clock),
      .reset(reset),
      .now(cycle),
      .address(dbus_address[3:2]),
      .write(timer_write),
      .write_data(dbus_writedata),
      .read_data(timer_data),
      .interrupt(timer_interrupt)
  );

  wire [7:0] pins_data;
  soc_pins pins (
      .clock(clock),
      .reset(reset),
      .address(dbus_address[3:2]),
      .write(pins_write),
      .write_data(dbus_writedata[7:0]),
      .read_data(pins_data),
      .leds(leds),
      .levels(pin_levels),
      .outputs(pin_outputs),
      .driven(pin_driven)
  );

  // What the request of the tick before is answered with.
  reg from_ram, from_external, from_rom, from_uart, from_capture, from_spi, from_timer;
  always @(posedge clock) begin
    from_ram      <= d_ram;
    from_external <= d_external;
    from_rom      <= d_rom;
    from_uart     <= d_uart;
    from_capture  <= d_capture;
    from_spi      <= d_spi;
    from_timer    <= d_timer;
  end
  always @*
    if (from_ram) dbus_readdata = ram_data;
    else if (from_external) dbus_readdata = external_data;
    else if (from_rom) dbus_readdata = rom_data;
    else if (from_uart) dbus_readdata = {24'd0, uart_data};
    else if (from_capture) dbus_readdata = capture_data;
    else if (from_spi) dbus_readdata = spi_data;
    else if (from_timer) dbus_readdata = timer_data;
    else dbus_readdata = {24'd0, pins_data};

  wire unused = &{1'b0, trace_address, trace_trapped, trace_interrupted, PAGE_OF_RAM[16:12], PAGE_OF_EXTERNAL[22:12], ibus_next[31:23]};

endmodule
`default_nettype wire
