// A level shifter for a group of lines between connector P2 (TTL, 5 V) and the card's logic (LVTTL, 3.3 V). It works one
// way at a time; its way is what makes a card host or slave. The levels themselves are those of the device that it is
// put into: a CPLD whose pins bear 5 V, in the source.
//
//   out 1   from_logic ──► p2
//   out 0   p2 ──► to_logic, and p2 is left to the others
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
