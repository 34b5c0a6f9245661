{ Four axes, calibrated in the four ways; the encoders are turned by hand. }
program Calibrate;

uses
  uIOFlex2, uFlex2Pos;

var
  Flex: tIOFlexPos;
  Time, Pos0, Pos1, Pos2, Pos3: Longint;
  Sts0, Sts1, Sts2, Sts3: tIOFlexSts;

procedure SetWire(const Wire: AnsiString; Level: Double);
begin
  if mr_wire_set(Rack, PAnsiChar(Wire), Level) <> 0 then WriteLn(mr_last_error);
  mr_advance_ns(Rack, 2000);
end;

procedure Turn(Lines: Integer);
var
  Line, Axis: Integer;
  Number: AnsiString;
begin
  for Line := 1 to Lines do
    for Axis := 0 to 3 do
    begin
      Str(Axis, Number);
      SetWire('p1.a' + Number, 1);
      SetWire('p1.b' + Number, 1);
      SetWire('p1.a' + Number, 0);
      SetWire('p1.b' + Number, 0);
    end;
end;

procedure Index;
var
  Axis: Integer;
  Number: AnsiString;
begin
  for Axis := 0 to 3 do
  begin
    Str(Axis, Number);
    SetWire('p1.z' + Number, 1);
    SetWire('p1.z' + Number, 0);
  end;
end;

procedure Tell(const What: AnsiString);
begin
  Flex.ReadTimeClrPosition(Time, Pos0, Pos1, Pos2, Pos3);
  Flex.ReadSts(Sts0, Sts1, Sts2, Sts3);
  WriteLn(What:36, Pos0:7, Pos1:7, Pos2:7, Pos3:7, '   ', Sts0, ' ', Sts1, ' ', Sts2, ' ', Sts3);
end;

begin
  Flex.Init($2300);
  if Flex.Result <> Flex_Ok then
  begin
    WriteLn(Flex.Why);
    Halt(1);
  end;
  WriteLn('project version ', Flex.GetIdent, ', unit ', cVer);
  Turn(25);
  Tell('25 lines');
  Flex.WriteCmd(cNop, cRes, cResNm, cResNmSig);
  Tell('commands');
  Turn(5);
  Index;
  Tell('5 lines on, index');
  SetWire('p1.cal3', 1);
  Turn(5);
  Index;
  Tell('Cal4, 5 lines on, index');
  Flex.Done;
end.
