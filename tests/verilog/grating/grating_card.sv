// One motion card's bus logic: the sequence S0 .. S12 as host or slave, two buffers, CRC-32. All times are in clocks of 100 MHz.
//
//   phase 0         S1
//   own clk __/~~~~~~~~~~~~~     a clock after clk rose host and slaves enter S1 together
//   hold    ________/~~~~~~~
//
// After RULES.md of the card in motionrack/cards/grating_bus, without its checks: every frame is published.
`timescale 1ns / 1ns

module grating_card #(
    parameter N      = 4,        // scales of a frame
    parameter FIRST  = 0,        // address of the first one, without a list
    parameter LISTED = 0,        // whether LIST is the list of addresses
    parameter [7*128-1:0] LIST = 0,  // 7 bits a word, word 0 the lowest
    parameter HOST   = 0,
    parameter PERIOD = 20000,
    parameter OFFSET = 0,        // how much later a host's periods begin, at most half a period
    parameter T1     = 2,
    parameter T2     = 3,
    parameter T3     = 3,
    parameter TICKS  = 100       // of 0.1 ns in a clock, for the time stamp
) (
    input  logic        clock,
    // The bus.
    input  logic        bus_clk,
    input  logic        bus_read_n,
    input  logic [6:0]  bus_addr,
    input  logic [31:0] bus_data,
    output logic        drives,  // both shifters' direction
    output logic        clk,
    output logic        hold,
    output logic        read_n,
    output logic [6:0]  addr,
    // The processor.
    input  logic        claim,
    input  logic        give_back,
    input  logic [6:0]  word_asked,
    output logic [31:0] word_read,
    output logic [6:0]  address_read,  // of the scale of that word
    output logic [31:0] sequence_read,
    output logic [63:0] time_read,
    output logic [31:0] crc_read,
    output logic        claimed,
    output logic        frame_done,
    output logic [3:0]  state
);
    // A byte of zlib's CRC-32, the low bit first.
    function automatic [31:0] crc_byte(input [31:0] crc, input [7:0] value);
        logic [31:0] c;
        c = crc ^ {24'b0, value};
        for (int i = 0; i < 8; i = i + 1) c = (c >> 1) ^ (c[0] ? 32'hEDB88320 : 32'h0);
        return c;
    endfunction
    function automatic [31:0] crc_half(input [31:0] crc, input [15:0] value);
        return crc_byte(crc_byte(crc, value[7:0]), value[15:8]);
    endfunction
    function automatic [31:0] crc_word(input [31:0] crc, input [31:0] value);
        return crc_half(crc_half(crc, value[15:0]), value[31:16]);
    endfunction

    // ---- the host's clock, edges of the bus' one ------------------------------------------------------------------------------
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

    // ---- the sequence -----------------------------------------------------------------------------------------------------------
    logic [7:0] wait_clocks = 0, word = 0;
    logic       last;            // clock of the state
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
    wire asks = enters && (next == 4'd2 || next == 4'd8);
    wire samples = enters && (next == 4'd3 || next == 4'd9);

    // ---- what the host drives -----------------------------------------------------------------------------------------------------
    assign drives = HOST != 0;
    assign clk = own_clk;
    // The address comes only if READ is seen low, in the clock in which it was pulled low; else it stays as it was.
    //   read_n ~~~~\________________/~~~~
    //   looks  ____/~~\__________________
    //   addr   7F  X first
    logic [6:0] given = 7'h7F;
    logic       looks = 0;
    wire  [6:0] wanted = LISTED != 0 ? LIST[7*word[6:0]+:7] : FIRST + word[6:0];

    initial begin
        hold = 0;
        read_n = 1;
    end
    assign addr = looks && !bus_read_n ? wanted : given;
    always_ff @(posedge clock)
        if (HOST != 0) begin
            looks <= asks;
            given <= enters && next == 4'd0 ? 7'h7F : addr;
            if (enters && next == 4'd1) hold <= 1;
            if (enters && next == 4'd0) hold <= 0;
            if (asks) read_n <= 0;
            if (enters && (next == 4'd4 || next == 4'd10)) read_n <= 1;
        end

    // ---- the frame: two buffers, the processor's and the logic's -------------------------------------------------------------------
    logic [38:0] memory [0:255];  // of each word the address and the count
    logic [31:0] sequence_of [0:1];
    logic [63:0] time_of [0:1];
    logic [31:0] crc_of [0:1];
    logic [31:0] crc = 0, sequence_number = 0;
    logic [38:0] caught = 0;
    logic [2:0]  header = 0;     // part of the header that goes into the CRC next; 4: none
    logic        filling = 0, published = 0, any = 0, owned = 0, caught_new = 0, started = 0;
    integer      i;

    initial begin
        claimed = 0;
        for (i = 0; i < 256; i = i + 1) memory[i] = 0;
        for (i = 0; i < 2; i = i + 1) begin
            sequence_of[i] = 0;
            time_of[i] = 0;
            crc_of[i] = 0;
        end
    end
    // Which buffer the logic fills from now on, as on entering S1.
    wire free = claimed ? !owned : any && !published;

    always_ff @(posedge clock) begin
        caught_new <= samples;
        if (edge_of_clk) begin
            if (started) sequence_number <= sequence_number + 32'd1;
            started <= 1;
        end
        if (enters && next == 4'd1) begin
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

        // The word is caught with the strobe and written a clock later.
        if (samples) caught <= bus_read_n ? memory[{filling, word[6:0]}] : {bus_addr, bus_data};
        if (caught_new) begin
            memory[{filling, word[6:0]}] <= caught;
            word <= word + 8'd1;
        end
        if (enters && next == 4'd12) begin
            crc_of[filling] <= ~crc;
            published <= filling;
            any <= 1;
        end
        if (claim && any && !(state != 4'd0 && state != 4'd12 && filling == published)) begin
            claimed <= 1;
            owned <= published;
        end
        if (give_back) claimed <= 0;
    end
    assign frame_done = state == 4'd12;
    assign {address_read, word_read} = memory[{owned, word_asked}];
    assign sequence_read = sequence_of[owned];
    assign time_read = time_of[owned];
    assign crc_read = crc_of[owned];
endmodule
