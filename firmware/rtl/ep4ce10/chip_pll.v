// SPDX-License-Identifier: Apache-2.0
// The family's PLL, 50 MHz from the board's 50 MHz: a global clock with a known phase, and `locked` for the reset. The SDRAM's clock is 3 ns ahead.
`default_nettype none

module chip_pll (
    input  wire clock_in,
    output wire clock,
    output wire sdram_clock,
    output wire locked
);

  wire [4:0] clocks;
  assign clock = clocks[0];
  assign sdram_clock = clocks[1];

  altpll #(
      .intended_device_family("Cyclone IV E"),
      .lpm_type("altpll"),
      .operation_mode("NORMAL"),
      .pll_type("AUTO"),
      .bandwidth_type("AUTO"),
      .compensate_clock("CLK0"),
      .inclk0_input_frequency(20000),  // ps
      .clk0_multiply_by(1),
      .clk0_divide_by(1),
      .clk0_duty_cycle(50),
      .clk0_phase_shift("0"),
      .clk1_multiply_by(1),
      .clk1_divide_by(1),
      .clk1_duty_cycle(50),
      .clk1_phase_shift("-3000"),  // ps
      .port_inclk0("PORT_USED"),
      .port_clk0("PORT_USED"),
      .port_clk1("PORT_USED"),
      .port_locked("PORT_USED"),
      .width_clock(5)
  ) pll (
      .inclk ({1'b0, clock_in}),
      .clk   (clocks),
      .locked(locked)
  );

  wire unused = &{1'b0, clocks[4:2]};

endmodule
`default_nettype wire
