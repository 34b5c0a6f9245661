// As grating_system, but with whole cards, their shifters and the pins of connector P2, in a crate. Resistors of the
// backplane pull the lines to their inactive levels. Drivers that differ make a line unknown, so a bus needs one host.
`timescale 1ns / 1ns

module grating_slots #(
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
    output logic                clk_conflict,   // the drivers of clk differ, or a shifter has the wrong direction
    output logic                conflict        // the drivers of hold, read_n, addr or data differ
);
    // Returns the list of host number `host`; slaves have that of host 0.
    function automatic [7*128-1:0] list_of(input integer host);
        list_of = 0;
        for (int k = 0; k < N; k = k + 1) list_of[7*k+:7] = 7'((k * STRIDE + SHIFT * host) % N);
    endfunction

    tri0         p2_clk, p2_hold;
    tri1         p2_read_n;
    tri1  [6:0]  p2_addr;
    tri1  [31:0] p2_data;
    logic [N-1:0]     a, b;
    logic [CARDS-1:0] wrong_direction;

    assign clk_conflict = p2_clk === 1'bx || wrong_direction != 0;
    assign conflict = p2_hold === 1'bx || p2_read_n === 1'bx || ^p2_addr === 1'bx || ^p2_data === 1'bx;

    grating_scales #(.N(N)) scales (.clock(clock), .a(a), .b(b));
    grating_decoder_card #(.N(N)) decoder (.clock(clock), .a(a), .b(b), .p2_hold(p2_hold), .p2_read_n(p2_read_n),
                                           .p2_addr(p2_addr), .p2_data(p2_data), .illegal(illegal));
    for (genvar i = 0; i < CARDS; i = i + 1) begin : slot
        grating_motion_card #(.N(N), .LISTED(STRIDE != 1 || SHIFT != 0), .LIST(list_of(i < HOSTS ? i : 0)),
                              .HOST(i < HOSTS), .CHECKS(CHECKS), .PERIOD(PERIOD),
                              .OFFSET(i < HOSTS ? i * APART : 0)) card (
            .clock(clock), .p2_clk(p2_clk), .p2_hold(p2_hold), .p2_read_n(p2_read_n), .p2_addr(p2_addr),
            .p2_data(p2_data), .claim(claim), .give_back(give_back), .word_asked(word_asked),
            .word_read(words_read[32*i+:32]), .address_read(addresses_read[7*i+:7]),
            .sequence_read(sequences_read[32*i+:32]), .time_read(times_read[64*i+:64]),
            .crc_read(crcs_read[32*i+:32]), .claimed(claimed[i]), .frame_done(frame_done[i]),
            .frame_good(frame_good[i]), .broken(counters[64*i+:16]), .missed_words(counters[64*i+16+:16]),
            .alien(counters[64*i+32+:16]), .line_faults(counters[64*i+48+:16]), .state(states[4*i+:4]),
            .wrong_direction(wrong_direction[i]));
    end
endmodule
