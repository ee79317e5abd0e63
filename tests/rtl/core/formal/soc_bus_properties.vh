// SPDX-License-Identifier: Apache-2.0
// Read inside pharos_soc. p_: what is at an address, of the map.
  // Places of the address map, by their first page and their size in pages; the upper half of the ROM is half a page.
  function within(input [31:2] word, input [31:12] page, input [11:0] pages);
    within = word[31:12] - page < pages;
  endfunction
  wire [31:2] p_i = ibus_address, p_d = dbus_address;
  wire p_i_rom = within(p_i, PAGE_OF_ROM, 1) || (within(p_i, PAGE_OF_ROM_UPPER, 1) && !p_i[11]);
  wire p_i_ram = within(p_i, PAGE_OF_RAM, 8);
  wire p_i_external = within(p_i, PAGE_OF_EXTERNAL, 2048);
  wire p_d_rom = within(p_d, PAGE_OF_ROM, 1) || (within(p_d, PAGE_OF_ROM_UPPER, 1) && !p_d[11]);
  wire p_d_ram = within(p_d, PAGE_OF_RAM, 8);
  wire p_d_external = within(p_d, PAGE_OF_EXTERNAL, 2048);
  wire p_d_uart = within(p_d, PAGE_OF_UART, 1);
  wire p_d_capture = within(p_d, PAGE_OF_CAPTURE, 1);
  wire p_d_spi = within(p_d, PAGE_OF_SPI, 1);
  wire p_d_watchdog = within(p_d, PAGE_OF_WATCHDOG, 1);
  wire p_d_timer = within(p_d, PAGE_OF_TIMER, 1);
  wire p_d_pins = within(p_d, PAGE_OF_PINS, 1);
  wire reads = dbus_read, writes = dbus_write;
  wire [3:0] bytes = dbus_bytes;

  always @* begin
    assert (code_read == (ibus_read && p_i_ram) && code_address == p_i[22:2]);
    assert (external_code_read == (ibus_read && p_i_external));
    assert (ibus_wait == ((p_i_ram && code_wait) || (p_i_external && external_code_wait)));
    assert (ram_read == (reads && p_d_ram) && ram_write == (writes && p_d_ram ? bytes : 4'd0));
    assert (ram_address == p_d[22:2] && ram_write_data == dbus_writedata);
    assert (external_read == (reads && p_d_external) && external_write == (writes && p_d_external ? bytes : 4'd0));
    assert (capture_read == (reads && p_d_capture) && capture_write == (writes && p_d_capture));
    assert (uart_read == (reads && p_d_uart) && uart_write == (writes && p_d_uart));
    assert (spi_read == (reads && p_d_spi) && spi_write == (writes && p_d_spi));
    assert (watchdog_write == (writes && p_d_watchdog));
    assert (timer_write == (writes && p_d_timer));
    assert (pins_write == (writes && p_d_pins));
    assert (dbus_fault == !(p_d_ram || p_d_external || (p_d_rom && !writes) || p_d_uart || p_d_capture || p_d_spi || p_d_watchdog ||
                            p_d_timer || p_d_pins));
    assert (dbus_wait == ((p_d_ram && ram_wait) || (p_d_external && external_wait) || (p_d_capture && capture_wait)));
  end

  // What was asked in the tick before.
  reg asked = 0;
  reg was_i_rom, was_i_ram, was_i_external, was_rom, was_ram, was_external, was_uart, was_capture, was_spi, was_timer, was_pins;
  always @(posedge clock) begin
    asked <= 1;
    {was_i_rom, was_i_ram, was_i_external} <= {p_i_rom, p_i_ram, p_i_external};
    {was_rom, was_ram, was_external, was_uart} <= {p_d_rom, p_d_ram, p_d_external, p_d_uart};
    {was_capture, was_spi, was_timer, was_pins} <= {p_d_capture, p_d_spi, p_d_timer, p_d_pins};
  end
  always @*
    if (asked) begin
      assert (ibus_fault == !(was_i_rom || was_i_ram || was_i_external));
      if (was_i_rom) assert (ibus_readdata == rom_code);
      if (was_i_ram) assert (ibus_readdata == code_data);
      if (was_i_external) assert (ibus_readdata == external_code_data);
      if (was_rom) assert (dbus_readdata == rom_data);
      if (was_ram) assert (dbus_readdata == ram_data);
      if (was_external) assert (dbus_readdata == external_data);
      if (was_uart) assert (dbus_readdata == {24'd0, uart_data});
      if (was_capture) assert (dbus_readdata == capture_data);
      if (was_spi) assert (dbus_readdata == spi_data);
      if (was_timer) assert (dbus_readdata == timer_data);
      if (was_pins) assert (dbus_readdata == {24'd0, pins_data});
    end
