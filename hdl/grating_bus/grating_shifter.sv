// A level shifter for a group of lines between connector P2 (TTL, 5 V) and the card's logic (LVTTL, 3.3 V). It works in
// one direction at a time; the direction makes a card host or slave. The device that holds the shifter converts the
// levels: in the source a CPLD with 5 V tolerant pins.
//
//   out 1   from_logic ──► p2
//   out 0   p2 ──► to_logic; the shifter does not drive p2
`timescale 1ns / 1ns

module grating_shifter #(
    parameter WIDTH = 1
) (
    input  logic             out,
    input  logic [WIDTH-1:0] from_logic,
    output logic [WIDTH-1:0] to_logic,
    inout  wire  [WIDTH-1:0] p2
);
    assign p2 = out ? from_logic : {WIDTH{1'bz}};
    assign to_logic = p2;
endmodule
