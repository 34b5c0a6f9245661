{ The unit uFlex2Pos of the IOFLEX02 for Free Pascal: its source's types, constants and object, over the C interface (libmotionrack.so).

    uses uFlex2Pos;
    var MyIOFlexObj: tIOFlexPos;
    begin
      MyIOFlexObj.Init($2300);
      if MyIOFlexObj.Result <> Flex_Ok then Write('not initialised: ', MyIOFlexObj.Result);
    end.

  The first Init opens the rack file that the environment variable MOTIONRACK_RACK names; without it, a rack with one card at $2300. Rack
  gives it to the functions of motionrack/c.h, such as mr_advance_ns: time passes in it only when somebody lets it pass. Compile with
  -Fu and the unit's folder, -Fl and the library's. }
unit uFlex2Pos;

{$mode fpc}
{$packrecords c}

interface

const
  cVerNo = $0251;
  cVer = '02.51, 07.08.2003';

  { Outcomes of Init. }
  Flex_Ok = 0;          { the array is configured }
  Flex_ErrCfg = 1;      { configuration failed }
  Flex_ErrDevice = 2;   { no card, or a wrong base address }
  Flex_ErrProject = 3;  { another project or version in the array }

type
  { Calibration command and status of an axis. }
  tIOFlexCmd = (cNop, cRes, cResNm, cResNmSig);
  tIOFlexSts = (sNotCal, sCal);

  { The card's configuration object: array, inputs, outputs. }
  tIOFlex02 = object
    Result: Integer;
    procedure Init(Addr: Word);
    procedure Done;
    { The sentence to Result; empty if it is Flex_Ok. }
    function Why: AnsiString;
    function GetIdent: Byte;
    procedure WriteOutL(Data: Byte);
    procedure WriteOutH(Data: Byte);
    function ReadInL: Byte;
    function ReadInH: Byte;
  protected
    Handle: Pointer;
    Sentence: AnsiString;
  end;

  { Time in ticks of 1.2 us, positions in counts from the calibration. }
  tIOFlexPos = object(tIOFlex02)
    function ReadTime: Longint;
    function ReadTimeClr: Longint;
    function ReadPosition0: Longint;
    function ReadPosition1: Longint;
    function ReadPosition2: Longint;
    function ReadPosition3: Longint;
    procedure ReadTimeClrPosition(var Time, Pos0, Pos1, Pos2, Pos3: Longint);
    procedure WriteCmd(Cmd0, Cmd1, Cmd2, Cmd3: tIOFlexCmd);
    procedure ReadSts(var Sts0, Sts1, Sts2, Sts3: tIOFlexSts);
  end;

{ The rack that the cards are in: nil before the first Init. }
function Rack: Pointer;

{ Lets virtual time pass, and drives a wire; the rest of motionrack/c.h can be declared alike. }
function mr_advance_ns(Rack: Pointer; Ns: QWord): Longint; cdecl; external 'motionrack';
function mr_wire_set(Rack: Pointer; Wire: PAnsiChar; Value: Double): Longint; cdecl; external 'motionrack';
function mr_last_error: PAnsiChar; cdecl; external 'motionrack';

implementation

uses
  Dos, Math;

function mr_rack_open(TomlPathOrText: PAnsiChar; var Rack: Pointer): Longint; cdecl; external 'motionrack';
procedure mr_rack_close(Rack: Pointer); cdecl; external 'motionrack';
function flex2pos_open(Rack: Pointer; var Flex: Pointer): Longint; cdecl; external 'motionrack';
procedure flex2pos_close(Flex: Pointer); cdecl; external 'motionrack';
function flex2pos_Init(Flex: Pointer; Addr: Word): Longint; cdecl; external 'motionrack';
function flex2pos_why(Flex: Pointer): PAnsiChar; cdecl; external 'motionrack';
function flex2pos_GetIdent(Flex: Pointer): Byte; cdecl; external 'motionrack';
function flex2pos_ReadTime(Flex: Pointer): Longint; cdecl; external 'motionrack';
function flex2pos_ReadTimeClr(Flex: Pointer): Longint; cdecl; external 'motionrack';
function flex2pos_ReadPosition(Flex: Pointer; Axis: Longint): Longint; cdecl; external 'motionrack';
procedure flex2pos_ReadTimeClrPosition(Flex: Pointer; Time, Pos: PLongint); cdecl; external 'motionrack';
procedure flex2pos_WriteOutL(Flex: Pointer; Data: Byte); cdecl; external 'motionrack';
procedure flex2pos_WriteOutH(Flex: Pointer; Data: Byte); cdecl; external 'motionrack';
function flex2pos_ReadInL(Flex: Pointer): Byte; cdecl; external 'motionrack';
function flex2pos_ReadInH(Flex: Pointer): Byte; cdecl; external 'motionrack';
procedure flex2pos_WriteCmd(Flex: Pointer; Cmd0, Cmd1, Cmd2, Cmd3: Longint); cdecl; external 'motionrack';
procedure flex2pos_ReadSts(Flex: Pointer; Sts: PLongint); cdecl; external 'motionrack';

var
  TheRack: Pointer = nil;

function Rack: Pointer;
begin
  Rack := TheRack;
end;

procedure tIOFlex02.Init(Addr: Word);
var
  RackFile: AnsiString;
begin
  Result := Flex_ErrDevice;
  Handle := nil;
  if TheRack = nil then
  begin
    RackFile := GetEnv('MOTIONRACK_RACK');
    if RackFile = '' then RackFile := '[card.p1]'#10'type = "ioflex02"'#10'loaded = false'#10;
    if mr_rack_open(PAnsiChar(RackFile), TheRack) <> 0 then
    begin
      Sentence := mr_last_error;
      Exit;
    end;
  end;
  if flex2pos_open(TheRack, Handle) <> 0 then
  begin
    Sentence := mr_last_error;
    Exit;
  end;
  Result := flex2pos_Init(Handle, Addr);
  Sentence := flex2pos_why(Handle);
end;

procedure tIOFlex02.Done;
begin
  flex2pos_close(Handle);
  Handle := nil;
  Result := Flex_ErrDevice;
end;

function tIOFlex02.Why: AnsiString;
begin
  Why := Sentence;
end;

function tIOFlex02.GetIdent: Byte;
begin
  GetIdent := flex2pos_GetIdent(Handle);
end;

procedure tIOFlex02.WriteOutL(Data: Byte);
begin
  flex2pos_WriteOutL(Handle, Data);
end;

procedure tIOFlex02.WriteOutH(Data: Byte);
begin
  flex2pos_WriteOutH(Handle, Data);
end;

function tIOFlex02.ReadInL: Byte;
begin
  ReadInL := flex2pos_ReadInL(Handle);
end;

function tIOFlex02.ReadInH: Byte;
begin
  ReadInH := flex2pos_ReadInH(Handle);
end;

function tIOFlexPos.ReadTime: Longint;
begin
  ReadTime := flex2pos_ReadTime(Handle);
end;

function tIOFlexPos.ReadTimeClr: Longint;
begin
  ReadTimeClr := flex2pos_ReadTimeClr(Handle);
end;

function tIOFlexPos.ReadPosition0: Longint;
begin
  ReadPosition0 := flex2pos_ReadPosition(Handle, 0);
end;

function tIOFlexPos.ReadPosition1: Longint;
begin
  ReadPosition1 := flex2pos_ReadPosition(Handle, 1);
end;

function tIOFlexPos.ReadPosition2: Longint;
begin
  ReadPosition2 := flex2pos_ReadPosition(Handle, 2);
end;

function tIOFlexPos.ReadPosition3: Longint;
begin
  ReadPosition3 := flex2pos_ReadPosition(Handle, 3);
end;

procedure tIOFlexPos.ReadTimeClrPosition(var Time, Pos0, Pos1, Pos2, Pos3: Longint);
var
  Pos: array[0..3] of Longint;
begin
  flex2pos_ReadTimeClrPosition(Handle, @Time, @Pos[0]);
  Pos0 := Pos[0];
  Pos1 := Pos[1];
  Pos2 := Pos[2];
  Pos3 := Pos[3];
end;

procedure tIOFlexPos.WriteCmd(Cmd0, Cmd1, Cmd2, Cmd3: tIOFlexCmd);
begin
  flex2pos_WriteCmd(Handle, Ord(Cmd0), Ord(Cmd1), Ord(Cmd2), Ord(Cmd3));
end;

procedure tIOFlexPos.ReadSts(var Sts0, Sts1, Sts2, Sts3: tIOFlexSts);
var
  Sts: array[0..3] of Longint;
begin
  flex2pos_ReadSts(Handle, @Sts[0]);
  Sts0 := tIOFlexSts(Sts[0]);
  Sts1 := tIOFlexSts(Sts[1]);
  Sts2 := tIOFlexSts(Sts[2]);
  Sts3 := tIOFlexSts(Sts[3]);
end;

initialization
  { The library reckons with infinities; Free Pascal would stop the program at the first one. }
  SetExceptionMask([exInvalidOp, exDenormalized, exZeroDivide, exOverflow, exUnderflow, exPrecision]);

finalization
  if TheRack <> nil then mr_rack_close(TheRack);
end.
