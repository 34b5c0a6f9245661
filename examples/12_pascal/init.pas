{ The short example of the unit's description: the card is initialised, and whoever asked hears how it went. }
program Init;

uses
  uFlex2Pos;

var
  MyIOFlexObj: tIOFlexPos;

begin
  MyIOFlexObj.Init($2300); { IOFlex02 base address }
  if MyIOFlexObj.Result <> Flex_Ok then
    Write('Chyba inicializace desky: ', MyIOFlexObj.Result);
  WriteLn('Result ', MyIOFlexObj.Result);
end.
