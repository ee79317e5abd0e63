// SPDX-License-Identifier: Apache-2.0
// Made by addresses.py of addresses.toml.
localparam [31:12] PAGE_OF_ROM = 20'h80000;
localparam [31:12] PAGE_OF_ROM_UPPER = 20'h80020;
localparam [31:12] PAGE_OF_RAM = 20'h80001;
localparam [31:12] PAGE_OF_EXTERNAL = 20'h80800;
localparam [31:12] PAGE_OF_UART = 20'h10000;
localparam [31:12] PAGE_OF_CAPTURE = 20'h10001;
localparam [31:12] PAGE_OF_SPI = 20'h10002;
localparam [31:12] PAGE_OF_WATCHDOG = 20'h10003;
localparam [31:12] PAGE_OF_TIMER = 20'h10004;
localparam [31:12] PAGE_OF_PINS = 20'h10005;
