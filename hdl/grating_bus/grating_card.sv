// The logic of one motion card on a grating bus: the sequence S0 .. S12 as host or slave, its checks and counters, and
// two frame buffers with their CRC-32. It has one clock, and all times are in periods of it; at 100 MHz the defaults
// of T1 to T3 are those of the source.
//
//   edge of clk   one clock after clk has risen at the card, the card enters S1: host and slaves together
//   own clk       __/~~~~~~~~~~~~~
//   hold          ________/~~~~~~~
//
// The rules are those of motionrack/cards/grating_bus/RULES.md. The mark of stale data and the counters of lost and
// missed edges are not implemented.
`timescale 1ns / 1ns

module grating_card #(
    parameter N      = 4,            // scales (words) of a frame, 1 .. 128
    parameter FIRST  = 0,            // address of word 0 if LISTED is 0; the others follow
    parameter LISTED = 0,            // 1: LIST has the addresses of the words
    parameter [7*128-1:0] LIST = 0,  // 7 bits per word, word 0 in the lowest bits
    parameter HOST   = 0,            // 1: host, drives clock and addresses; 0: slave, only listens
    parameter CHECKS = 1,            // 1: counts frames with wrong lines and does not publish them
    parameter PERIOD = 20000,        // clocks from one frame to the next
    parameter OFFSET = 0,            // clocks by which a host's periods begin later, at most PERIOD / 2
    parameter T1     = 2,            // clocks, 1 .. 255, in which the decoder latches
    parameter T2     = 3,            // clocks, 1 .. 255, from the address to stable data
    parameter T3     = 3,            // clocks, 1 .. 255, after the sample of the data
    parameter TICKS  = 100           // period of the clock in units of 0.1 ns, for the time stamp
) (
    input  logic        clock,
    // Bus lines from the shifters (inputs) and to them (outputs).
    input  logic        bus_clk,
    input  logic        bus_hold,
    input  logic        bus_read_n,
    input  logic [6:0]  bus_addr,
    input  logic [31:0] bus_data,
    output logic        drives,        // direction of both shifters: 1 outwards (host)
    output logic        clk,
    output logic        hold,
    output logic        read_n,
    output logic [6:0]  addr,
    // Processor side. word_read and address_read are valid one clock after word_asked.
    input  logic        claim,
    input  logic        give_back,
    input  logic [6:0]  word_asked,
    output logic [31:0] word_read,
    output logic [6:0]  address_read,  // address of the scale of that word
    output logic [31:0] sequence_read,
    output logic [63:0] time_read,
    output logic [31:0] crc_read,
    output logic        claimed,
    output logic        frame_done,    // S12: the sequence has ended
    output logic        frame_good,    // the sequence has ended and the frame was published
    output logic [15:0] broken,        // frames that were not published; this and the next counters saturate at FFFFh
    output logic [15:0] missed_words,  // words sampled while READ was high
    output logic [15:0] alien,         // words with an address other than that of the card's list, or twice in a frame
    output logic [15:0] line_faults,   // words at which clk, hold or READ had a wrong level
    output logic [3:0]  state
);
    // Returns zlib's CRC-32 after one more byte, low bit first.
    function automatic [31:0] crc_byte(input [31:0] crc, input [7:0] value);
        logic [31:0] c;
        integer bits;
        c = crc ^ {24'b0, value};
        for (bits = 0; bits < 8; bits = bits + 1) c = (c >> 1) ^ (c[0] ? 32'hEDB88320 : 32'h0);
        crc_byte = c;
    endfunction
    function automatic [31:0] crc_half(input [31:0] crc, input [15:0] value);
        crc_half = crc_byte(crc_byte(crc, value[7:0]), value[15:8]);
    endfunction
    function automatic [31:0] crc_word(input [31:0] crc, input [31:0] value);
        crc_word = crc_half(crc_half(crc, value[15:0]), value[31:16]);
    endfunction
    function automatic [15:0] one_more(input [15:0] counter);
        one_more = counter == 16'hFFFF ? counter : counter + 16'd1;
    endfunction

    // ---- the host's clock, and the edges of the bus' clock
    logic [31:0] phase = OFFSET == 0 ? 0 : PERIOD - OFFSET;
    logic        own_clk = 0, clk_before = 0;
    logic [63:0] now = 0;
    wire         clk_heard = HOST != 0 ? own_clk : bus_clk;
    wire         edge_of_clk = clk_heard && !clk_before;

    always_ff @(posedge clock) begin
        now <= now + TICKS;
        clk_before <= clk_heard;
        if (HOST != 0) begin
            phase <= phase == PERIOD - 1 ? 32'd0 : phase + 32'd1;
            own_clk <= phase < PERIOD / 2;
        end
    end

    // ---- the sequence
    logic [7:0] wait_clocks = 0, word = 0;
    logic       last;  // last clock of the state
    logic [3:0] next;

    initial state = 0;
    always_comb begin
        last = wait_clocks == 0;
        case (state)
            4'd0: next = edge_of_clk ? 4'd1 : 4'd0;
            4'd5: next = {24'b0, word} == N ? 4'd11 : 4'd6;
            4'd10: next = 4'd5;
            4'd12: next = 4'd0;
            default: next = last ? state + 4'd1 : state;
        endcase
    end

    always_ff @(posedge clock) begin
        state <= next;
        if (next != state)
            case (next)
                4'd1, 4'd7: wait_clocks <= T1 - 1;
                4'd2, 4'd8: wait_clocks <= T2 - 1;
                4'd3, 4'd9: wait_clocks <= T3 - 1;
                default: wait_clocks <= 0;
            endcase
        else if (!last)
            wait_clocks <= wait_clocks - 8'd1;
    end
    wire enters = next != state;
    wire begins = enters && next == 4'd1;
    wire asks = enters && (next == 4'd2 || next == 4'd8);
    wire samples = enters && (next == 4'd3 || next == 4'd9);
    wire ends_read = enters && (next == 4'd4 || next == 4'd10);
    wire decides = enters && next == 4'd5;
    wire completes = enters && next == 4'd12;

    // ---- the host's outputs. In the first clock in which it drives READ low, the host drives the next address if it
    // sees READ low on the bus; otherwise the address stays unchanged.
    //   read_n ~~~~\________________/~~~~
    //   looks  ____/~~\__________________
    //   addr   7F  X first
    logic [6:0] given = 7'h7F;
    logic       looks = 0;
    wire  [6:0] wanted = LISTED != 0 ? LIST[7*word[6:0]+:7] : FIRST + word[6:0];

    assign drives = HOST != 0;
    assign clk = own_clk;
    assign addr = looks && !bus_read_n ? wanted : given;
    initial begin
        hold = 0;
        read_n = 1;
    end
    always_ff @(posedge clock)
        if (HOST != 0) begin
            looks <= asks;
            given <= enters && next == 4'd0 ? 7'h7F : addr;
            if (begins) hold <= 1;
            if (enters && next == 4'd0) hold <= 0;
            if (asks) read_n <= 0;
            if (ends_read) read_n <= 1;
        end

    // ---- checks: at each sample, and one clock after the end of READ
    logic [127:0] taken = 0;  // addresses that the frame already has
    logic         frame_bad = 0, word_bad = 0;
    wire          clock_wrong = HOST != 0 && bus_clk != own_clk;
    wire          address_wrong = HOST != 0 ? bus_addr != wanted : taken[bus_addr];
    wire          line_wrong = clock_wrong || (samples ? !bus_hold : !bus_read_n);
    wire          is_missed = samples && bus_read_n;
    wire          is_alien = samples && !bus_read_n && address_wrong;
    wire          is_other = samples && !bus_read_n && !address_wrong && bus_addr != wanted;
    wire          is_line = line_wrong && ((samples && !bus_read_n && !address_wrong) || decides);

    initial begin
        broken = 0;
        missed_words = 0;
        alien = 0;
        line_faults = 0;
    end
    always_ff @(posedge clock)
        if (CHECKS != 0) begin
            if (is_missed) missed_words <= one_more(missed_words);
            if (is_alien || is_other) alien <= one_more(alien);
            if (is_line && !(decides && word_bad)) line_faults <= one_more(line_faults);
            if (samples) word_bad <= is_missed || is_alien || is_line;
            if (begins) begin
                frame_bad <= 0;
                taken <= 0;
            end else if (is_missed || is_alien || is_line)
                frame_bad <= 1;
            if (samples && !bus_read_n && HOST == 0) taken[bus_addr] <= 1;
            if (completes && frame_bad) broken <= one_more(broken);
        end

    // ---- the frame: one buffer belongs to the processor, the other to the logic
    logic [38:0] memory [0:255];  // address and count of each word, two buffers
    logic [38:0] caught = 0, kept = 0, shown = 0;
    logic [31:0] sequence_of [0:1];
    logic [63:0] time_of [0:1];
    logic [31:0] crc_of [0:1];
    logic [31:0] crc = 0, sequence_number = 0;
    logic [2:0]  header = 0;      // part of the header that the CRC takes next; 4: none
    logic        filling = 0, published = 0, any = 0, owned = 0, caught_new = 0, started = 0;
    integer      i;

    initial begin
        claimed = 0;
        frame_good = 0;
        for (i = 0; i < 256; i = i + 1) memory[i] = 0;
        for (i = 0; i < 2; i = i + 1) begin
            sequence_of[i] = 0;
            time_of[i] = 0;
            crc_of[i] = 0;
        end
    end
    // The buffer that the logic fills from its entry into S1 on.
    wire free = claimed ? !owned : any && !published;

    // The logic latches a word at the sample and stores it one clock later. If READ is high, the old word stays.
    always_ff @(posedge clock) begin
        caught_new <= samples;
        kept <= memory[{filling, word[6:0]}];
        shown <= memory[{owned, word_asked}];
        if (samples) caught <= bus_read_n ? kept : {bus_addr, bus_data};
        if (caught_new) memory[{filling, word[6:0]}] <= caught;
    end

    always_ff @(posedge clock) begin
        if (edge_of_clk) begin
            if (started) sequence_number <= sequence_number + 32'd1;
            started <= 1;
        end
        if (begins) begin
            filling <= free;
            time_of[free] <= now + TICKS;
            crc <= 32'hFFFFFFFF;
            header <= 0;
            word <= 0;
        end else if (header < 4 && state != 4'd0) begin
            header <= header + 3'd1;
            if (header == 0) begin
                sequence_of[filling] <= sequence_number;
                crc <= crc_word(crc, sequence_number);
            end
            if (header == 1) crc <= crc_word(crc, time_of[filling][31:0]);
            if (header == 2) crc <= crc_word(crc, time_of[filling][63:32]);
            if (header == 3) crc <= crc_half(crc, N);
        end else if (caught_new)
            crc <= crc_word(crc_byte(crc, {1'b0, caught[38:32]}), caught[31:0]);
        if (caught_new) word <= word + 8'd1;

        frame_good <= completes && !frame_bad;
        if (completes && !frame_bad) begin
            crc_of[filling] <= ~crc;
            published <= filling;
            any <= 1;
        end
        // If a bad frame has overwritten the frame published last, the older claimed frame is the published one again.
        if (completes && frame_bad && claimed && filling == published) published <= owned;
        if (claim && any && !(state != 4'd0 && state != 4'd12 && filling == published)) begin
            claimed <= 1;
            owned <= published;
        end
        if (give_back) claimed <= 0;
    end
    assign frame_done = state == 4'd12;
    assign {address_read, word_read} = shown;
    assign sequence_read = sequence_of[owned];
    assign time_read = time_of[owned];
    assign crc_read = crc_of[owned];
endmodule
