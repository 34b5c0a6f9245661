// A decoder with N moving scales and the logic of CARDS cards on one bus: HOSTS hosts, each APART clocks later than the
// previous one, and slaves. If drivers differ, the low level wins; lines without a driver have their inactive level.
`timescale 1ns / 1ns

module grating_system #(
    parameter N      = 4,
    parameter CARDS  = 3,
    parameter PERIOD = 20000,
    parameter HOSTS  = 1,
    parameter APART  = 0,
    parameter CHECKS = 0,
    parameter STRIDE = 1,        // word k of a card's list is scale (k STRIDE + SHIFT host) mod N
    parameter SHIFT  = 0
) (
    input  logic                clock,
    input  logic                claim,
    input  logic                give_back,
    input  logic [6:0]          word_asked,
    output logic [CARDS*32-1:0] words_read,
    output logic [CARDS*7-1:0]  addresses_read,
    output logic [CARDS*32-1:0] sequences_read,
    output logic [CARDS*64-1:0] times_read,
    output logic [CARDS*32-1:0] crcs_read,
    output logic [CARDS-1:0]    claimed,
    output logic [CARDS-1:0]    frame_done,
    output logic [CARDS-1:0]    frame_good,
    output logic [CARDS*64-1:0] counters,       // of each card, from bit 0: broken, missed words, alien, line faults
    output logic [CARDS*4-1:0]  states,
    output logic                illegal,
    output logic                clk_conflict,   // the drivers of clk differ
    output logic                conflict        // the drivers of hold, read_n or addr differ
);
    // Returns the list of host number `host`; slaves have that of host 0.
    function automatic [7*128-1:0] list_of(input integer host);
        list_of = 0;
        for (int k = 0; k < N; k = k + 1) list_of[7*k+:7] = 7'((k * STRIDE + SHIFT * host) % N);
    endfunction

    logic [CARDS-1:0] drives, clks, holds, reads_n;
    logic [6:0]       addrs [0:CARDS-1];
    logic [N-1:0]     a, b;
    logic             clk, hold, read_n, data_enable;
    logic [6:0]       addr;
    logic [31:0]      data, decoder_data;

    assign clk = &(clks | ~drives) && |drives;
    assign hold = &(holds | ~drives) && |drives;
    assign read_n = &(reads_n | ~drives);
    always_comb begin
        addr = 7'h7F;
        clk_conflict = |(clks & drives) && |(~clks & drives);
        conflict = (|(holds & drives) && |(~holds & drives)) || (|(reads_n & drives) && |(~reads_n & drives));
        for (int i = 0; i < CARDS; i = i + 1) if (drives[i]) addr = addr & addrs[i];
        for (int i = 0; i < CARDS; i = i + 1) if (drives[i] && addrs[i] != addr) conflict = 1;
    end
    assign data = data_enable ? decoder_data : 32'hFFFFFFFF;

    grating_scales #(.N(N)) scales (.clock(clock), .a(a), .b(b));
    grating_decoder #(.N(N)) decoder (.clock(clock), .a(a), .b(b), .hold(hold), .read_n(read_n), .addr(addr),
                                      .data_enable(data_enable), .data(decoder_data), .illegal(illegal));
    for (genvar i = 0; i < CARDS; i = i + 1) begin : slot
        grating_card #(.N(N), .LISTED(STRIDE != 1 || SHIFT != 0), .LIST(list_of(i < HOSTS ? i : 0)), .HOST(i < HOSTS), .CHECKS(CHECKS),
                       .PERIOD(PERIOD), .OFFSET(i < HOSTS ? i * APART : 0)) card (
            .clock(clock), .bus_clk(clk), .bus_hold(hold), .bus_read_n(read_n), .bus_addr(addr), .bus_data(data), .drives(drives[i]), .clk(clks[i]),
            .hold(holds[i]), .read_n(reads_n[i]), .addr(addrs[i]), .claim(claim), .give_back(give_back),
            .word_asked(word_asked), .word_read(words_read[32*i+:32]), .address_read(addresses_read[7*i+:7]), .sequence_read(sequences_read[32*i+:32]),
            .time_read(times_read[64*i+:64]), .crc_read(crcs_read[32*i+:32]), .claimed(claimed[i]),
            .frame_done(frame_done[i]), .frame_good(frame_good[i]), .broken(counters[64*i+:16]),
            .missed_words(counters[64*i+16+:16]), .alien(counters[64*i+32+:16]), .line_faults(counters[64*i+48+:16]),
            .state(states[4*i+:4]));
    end
endmodule
