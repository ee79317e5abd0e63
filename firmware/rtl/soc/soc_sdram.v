// SPDX-License-Identifier: Apache-2.0
// Controller of an SDRAM of 16 bits with 13 row and 9 column addresses and four banks, of which 8 MiB are used, at 50 MHz: reads a line of 16
// bytes, the word asked for first; writes bytes of a word. Every access opens a row and closes it (auto precharge).
//
// step counts down from the tick in which the row opens; all times in ticks of 20 ns, for parts of the slowest grade (-75):
//   tRCD 1, tRP 1, tRC 4, tRFC 4 are kept by the steps; refresh once in 7.8 us. CAS latency 2; a word that is on the pins is in
//   `half` in the tick after.
`default_nettype none

module soc_sdram (
    input  wire        clock,
    input  wire        reset,
    // Requests, held until `taken`; address, data and bytes of a write until `written`.
    input  wire        read_line,
    input  wire        write_word,
    input  wire [22:2] address,
    input  wire [31:0] write_data,
    input  wire [ 3:0] write_bytes,
    output wire        taken,
    output wire        written,
    output wire        reading,       // a line; its half words are those of the ticks with half_valid
    output wire        accessing,     // an access is on its way, not a refresh
    output reg  [ 3:0] step,          // 12 to 1, of a refresh too; 0: idle
    output reg  [22:2] line,          // of the access that was taken
    output wire        half_valid,
    output wire [ 3:1] half_number,   // in the line
    output reg  [15:0] half,
    // Pins. Chip select is low and clock enable high for good; the SDRAM's clock is 3 ns ahead of this one.
    output reg         ras_n,
    output reg         cas_n,
    output reg         we_n,
    output reg  [ 1:0] bank,
    output reg  [12:0] row_column,
    output reg  [ 1:0] mask,
    output reg         drive,
    output reg  [15:0] data_out,
    input  wire [15:0] data_in
);

  localparam [8:0] REFRESH_TICKS = 9'd389;  // and one more: 8,192 refreshes in 64 ms
  localparam [2:0] NOTHING = 3'b111, OPEN = 3'b011, READ = 3'b101, WRITE = 3'b100, CLOSE_ALL = 3'b010, REFRESH = 3'b001, SET_MODE = 3'b000;
  localparam [12:0] MODE = 13'b000_1_00_010_0_011;  // single writes, CAS latency 2, bursts of 8 in sequence

  // After reset: 32 intervals of refresh without a command (250 us), all banks closed, 14 refreshes, the mode.
  reg [8:0] interval;
  reg [5:0] start;
  reg due;
  wire interval_ends = interval == 9'd0;
  wire started = start[5] && start[4];
  wire start_now = interval_ends && start[5] && !start[4];
  wire start_closes = start[3:0] == 4'd0;
  wire start_sets_mode = start[3:0] == 4'd15;

  reg writing, refreshing;
  wire idle = started && step == 4'd0;
  wire refresh_now = idle && due;
  assign taken = idle && !due && (read_line || write_word);
  assign accessing = step != 4'd0 && !refreshing;
  assign reading = accessing && !writing;
  assign written = writing && step == 4'd11;
  assign half_valid = reading && step <= 4'd8;
  assign half_number = {line[3:2], 1'b0} - step[2:0];  // 0 at step 8: the first word's lower half

  always @(posedge clock)
    if (reset) begin
      interval   <= REFRESH_TICKS;
      start      <= 6'd0;
      due        <= 1'b0;
      step       <= 4'd0;
      writing    <= 1'b0;
      refreshing <= 1'b0;
    end else begin
      interval <= interval_ends ? REFRESH_TICKS : interval - 9'd1;
      if (interval_ends && !started) start <= start + 6'd1;
      due <= started && (interval_ends || (due && !refresh_now));
      if (taken || refresh_now || start_now) begin
        step       <= taken ? 4'd12 : 4'd4;
        writing    <= taken && write_word;
        refreshing <= !taken;
      end else if (step != 4'd0) step <= step - 4'd1;
    end

  always @(posedge clock) if (taken) line <= address;

  // Commands. A10 closes the row after the access, or all banks.
  wire column_now = accessing && (step == 4'd12 || written);
  reg [2:0] command;
  always @* begin
    command = NOTHING;
    if (start_now) command = start_closes ? CLOSE_ALL : start_sets_mode ? SET_MODE : REFRESH;
    if (refresh_now) command = REFRESH;
    if (taken) command = OPEN;
    if (column_now) command = writing ? WRITE : READ;
  end
  wire second_half = written;
  always @(posedge clock) begin
    if (reset) {ras_n, cas_n, we_n} <= NOTHING;
    else {ras_n, cas_n, we_n} <= command;
    bank       <= taken ? address[11:10] : started ? line[11:10] : 2'd0;
    row_column <= taken ? {2'd0, address[22:12]} :
                  started ? {2'd0, !writing || second_half, 1'b0, line[9:2], second_half} :
                  start_sets_mode ? MODE : 13'h0400;
    mask       <= !writing ? 2'd0 : second_half ? ~write_bytes[3:2] : ~write_bytes[1:0];
    data_out   <= second_half ? write_data[31:16] : write_data[15:0];
    drive      <= !reset && column_now && writing;
    half       <= data_in;
  end

endmodule
`default_nettype wire
