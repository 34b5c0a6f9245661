{ Every function of the units uIOFlex2 and uFlex2Pos on a virtual card, from an object made by New. Prints what is wrong,
  and at the end how much that was. Compiled in the modes fpc, tp, delphi and objfpc. }
program Functions;

uses
  uIOFlex2, uFlex2Pos;

var
  P: pIOFlexPos;
  Plain: pIOFlex02;
  Image: array[0..99] of Byte;
  Bytes, Time, Before, Pos0, Pos1, Pos2, Pos3: Longint;
  Sts0, Sts1, Sts2, Sts3: tIOFlexSts;
  Wrong: Integer;

procedure Expect(Good: Boolean; const What: string);
begin
  if Good then Exit;
  WriteLn('wrong: ', What);
  Inc(Wrong);
end;

{ A line of axis 0 to 3, by hand, for 2 us. }
procedure Drive(const Line: string; Axis, Level: Integer);
var
  Name: array[0..15] of Char;
  I: Integer;
begin
  Name := 'p1.';
  for I := 1 to Length(Line) do Name[2 + I] := Line[I];
  Name[3 + Length(Line)] := Chr(Ord('0') + Axis);
  Name[4 + Length(Line)] := #0;
  Expect(mr_wire_set(Rack, @Name[0], Level) = 0, Line);
  mr_advance_ns(Rack, 2000);
end;

{ Lines of an encoder, forwards. }
procedure Turn(Axis, Lines: Integer);
var
  I: Integer;
begin
  for I := 1 to Lines do
  begin
    Drive('a', Axis, 1);
    Drive('b', Axis, 1);
    Drive('a', Axis, 0);
    Drive('b', Axis, 0);
  end;
end;

procedure Index(Axis: Integer);
begin
  Drive('z', Axis, 1);
  Drive('z', Axis, 0);
end;

procedure TimeAndPositions;
var
  Axis: Integer;
begin
  for Axis := 0 to 3 do Turn(Axis, Axis + 1);
  Expect((P^.ReadPosition0 = 4) and (P^.ReadPosition1 = 8), 'ReadPosition0, ReadPosition1');
  Expect((P^.ReadPosition2 = 12) and (P^.ReadPosition3 = 16), 'ReadPosition2, ReadPosition3');
  Before := P^.ReadTime;
  mr_advance_ns(Rack, 1200000);
  Time := P^.ReadTime;
  Expect((Time >= Before + 1000) and (Time < Before + 1010), 'ReadTime: ticks of 1.2 us');
  Expect(P^.ReadTimeClr >= Time, 'ReadTimeClr gives the time');
  Expect(P^.ReadTime < 10, 'and clears it');
  P^.ReadTimeClrPosition(Time, Pos0, Pos1, Pos2, Pos3);
  Expect((Time < 20) and (Pos0 = 4) and (Pos1 = 8) and (Pos2 = 12) and (Pos3 = 16), 'ReadTimeClrPosition');
end;

procedure InputsAndOutputs;
var
  Level: Double;
begin
  Drive('b', 0, 1);
  Drive('z', 1, 1);
  Drive('a', 2, 1);
  Drive('cal', 3, 1);
  Expect((P^.ReadInL = $42) and (P^.ReadInH = $81), 'ReadInL, ReadInH');
  Drive('b', 0, 0);
  Drive('z', 1, 0);
  Drive('a', 2, 0);
  Drive('cal', 3, 0);
  P^.WriteOutL($80);
  P^.WriteOutH($01);
  Level := 0;
  Expect((mr_wire_get(Rack, 'p1.out7', Level) = 0) and (Level = 1), 'WriteOutL');
  Expect((mr_wire_get(Rack, 'p1.out8', Level) = 0) and (Level = 1), 'WriteOutH');
end;

procedure Calibration;
begin
  P^.WriteCmd(cNop, cRes, cResNm, cResNmSig);
  P^.ReadSts(Sts0, Sts1, Sts2, Sts3);
  Expect((Sts0 = sCal) and (Sts1 = sCal) and (Sts2 = sNotCal) and (Sts3 = sNotCal), 'WriteCmd, ReadSts');
  Drive('cal', 3, 1);
  P^.WriteCmdAxis(0, cResNm);
  Index(3);
  P^.ReadSts(Sts0, Sts1, Sts2, Sts3);
  Expect((Sts0 = sNotCal) and (Sts2 = sNotCal) and (Sts3 = sCal), 'WriteCmdAxis disturbs no other axis');
  Expect((P^.ReadPosition1 = 0) and (P^.ReadPosition3 = 0) and (P^.ReadPosition0 = 4), 'the zeros');
  Drive('cal', 3, 0);
end;

procedure Images;
begin
  Expect((GetFlexBinAddr = nil) and (GetFlexBinSize = 0), 'no image of one''s own at first');
  Bytes := MakeFlexBin('position', $25, [1, 0, 0, 0], @Image, SizeOf(Image));
  Expect(Bytes > 0, 'MakeFlexBin');
  SetFlexBin(@Image, Bytes);
  Expect((GetFlexBinAddr = @Image) and (GetFlexBinSize = Bytes), 'SetFlexBin');
  P^.Init($2300);
  Expect(P^.Result = Flex_Ok, P^.Why);
  mr_advance_ns(Rack, 2000);
  Turn(0, 1);
  Expect(P^.ReadPosition0 = -4, 'axis 0 counts as the image says');
  Image[Bytes div 2] := Image[Bytes div 2] xor $55;
  P^.Configure(@Image, Bytes);
  Expect(P^.Result = Flex_ErrCfg, 'a damaged image');
  P^.Configure(@Image, 0);
  Expect(P^.Result = Flex_ErrCfg, 'an empty image');
  SetFlexBin(@Image, MakeFlexBin('stepper', $25, [0, 0, 0, 0], @Image, SizeOf(Image)));
  P^.Init($2300);
  Expect((P^.Result = Flex_ErrProject) and (P^.Why <> ''), 'another project');
  P^.Configure(nil, 0);
  Expect((P^.Result = Flex_Ok) and (P^.Why = ''), P^.Why);
  Expect(MakeFlexBin('position', $25, [0, 0, 0, 0], @Image, 5) = 0, 'no room for an image');
end;

begin
  Wrong := 0;
  New(Plain, Init($2300));
  Expect((Plain^.Result = Flex_ErrDevice) and (Plain^.GetIdent = 0), 'the ancestor configures nothing by itself');
  Plain^.Configure(nil, 0);
  Expect((Plain^.Result = Flex_Ok) and (Plain^.GetIdent = $25), Plain^.Why);
  Dispose(Plain, Done);
  New(P, Init($2400));
  Expect((P^.Result = Flex_ErrDevice) and (P^.Why <> ''), 'a wrong base address');
  Dispose(P, Done);
  New(P, Init($2300));
  Expect(P^.Result = Flex_Ok, P^.Why);
  Expect((cVerNo = $0251) and (cVer = '02.51, 07.08.2003'), 'the unit''s version');
  Expect((Ord(cNop) = 0) and (Ord(cResNmSig) = 3) and (Ord(sNotCal) = 0) and (Ord(sCal) = 1), 'orders');
  mr_advance_ns(Rack, 2000);
  TimeAndPositions;
  InputsAndOutputs;
  Calibration;
  Images;
  Dispose(P, Done);
  WriteLn(Wrong, ' wrong');
  if Wrong > 0 then Halt(1);
end.
