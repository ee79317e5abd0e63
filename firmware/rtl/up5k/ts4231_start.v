// SPDX-License-Identifier: Apache-2.0
// Starts up TS4231 light receivers, one after the other: gives no light before. A receiver is configured at the end of the
// first light that it sees after power on (a pulse on D), read back, and set to watch; one that answers something else is
// tried again at its next light. The sequence of levels is that of the maker's library (TS4231, waitForLight,
// configDevice, goToWatch), a step every 2 us.
`default_nettype none

module ts4231_start #(
    parameter RECEIVERS = 4,
    parameter STEP_TICKS = 32  // 2 us, and at least the maker's 1 us
) (
    input  wire                 clock,
    input  wire                 reset,
    input  wire [RECEIVERS-1:0] e_levels,  // pins
    input  wire [RECEIVERS-1:0] d_levels,
    output wire [RECEIVERS-1:0] e_driven,
    output wire [RECEIVERS-1:0] d_driven,
    output reg                  e_out,     // of the one that is driven
    output reg                  d_out,
    output reg  [RECEIVERS-1:0] ready      // watches: E low is light
);

  localparam [14:0] CONFIGURATION = 15'h392B;  // the first bit, 0, says that 14 are written

  // Steps, in this order but for the loops WRITE to WRITE_FALL and READ to READ_FALL.
  localparam [5:0] IDLE = 6'd0;
  localparam [5:0] WRITE_BEGIN = 6'd10;
  localparam [5:0] WRITE = 6'd11;
  localparam [5:0] WRITE_FALL = 6'd13;
  localparam [5:0] READ_BEGIN = 6'd24;
  localparam [5:0] READ = 6'd25;
  localparam [5:0] READ_FALL = 6'd26;
  localparam [5:0] COMPARED = 6'd30;
  localparam [5:0] WAKE_BEGIN = 6'd36;
  localparam [5:0] WAKE = 6'd37;  // its analog part, 128 us
  localparam [5:0] END = 6'd38;

  reg [RECEIVERS-1:0] e_sampled, e_settled, d_sampled, d_settled, d_before;
  reg [RECEIVERS-1:0] wanted;   // one whose light ended
  reg [RECEIVERS-1:0] d_stays;  // D was high since `long` was 0: one that is past its first light, and was not configured
  reg [RECEIVERS-1:0] chosen;   // one bit
  reg [5:0] step;
  reg [5:0] left;
  reg [14:0] word;              // the bit at the top is next
  reg equal;                    // what was read back
  reg [$clog2(STEP_TICKS)-1:0] ticks;
  reg [15:0] long;              // steps; 131 ms
  wire steps = ticks == 0;
  wire [14:0] rotated = {word[13:0], word[14]};
  wire chosen_d = |(d_settled & chosen);
  wire watches = |(e_settled & chosen) && !chosen_d;

  always @(posedge clock) begin
    e_sampled <= e_levels;
    e_settled <= e_sampled;
    d_sampled <= d_levels;
    d_settled <= d_sampled;
  end

  always @(posedge clock)
    if (reset) begin
      ticks    <= 0;
      long     <= 16'd0;
      d_before <= {RECEIVERS{1'b0}};
      wanted   <= {RECEIVERS{1'b0}};
      d_stays  <= {RECEIVERS{1'b0}};
      ready    <= {RECEIVERS{1'b0}};
    end else begin
      ticks    <= steps ? STEP_TICKS[$clog2(STEP_TICKS)-1:0] - 1'b1 : ticks - 1'b1;
      d_before <= d_settled;
      if (steps) long <= long + 16'd1;
      if (steps && step == END) begin
        wanted <= wanted & ~chosen;
        if (equal && watches) ready <= ready | chosen;
      end else if (steps && long == 16'd0) begin
        wanted <= (wanted | d_stays) & ~ready;
      end else begin
        wanted <= (wanted | (d_before & ~d_settled)) & ~ready;
      end
      d_stays <= (steps && long == 16'd0) ? {RECEIVERS{1'b1}} : d_stays & d_settled & ~chosen;
    end

  always @(posedge clock)
    if (reset) begin
      step   <= IDLE;
      left   <= 6'd0;
      chosen <= {RECEIVERS{1'b0}};
      word   <= CONFIGURATION;
      equal  <= 1'b0;
    end else if (steps) begin
      step <= step + 6'd1;
      left <= left - 6'd1;
      case (step)
        IDLE: begin
          chosen <= wanted & (~wanted + 1'b1);  // the lowest
          if (wanted == 0) step <= IDLE;
        end
        WRITE_BEGIN: left <= 6'd14;
        WRITE: left <= left;
        WRITE + 6'd1: left <= left;
        WRITE_FALL: begin
          word <= rotated;
          if (left != 6'd0) step <= WRITE;
        end
        READ_BEGIN: begin
          word  <= rotated;
          left  <= 6'd13;
          equal <= 1'b1;
        end
        READ: begin
          word  <= rotated;
          left  <= left;
          equal <= equal && chosen_d == word[14];
        end
        READ_FALL: if (left != 6'd0) step <= READ;
        COMPARED: if (!equal) step <= END;
        WAKE_BEGIN: left <= 6'd63;
        WAKE: if (left != 6'd0) step <= WAKE;
        END: begin
          step   <= IDLE;
          chosen <= {RECEIVERS{1'b0}};
        end
        default: ;
      endcase
    end

  reg e_drives, d_drives;
  assign e_driven = chosen & {RECEIVERS{e_drives}};
  assign d_driven = chosen & {RECEIVERS{d_drives}};
  always @(posedge clock) begin
    {e_drives, e_out, d_drives, d_out} <= 4'b0000;
    case (step)
      6'd1, 6'd3: {e_drives, e_out} <= 2'b10;
      6'd2, 6'd4: {e_drives, e_out} <= 2'b11;
      6'd5, 6'd9, 6'd15, 6'd19, 6'd28: {e_drives, e_out, d_drives, d_out} <= 4'b1110;
      6'd6, 6'd8, 6'd16, 6'd18, 6'd22, 6'd29, 6'd31: {e_drives, e_out, d_drives, d_out} <= 4'b1111;
      6'd10, 6'd14, 6'd20, 6'd27, 6'd33: {e_drives, e_out, d_drives, d_out} <= 4'b1010;
      6'd11, 6'd13: {e_drives, e_out, d_drives, d_out} <= {3'b101, word[14]};
      6'd12: {e_drives, e_out, d_drives, d_out} <= {3'b111, word[14]};
      6'd21, 6'd32: {e_drives, e_out, d_drives, d_out} <= 4'b1011;
      6'd23, 6'd25, 6'd35: {e_drives, e_out} <= 2'b11;
      6'd24, 6'd26, 6'd34: {e_drives, e_out} <= 2'b10;
      default: ;
    endcase
  end

endmodule
`default_nettype wire
