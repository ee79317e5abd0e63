// SPDX-License-Identifier: Apache-2.0
// Ports of the vendor's PLL, for lint: the vendor's tool has the real one.
`default_nettype none
/* verilator lint_off UNUSEDPARAM */

module altpll #(
    parameter intended_device_family = "",
    parameter lpm_type = "",
    parameter operation_mode = "",
    parameter pll_type = "",
    parameter bandwidth_type = "",
    parameter compensate_clock = "",
    parameter inclk0_input_frequency = 0,
    parameter clk0_multiply_by = 1,
    parameter clk0_divide_by = 1,
    parameter clk0_duty_cycle = 50,
    parameter clk0_phase_shift = "0",
    parameter clk1_multiply_by = 1,
    parameter clk1_divide_by = 1,
    parameter clk1_duty_cycle = 50,
    parameter clk1_phase_shift = "0",
    parameter port_inclk0 = "",
    parameter port_clk0 = "",
    parameter port_clk1 = "",
    parameter port_locked = "",
    parameter width_clock = 5
) (
    input  wire [            1:0] inclk,
    output wire [width_clock-1:0] clk,
    output wire                   locked
);

  assign clk = {{width_clock - 2{1'b0}}, {2{inclk[0]}}};
  assign locked = !inclk[1];

endmodule
`default_nettype wire
