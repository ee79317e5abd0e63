# SPDX-License-Identifier: Apache-2.0
"""Faults to plant in the core: name, file, a text that is unique there, its replacement."""

CORE = "pharos_core.v"
FEW = ("no_bypass_of_operand_1", "branch_flushes_nothing", "signed_division_forgets_sign")

MUTATIONS = (
  # Arithmetic.
  ("less_ignores_signs", "core_alu.v", "!compare_unsigned && a[31] != b[31]", "1'b0"),
  ("less_always_signed", "core_alu.v", "(!compare_unsigned && a[31] != b[31])", "(a[31] != b[31])"),
  ("no_carry_into_difference", "core_alu.v", "{32'd0, subtract}", "33'd0"),
  ("shift_by_16_is_by_15", "core_alu.v", "{{16{fill}}, shift_8[31:16]}", "{{15{fill}}, shift_8[31:15]}"),
  ("arithmetic_shift_without_sign", "core_alu.v", "arithmetic_shift && a[31]", "1'b0"),
  ("left_shift_not_reversed_back", "core_alu.v", "SLL: result = reversed(shifted);", "SLL: result = shifted;"),
  ("equal_without_top_bit", "core_alu.v", "a == b", "a[30:0] == b[30:0]"),
  # Decoder.
  ("store_immediate_of_load", "core_decode.v", "if (is_store) immediate", "if (1'b0) immediate"),
  ("branch_immediate_without_bit_11", "core_decode.v", "instruction[7], instruction[30:25]", "1'b0, instruction[30:25]"),
  ("jump_immediate_without_bit_11", "core_decode.v", "instruction[20], instruction[30:21]", "1'b0, instruction[30:21]"),
  ("unknown_shift_accepted", "core_decode.v", "(!shifts || plain ||", "(!shifts || 1'b1 ||"),
  ("unknown_operation_accepted", "core_decode.v", "(other && (funct3 == 3'd0 || funct3 == 3'd5))", "other"),
  ("wide_load_accepted", "core_decode.v", "is_load && funct3 != 3'd3 &&", "is_load &&"),
  ("unknown_branch_accepted", "core_decode.v", "is_branch && funct3[2:1] != 2'b01", "is_branch"),
  ("unknown_jump_accepted", "core_decode.v", "is_jalr && funct3 == 3'd0", "is_jalr"),
  ("immediate_add_subtracts", "core_decode.v", "(is_op && funct3 == 3'd0 && instruction[30])",
    "((is_op || is_op_immediate) && funct3 == 3'd0 && instruction[30])"),
  # Multiplication and division.
  ("mulhsu_reads_b_signed", "core_multiply.v", "b[WIDTH-1] && operation == 2'd1;",
    "b[WIDTH-1] && (operation == 2'd1 || operation == 2'd2);"),
  ("middle_products_lose_carry", "core_multiply.v", "{1'b0, low_high} + {1'b0, high_low}", "{1'b0, low_high + high_low}"),
  ("product_one_tick_early", "core_multiply.v", "assign done = multiplied;", "assign done = started;"),
  ("signed_division_forgets_sign", "core_divide.v", "operation[1] ? a_negative :", "operation[1] ? 1'b0 :"),
  ("division_by_zero_negated", "core_divide.v", " && b != 0;", ";"),
  ("division_a_bit_short", "core_divide.v", "busy && left == 0", "busy && left == 1"),
  ("negative_divisor_kept", "core_divide.v", "b_negative ? -b : b;", "b;"),
  # Control registers.
  ("interrupt_ignores_its_enable", "core_csr.v", "enabled && timer_enabled &&", "enabled &&"),
  ("trap_keeps_interrupts_on", "core_csr.v", "enabled        <= 1'b0;\n      enabled_before <= enabled;",
    "enabled_before <= enabled;"),
  ("return_keeps_interrupts_off", "core_csr.v", "enabled        <= enabled_before;", ""),
  ("read_only_register_written", "core_csr.v", "|| (number[11:10] == 2'b11 && !reads_only)", ""),
  ("clear_sets", "core_csr.v", "value & ~operand", "value | ~operand"),
  ("instret_without_carry", "core_csr.v", "instret <= instret + 64'd1", "instret[31:0] <= instret[31:0] + 32'd1"),
  ("cycle_high_is_low", "core_csr.v", "CYCLEH: value = cycle[63:32]", "CYCLEH: value = cycle[31:0]"),
  ("cause_of_interrupt_without_its_bit", "core_csr.v", "{trap_interrupt, trap_cause}", "{1'b0, trap_cause}"),
  # Bytes.
  ("signed_byte_unsigned", "core_lanes.v", "byte_wide ? word[7]", "byte_wide ? 1'b0"),
  ("half_is_a_byte", "core_lanes.v", "half_wide ? 4'b0011", "half_wide ? 4'b0001"),
  ("store_not_rotated_by_two", "core_lanes.v", "offset[1] ? {by_one[15:0], by_one[31:16]}", "1'b0 ? {by_one[15:0], by_one[31:16]}"),
  ("crossing_load_forgets_lower_word", "core_lanes.v", "(crosses && bytes[i])", "1'b0"),
  ("crossing_not_seen", "core_lanes.v", "crosses = bytes[7:4] != 4'd0", "crosses = 1'b0"),
  ("upper_word_is_the_lower_again", CORE, "sum[31:2] + 30'd1", "sum[31:2]"),
  ("lower_word_not_kept", CORE, "if (lower_fresh) lower_lanes", "lower_lanes"),
  ("upper_word_of_store_left_out", CORE, "!(x_store && !last_accepted)", "!(x_store && !accepted)"),
  # Registers.
  ("second_copy_not_written", "core_registers.v", "if (write) copy_2", "if (write && write_number != 5'd5) copy_2"),
  # Pipeline.
  ("no_bypass_of_operand_1", CORE, "bypass_1 ? bypass : stored_1", "stored_1"),
  ("no_bypass_of_operand_2", CORE, "bypass_2 ? bypass : stored_2", "stored_2"),
  ("bypass_of_what_is_not_written", CORE, "bypass_1 <= write_back && x_word", "bypass_1 <= x_valid && x_word"),
  ("register_zero_from_memory", CORE, "operand_1 = zero_1 ? 32'd0 :", "operand_1 ="),
  ("branch_flushes_nothing", CORE, "else if (redirect) d_valid <= 1'b0;", ""),
  ("execute_not_flushed", CORE, "x_valid <= d_valid && !redirect;", "x_valid <= d_valid;"),
  ("fetched_word_not_held", CORE, "d_fresh ? ibus_readdata : d_word_held", "ibus_readdata"),
  ("fetch_fault_not_held", CORE, "d_fresh ? ibus_fault : d_fault_held", "ibus_fault"),
  ("fetch_ignores_wait", CORE, "ibus_read && !ibus_wait", "ibus_read"),
  ("store_ignores_wait", CORE, "!(x_store && !last_accepted)", "1'b1"),
  ("load_ignores_wait", CORE, "accesses && !dbus_wait;\n", "accesses;\n"),
  ("interrupt_in_a_waiting_request", CORE, "first && !x_waiting && interrupt", "first && interrupt"),
  ("interrupt_within_an_instruction", CORE, "first && !x_waiting && interrupt", "x_valid && !x_waiting && interrupt"),
  ("refused_access_not_trapped", CORE, "accepted && dbus_fault", "1'b0"),
  ("jump_to_half_word_accepted", CORE, "jumps && target[1]", "1'b0"),
  ("jalr_keeps_bit_0", CORE, "{sum[31:1], 1'b0}", "sum"),
  ("trapped_jump_writes_link", CORE, "x_writes && !trapped && !interrupted", "x_writes && !interrupted"),
  ("interrupted_instruction_writes", CORE, "x_writes && !trapped && !interrupted", "x_writes && !trapped"),
  ("trapped_instruction_retires", CORE, "ends && x_valid && !trapped && !interrupted", "ends && x_valid && !interrupted"),
  ("fence_does_not_refetch", CORE, "|| x_fence_instructions);", ");"),
  ("upper_immediate_adds_register", CORE, "|| d_load_upper;", ";"),
)
