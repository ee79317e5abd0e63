# SPDX-License-Identifier: Apache-2.0
# The period is that of CLOCK_HZ in soc/pharos_chip.v and of the PLL's input in chip_pll.v (test rtl.ep4ce10_project).
create_clock -name clock_50 -period 20.000 [get_ports clock_50]
derive_pll_clocks
derive_clock_uncertainty

# Synchronised inside, or slower than the clock by far.
set_false_path -from [get_ports {photodiodes[*] uart_receive reset_n pins[*]}]
set_false_path -to [get_ports {uart_transmit leds[*] pins[*]}]

# The flash's bus: 12.5 MHz, levels change half a period (40 ns) before they are taken.
set_max_delay -to [get_ports {flash_clock flash_select_n flash_out}] 15.000
set_min_delay -to [get_ports {flash_clock flash_select_n flash_out}] 0.000
set_max_delay -from [get_ports flash_in] 15.000
set_min_delay -from [get_ports flash_in] 0.000

# The SDRAM: its clock is 3 ns ahead, and leaves the chip as late as the commands do. A command that is on its pin 12 ns after the clock is
# there 5 ns before the edge that takes it (1.5 ns asked). Data come 5.4 ns after that clock, 10 ns before the edge that takes them here.
set_max_delay -to [get_ports {sdram_ras_n sdram_cas_n sdram_we_n sdram_bank[*] sdram_address[*] sdram_mask[*] sdram_data[*]}] 12.000
set_min_delay -to [get_ports {sdram_ras_n sdram_cas_n sdram_we_n sdram_bank[*] sdram_address[*] sdram_mask[*] sdram_data[*]}] 0.000
set_max_delay -from [get_ports {sdram_data[*]}] 8.000
set_min_delay -from [get_ports {sdram_data[*]}] 0.000
