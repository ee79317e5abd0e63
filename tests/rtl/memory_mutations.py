# SPDX-License-Identifier: Apache-2.0
"""Faults to plant in the cache and in the SDRAM's controller: name, file, a text that is unique there, its replacement."""

CACHE, SDRAM = "soc_cache.v", "soc_sdram.v"
FEW = ("store_leaves_its_line", "refresh_too_seldom")

MUTATIONS = (
  # Cache.
  ("hit_without_valid", CACHE, "tag == {1'b1, code_address", "tag == {tag[22], code_address"),
  ("hit_of_any_tag", CACHE, "tag == {1'b1, code_address[22:TOP_OF_INDEX+1]}", "tag[22]"),
  ("store_leaves_its_line", CACHE, "accessing && (step == 4'd12 || tag_sets)", "tag_sets"),
  ("line_stays_valid_while_it_is_replaced", CACHE, "step == 4'd12 || tag_sets", "(step == 4'd12 && !reading) || tag_sets"),
  ("tag_is_never_set", CACHE, "{tag_sets, line", "{1'b0, line"),
  ("tag_set_by_a_store", CACHE, "wire tag_sets = reading &&", "wire tag_sets = accessing &&"),
  ("tag_is_looked_up_a_tick_late", CACHE, "read_address(code_next[", "read_address(code_address["),
  ("word_before_its_upper_half", CACHE, "step + 4'd1;", "step;"),
  ("words_in_arrival_two_at_once", CACHE, "passed <= passed + 2'd1", "passed <= passed"),
  ("follows_after_a_jump", CACHE, "if (code_jumps || (code_read", "if ((code_read"),
  ("follows_where_the_first_tick_jumps", CACHE, "!for_data && !code_jumps", "!for_data"),
  ("follows_into_the_next_line", CACHE, "(code_read && arrived && &code_address[3:2])", "1'b0"),
  ("follows_a_line_for_data", CACHE, "following <= !for_data && !code_jumps", "following <= !code_jumps"),
  ("data_after_instructions", CACHE, "for_data ? address : code_address", "code_misses ? code_address : address"),
  ("data_ready_before_the_last_half", CACHE, "data_asked && step == 4'd1", "data_asked && step == 4'd4"),
  ("data_ready_for_a_fetch's_line", CACHE, "reading && data_asked && step", "reading && step"),
  ("load_reads_again_and_again", CACHE, "read && !data_ready;", "read;"),
  ("halves_exchanged", CACHE, "half_number[1] == i[0]", "half_number[1] != i[0]"),
  ("half_written_to_the_load's_place", CACHE, "half_valid ? {line[TOP_OF_INDEX:4], half_number[3:2]} :", "1'b0 ? {line[TOP_OF_INDEX:4], half_number[3:2]} :"),
  # Controller.
  ("burst_from_the_line's_begin", SDRAM, "{line[3:2], 1'b0} - step[2:0]", "3'd0 - step[2:0]"),
  ("half_a_tick_late", SDRAM, "reading && step <= 4'd8", "reading && step <= 4'd7"),
  ("bank_of_a_row_bit", SDRAM, "taken ? address[11:10] :", "taken ? {address[11], 1'b0} :"),
  ("row_without_its_top_bit", SDRAM, "{2'd0, address[22:12]}", "{3'd0, address[21:12]}"),
  ("column_without_its_top_bit", SDRAM, "1'b0, line[9:2], second_half}", "2'b00, line[8:2], second_half}"),
  ("row_stays_open", SDRAM, "!writing || second_half, 1'b0", "1'b0, 1'b0"),
  ("first_write_closes_the_row", SDRAM, "!writing || second_half, 1'b0", "1'b1, 1'b0"),
  ("masks_exchanged", SDRAM, "second_half ? ~write_bytes[3:2] : ~write_bytes[1:0]", "second_half ? ~write_bytes[1:0] : ~write_bytes[3:2]"),
  ("read_is_masked", SDRAM, "!writing ? 2'd0 :", "1'b0 ? 2'd0 :"),
  ("write_drives_nothing", SDRAM, "!reset && column_now && writing", "1'b0"),
  ("read_drives", SDRAM, "!reset && column_now && writing", "!reset && accessing"),
  ("write_taken_before_its_upper_half", SDRAM, "writing && step == 4'd11", "writing && step == 4'd12"),
  ("refresh_forgotten", SDRAM, "if (refresh_now) command = REFRESH;", ""),
  ("refresh_too_seldom", SDRAM, "REFRESH_TICKS = 9'd389", "REFRESH_TICKS = 9'd395"),
  ("access_right_after_a_refresh", SDRAM, "taken ? 4'd12 : 4'd4", "taken ? 4'd12 : 4'd1"),
  ("access_cut_short", SDRAM, "taken ? 4'd12 : 4'd4", "4'd4"),
  ("refresh_after_an_access_only", SDRAM, "idle && !due && (read_line", "idle && (read_line"),
  ("start_too_soon", SDRAM, "start <= start + 6'd1", "start <= start + 6'd2"),
  ("start_without_closing", SDRAM, "start_closes ? CLOSE_ALL :", ""),
  ("start_without_refreshes", SDRAM, "start_sets_mode ? SET_MODE : REFRESH", "start_sets_mode ? SET_MODE : NOTHING"),
  ("another_latency", SDRAM, "13'b000_1_00_010_0_011", "13'b000_1_00_011_0_011"),
  ("interleaved_bursts", SDRAM, "13'b000_1_00_010_0_011", "13'b000_1_00_010_1_011"),
  ("access_before_the_mode", SDRAM, "started && step == 4'd0", "step == 4'd0"),
  ("reset_forgets_the_start", SDRAM, "start      <= 6'd0;", ""),
)
