# SPDX-License-Identifier: Apache-2.0
# The period is that of CLOCK_HZ in soc/pharos_chip.v and of the PLL's input in chip_pll.v (test rtl.ep4ce10_project).
create_clock -name clock_50 -period 20.000 [get_ports clock_50]
derive_pll_clocks
# At its pin: with what its way out of the chip takes.
create_generated_clock -name sdram_clock -source [get_pins {pll|pll|auto_generated|pll1|clk[1]}] [get_ports sdram_clock]
derive_clock_uncertainty

# Synchronised inside, or slower than the clock by far.
set_false_path -from [get_ports {photodiodes[*] uart_receive reset_n pins[*]}]
set_false_path -to [get_ports {uart_transmit leds[*] pins[*]}]

# The flash's bus: 12.5 MHz, levels change half a period (40 ns) before they are taken.
set_max_delay -to [get_ports {flash_clock flash_select_n flash_out}] 15.000
set_min_delay -to [get_ports {flash_clock flash_select_n flash_out}] 0.000
set_max_delay -from [get_ports flash_in] 15.000
set_min_delay -from [get_ports flash_in] 0.000

# The SDRAM, by its sheet (README): read data 2.5 to 6.0 ns after its clock, inputs there 2.0 ns before and 1.0 ns after it; the lines 0 to 0.5 ns each.
set_output_delay -clock sdram_clock -max 2.500 [get_ports {sdram_ras_n sdram_cas_n sdram_we_n sdram_bank[*] sdram_address[*] sdram_mask[*] sdram_data[*]}]
set_output_delay -clock sdram_clock -min -1.500 [get_ports {sdram_ras_n sdram_cas_n sdram_we_n sdram_bank[*] sdram_address[*] sdram_mask[*] sdram_data[*]}]
set_input_delay -clock sdram_clock -max 7.000 [get_ports {sdram_data[*]}]
set_input_delay -clock sdram_clock -min 2.500 [get_ports {sdram_data[*]}]
# Data of an edge of that clock are taken 23 ns later, not 3.
set_multicycle_path -setup 2 -from [get_clocks sdram_clock] -to [get_clocks {pll|pll|auto_generated|pll1|clk[0]}]
