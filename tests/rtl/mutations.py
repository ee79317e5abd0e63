# SPDX-License-Identifier: Apache-2.0
"""Faults to plant in the capture logic: name, file, a text that is unique there, its replacement."""

RECORD = "{gap, stamp, changed, levels}"
CHANGED = "changed <= taken & watched;"

FEW = ("full_seen_too_late", "gap_not_marked", "records_counted_not_edges", "falling_edges_dropped")

MUTATIONS = (
  ("one_flop_synchroniser", "capture_inputs.v", "settled <= sampled;", "settled <= pins;"),
  ("falling_edges_dropped", "capture_inputs.v", CHANGED, "changed <= taken & watched & settled;"),
  ("mask_ignored", "capture_inputs.v", CHANGED, "changed <= taken;"),
  ("filter_one_short", "capture_inputs.v", "remaining == 0", "remaining <= 1"),
  ("filter_not_rearmed", "capture_inputs.v", "!differs[i] || taken[i]", "!differs[i]"),
  ("glitch_counted_when_taken", "capture_inputs.v", "|(waiting & ~differs & watched)", "|(waiting & watched)"),
  ("full_seen_too_late", "capture_fifo.v", "full  = write_index ==", "full  = readable_index =="),
  ("empty_fifo_popped", "capture_fifo.v", "pop && count != 0", "pop"),
  ("readable_too_soon", "capture_fifo.v", "readable_index <= write_index;",
    "readable_index <= write_index + {{ADDRESS_WIDTH{1'b0}}, store};"),
  ("head_lags_after_pop", "capture_fifo.v", "memory[next_read_index", "memory[read_index"),
  ("full_fifo_overwritten", "capture_fifo.v", "write && !full", "write"),
  ("clear_forgets_read_index", "capture_fifo.v", "read_index     <= 0;", "read_index     <= read_index;"),
  ("gap_not_marked", "capture_losses.v", "if (lose || interrupted) gap", "if (interrupted) gap"),
  ("gap_never_ends", "capture_losses.v", "else if (any) gap <= 1'b0;", ""),
  ("lost_counter_wraps", "capture_losses.v", "sum[LOST_WIDTH] ? {LOST_WIDTH{1'b1}} :", ""),
  ("records_counted_not_edges", "capture_losses.v", "ones(changed)", "6'd1"),
  ("losses_counted_once", "capture_losses.v", "if (lose) lost", "if (lose && !overflow) lost"),
  ("overflow_cleared_with_new_loss", "capture_losses.v", "if (lose) overflow", "if (lose && !clear_overflow) overflow"),
  ("stamp_without_top_bit", "capture_queue.v", RECORD, "{gap, 1'b0, stamp[30:0], changed, levels}"),
  ("stamp_a_tick_late", "capture_queue.v", RECORD, "{gap, stamp + 32'd1, changed, levels}"),
  ("changed_and_levels_swapped", "capture_queue.v", RECORD, "{gap, stamp, levels, changed}"),
  ("time_high_not_latched", "capture_queue.v", "answer = now_high", "answer = now[63:32]"),
  ("interrupt_a_record_late", "capture_queue.v", "count >= threshold", "count > threshold"),
  ("pop_without_read", "capture_queue.v", "bus_read && bus_address == ADDRESS_FIFO_LEVELS",
    "bus_address == ADDRESS_FIFO_LEVELS"),
  ("clear_unmarked", "capture_queue.v", "!enabled || clear_fifo || write_input_enable", "!enabled || write_input_enable"),
  ("enabling_unmarked", "capture_queue.v", "!enabled || clear_fifo ||", "clear_fifo ||"),
  ("empty_fifo_shows_old_record", "capture_queue.v", "ADDRESS_FIFO_CHANGED: if (some)", "ADDRESS_FIFO_CHANGED:"),
  ("glitch_counter_wraps", "capture_queue.v", "glitch && !(&glitches)", "glitch"),
  ("registers_swapped", "capture_queue.v", "ADDRESS_LOST = 4'h8", "ADDRESS_LOST = 4'hF"),
)
