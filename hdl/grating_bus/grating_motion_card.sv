// A motion card with its connector: the logic, its two shifters, and the pins of the bus on connector P2.
//
//   p2_clk p2_hold p2_read_n ◄──[ clock shifter ]──►┐
//   p2_addr                  ◄─[ address shifter ]─►│ grating_card ──► processor
//   p2_data                  ───────────────────────┘
//
// CLOCK_OUT and ADDRESS_OUT are the directions of the shifters: 1 (outwards) on a host, 0 (inwards) on a slave;
// wrong_direction is 1 if they differ from that. The table of pins is in motionrack/cards/grating_bus/README.md.
`timescale 1ns / 1ns

module grating_motion_card #(
    parameter N           = 4,
    parameter FIRST       = 0,
    parameter LISTED      = 0,
    parameter [7*128-1:0] LIST = 0,
    parameter HOST        = 0,
    parameter CLOCK_OUT   = HOST,
    parameter ADDRESS_OUT = HOST,
    parameter CHECKS      = 1,
    parameter PERIOD      = 20000,
    parameter OFFSET      = 0,
    parameter T1          = 2,
    parameter T2          = 3,
    parameter T3          = 3,
    parameter TICKS       = 100
) (
    input  logic        clock,
    // Connector P2.
    inout  wire         p2_clk,
    inout  wire         p2_hold,
    inout  wire         p2_read_n,
    inout  wire  [6:0]  p2_addr,
    input  logic [31:0] p2_data,
    // Processor side, as in grating_card.
    input  logic        claim,
    input  logic        give_back,
    input  logic [6:0]  word_asked,
    output logic [31:0] word_read,
    output logic [6:0]  address_read,
    output logic [31:0] sequence_read,
    output logic [63:0] time_read,
    output logic [31:0] crc_read,
    output logic        claimed,
    output logic        frame_done,
    output logic        frame_good,
    output logic [15:0] broken,
    output logic [15:0] missed_words,
    output logic [15:0] alien,
    output logic [15:0] line_faults,
    output logic [3:0]  state,
    output logic        wrong_direction
);
    logic       bus_clk, bus_hold, bus_read_n, clk, hold, read_n, drives;
    logic [6:0] bus_addr, addr;

    assign wrong_direction = (CLOCK_OUT != 0) != (HOST != 0) || (ADDRESS_OUT != 0) != (HOST != 0);

    // A slave's logic leaves the pins of its shifters open, so a shifter set outwards drives the inactive levels.
    grating_shifter #(.WIDTH(3)) clock_shifter (
        .out(CLOCK_OUT != 0), .from_logic(drives ? {clk, hold, read_n} : 3'b001),
        .to_logic({bus_clk, bus_hold, bus_read_n}), .p2({p2_clk, p2_hold, p2_read_n}));
    grating_shifter #(.WIDTH(7)) address_shifter (
        .out(ADDRESS_OUT != 0), .from_logic(drives ? addr : 7'h7F), .to_logic(bus_addr), .p2(p2_addr));

    grating_card #(.N(N), .FIRST(FIRST), .LISTED(LISTED), .LIST(LIST), .HOST(HOST), .CHECKS(CHECKS), .PERIOD(PERIOD),
                   .OFFSET(OFFSET), .T1(T1), .T2(T2), .T3(T3), .TICKS(TICKS)) logic_of_card (
        .clock(clock), .bus_clk(bus_clk), .bus_hold(bus_hold), .bus_read_n(bus_read_n), .bus_addr(bus_addr),
        .bus_data(p2_data), .drives(drives), .clk(clk), .hold(hold), .read_n(read_n), .addr(addr), .claim(claim),
        .give_back(give_back), .word_asked(word_asked), .word_read(word_read), .address_read(address_read),
        .sequence_read(sequence_read), .time_read(time_read), .crc_read(crc_read), .claimed(claimed),
        .frame_done(frame_done), .frame_good(frame_good), .broken(broken), .missed_words(missed_words), .alien(alien),
        .line_faults(line_faults), .state(state));
endmodule
