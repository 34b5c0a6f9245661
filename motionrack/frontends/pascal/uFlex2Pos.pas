{ The unit uFlex2Pos of the IOFLEX02 for Free Pascal: its source's types, constants and object, over the C interface
  (libmotionrack.so). Its name of 8.3 letters is uFlx2Pos.

    uses uIOFlex2, uFlex2Pos;
    var MyIOFlexObj: tIOFlexPos;
    begin
      MyIOFlexObj.Init($2300);
      if MyIOFlexObj.Result <> Flex_Ok then Write('not initialised: ', MyIOFlexObj.Result);
    end.

  Which rack it is, and how to compile: uIOFlex2. Where the source links an image of the customer's own in with
  $L IRC.OBJ, the environment variable MOTIONRACK_IRC names its file, or the program calls SetFlexBin. }
unit uFlex2Pos;

{$mode fpc}
{$packrecords c}

interface

uses
  uIOFlex2;

const
  cVerNo = $0251;
  cVer = '02.51, 07.08.2003';

type
  { Calibration command and state of an axis. }
  tIOFlexCmd = (cNop, cRes, cResNm, cResNmSig);
  tIOFlexSts = (sNotCal, sCal);

  pIOFlexPos = ^tIOFlexPos;

  { Time in ticks of 1.2 us, positions in counts from the calibration. }
  tIOFlexPos = object(tIOFlex02)
    { Sets the base address and fills the array with the image at GetFlexBinAddr. }
    constructor Init(Addr: Word);
    function ReadTime: Longint;
    function ReadTimeClr: Longint;
    function ReadPosition0: Longint;
    function ReadPosition1: Longint;
    function ReadPosition2: Longint;
    function ReadPosition3: Longint;
    procedure ReadTimeClrPosition(var Time, Pos0, Pos1, Pos2, Pos3: Longint);
    procedure WriteCmd(Cmd0, Cmd1, Cmd2, Cmd3: tIOFlexCmd);
    { Extension: a command for one axis 0 to 3; pending calibrations of the other axes continue. }
    procedure WriteCmdAxis(Axis: Integer; Cmd: tIOFlexCmd);
    procedure ReadSts(var Sts0, Sts1, Sts2, Sts3: tIOFlexSts);
  end;

{ Image that Init loads into the array, and its size in bytes; nil and 0: the image of the card in the rack file, or
  else the built-in image. }
function GetFlexBinAddr: Pointer;
function GetFlexBinSize: Longint;

{ Sets the image of Init; it must stay at its address. nil: the image of the rack file or the built-in one. }
procedure SetFlexBin(Addr: Pointer; Size: Longint);

{ Creates a custom image of at most Size bytes and returns its size; 0 after an error, with its sentence in
  mr_last_error. Project and Ident: those of the card (Init accepts 'position' and $25); Modes: counting modes of the
  four axes, words MODE. }
function MakeFlexBin(const Project: AnsiString; Ident: Byte; const Modes: array of Word; Addr: Pointer; Size: Longint):
  Longint;

implementation

uses
  Dos;

function flex2pos_ReadTime(Flex: Pointer): Longint; cdecl; external 'motionrack';
function flex2pos_ReadTimeClr(Flex: Pointer): Longint; cdecl; external 'motionrack';
function flex2pos_ReadPosition(Flex: Pointer; Axis: Longint): Longint; cdecl; external 'motionrack';
procedure flex2pos_ReadTimeClrPosition(Flex: Pointer; Time, Pos: PLongint); cdecl; external 'motionrack';
procedure flex2pos_WriteCmd(Flex: Pointer; Cmd0, Cmd1, Cmd2, Cmd3: Longint); cdecl; external 'motionrack';
procedure flex2pos_WriteCmdAxis(Flex: Pointer; Axis, Cmd: Longint); cdecl; external 'motionrack';
procedure flex2pos_ReadSts(Flex: Pointer; Sts: PLongint); cdecl; external 'motionrack';
function flex2pos_image_make(Project: PAnsiChar; Ident: Byte; Payload: Pointer; PayloadSize: SizeUInt; Image: Pointer;
  var Size: SizeUInt): Longint; cdecl; external 'motionrack';

var
  BinAddr: Pointer = nil;
  BinSize: Longint = 0;
  BinOfFile: array of Byte;

function GetFlexBinAddr: Pointer;
begin
  GetFlexBinAddr := BinAddr;
end;

function GetFlexBinSize: Longint;
begin
  GetFlexBinSize := BinSize;
end;

procedure SetFlexBin(Addr: Pointer; Size: Longint);
begin
  BinAddr := Addr;
  BinSize := Size;
end;

function MakeFlexBin(const Project: AnsiString; Ident: Byte; const Modes: array of Word; Addr: Pointer; Size: Longint):
  Longint;
var
  Payload: array[0..3] of Word;
  Axis: Integer;
  Bytes: SizeUInt;
begin
  for Axis := 0 to 3 do
    if Axis <= High(Modes) then Payload[Axis] := NtoLE(Modes[Axis]) else Payload[Axis] := 0;
  if Size < 0 then Size := 0;
  Bytes := Size;
  if flex2pos_image_make(PAnsiChar(Project), Ident, @Payload, SizeOf(Payload), Addr, Bytes) <> 0 then Bytes := 0;
  MakeFlexBin := Bytes;
end;

{ Reads an image; returns none if the file cannot be read or is longer than an image can be. }
procedure TakeFile(const Name: AnsiString);
const
  Most = 132000;
var
  F: file;
  Got: Longint;
  ModeBefore: Byte;
begin
  SetLength(BinOfFile, Most + 1);
  Got := 0;
  Assign(F, Name);
  ModeBefore := FileMode;
  FileMode := 0;
  {$I-}
  Reset(F, 1);
  if IOResult = 0 then
  begin
    BlockRead(F, BinOfFile[0], Most + 1, Got);
    if IOResult <> 0 then Got := 0;
    Close(F);
  end;
  if IOResult <> 0 then Got := 0;
  {$I+}
  FileMode := ModeBefore;
  SetFlexBin(@BinOfFile[0], Got);
end;

constructor tIOFlexPos.Init(Addr: Word);
begin
  inherited Init(Addr);
  Configure(GetFlexBinAddr, GetFlexBinSize);
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

procedure tIOFlexPos.WriteCmdAxis(Axis: Integer; Cmd: tIOFlexCmd);
begin
  flex2pos_WriteCmdAxis(Handle, Axis, Ord(Cmd));
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
  if GetEnv('MOTIONRACK_IRC') <> '' then TakeFile(GetEnv('MOTIONRACK_IRC'));
end.
