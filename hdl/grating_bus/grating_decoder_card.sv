// A decoder card with its connector: grating_decoder and the pins of the bus on connector P2. The card drives its data
// lines only while READ is low and the address is that of one of its scales.
`timescale 1ns / 1ns

module grating_decoder_card #(
    parameter N = 4  // scales, 1 .. 128
) (
    input  logic         clock,
    input  logic [N-1:0] a,
    input  logic [N-1:0] b,
    input  logic         p2_hold,
    input  logic         p2_read_n,
    input  logic [6:0]   p2_addr,
    inout  wire  [31:0]  p2_data,
    output logic         illegal
);
    logic        data_enable;
    logic [31:0] data, unused;

    grating_decoder #(.N(N)) decoder (.clock(clock), .a(a), .b(b), .hold(p2_hold), .read_n(p2_read_n), .addr(p2_addr),
                                      .data_enable(data_enable), .data(data), .illegal(illegal));
    grating_shifter #(.WIDTH(32)) shifter (.out(data_enable), .from_logic(data), .to_logic(unused), .p2(p2_data));
endmodule
