{ The unit uIOFlex2 of the IOFLEX02 for Free Pascal: the card's configuration object and its results, over the C
  interface (libmotionrack.so). uFlex2Pos adds the functions of the project "position".

    uses uIOFlex2;
    var Flex: tIOFlex02;
    begin
      Flex.Init($2300);
      Flex.Configure(nil, 0);
      if Flex.Result = Flex_Ok then Flex.WriteOutL($81);
    end.

  The first Init of a program opens the rack file that the environment variable MOTIONRACK_RACK names; without it, a rack
  with one card at $2300. Rack gives it to the functions of motionrack/c.h, such as mr_advance_ns: time passes in it only
  when a call advances it. Compile with -Fu and the unit's folder, -Fl and the library's; programs may be in the modes
  fpc, tp, delphi and objfpc. }
unit uIOFlex2;

{$mode fpc}
{$packrecords c}

interface

const
  { Results of Configure, and of Init of tIOFlexPos. }
  Flex_Ok = 0;          { the array is configured }
  Flex_ErrCfg = 1;      { configuration failed: the image is truncated, damaged or not an image }
  Flex_ErrDevice = 2;   { no card, or a wrong base address; not configured yet }
  Flex_ErrProject = 3;  { another project or version in the array }

type
  pIOFlex02 = ^tIOFlex02;

  { The card's configuration object: array, inputs, outputs. }
  tIOFlex02 = object
    Result: Integer;
    { Sets only the base address; call Configure next. }
    constructor Init(Addr: Word);
    destructor Done; virtual;
    { Loads a configuration image of Size bytes, written by motionrack image make, into the array. nil: the image of the
      card in the rack file, or else the built-in image. Advances the rack's virtual time by seconds. }
    procedure Configure(Image: Pointer; Size: Longint);
    { Returns the message for the code in Result; empty for Flex_Ok. }
    function Why: AnsiString;
    function GetIdent: Byte;
    { Write the low and the high 8 outputs of connector X5. }
    procedure WriteOutL(Data: Byte);
    procedure WriteOutH(Data: Byte);
    { Return the low and the high 8 of the 16 inputs. From bit 0 on: A, B, Z and Cal of axes 0 and 1; of axes 2 and 3. }
    function ReadInL: Byte;
    function ReadInH: Byte;
  protected
    Handle: Pointer;
  end;

{ Returns the rack of the cards; nil before the first Init. }
function Rack: Pointer;

{ Advance virtual time, and force a wire; the rest of motionrack/c.h can be declared alike. }
function mr_advance_ns(Rack: Pointer; Ns: QWord): Longint; cdecl; external 'motionrack';
function mr_wire_set(Rack: Pointer; Wire: PAnsiChar; Value: Double): Longint; cdecl; external 'motionrack';
function mr_wire_get(Rack: Pointer; Wire: PAnsiChar; var Value: Double): Longint; cdecl; external 'motionrack';
function mr_last_error: PAnsiChar; cdecl; external 'motionrack';

implementation

uses
  Dos, Math;

function mr_rack_open(TomlPathOrText: PAnsiChar; var Rack: Pointer): Longint; cdecl; external 'motionrack';
procedure mr_rack_close(Rack: Pointer); cdecl; external 'motionrack';
function flex2pos_open(Rack: Pointer; var Flex: Pointer): Longint; cdecl; external 'motionrack';
procedure flex2pos_close(Flex: Pointer); cdecl; external 'motionrack';
function flex2pos_set_base_address(Flex: Pointer; Addr: Word): Longint; cdecl; external 'motionrack';
function flex2pos_Configure(Flex: Pointer; Image: Pointer; Size: SizeUInt): Longint; cdecl; external 'motionrack';
function flex2pos_why(Flex: Pointer): PAnsiChar; cdecl; external 'motionrack';
function flex2pos_GetIdent(Flex: Pointer): Byte; cdecl; external 'motionrack';
procedure flex2pos_WriteOutL(Flex: Pointer; Data: Byte); cdecl; external 'motionrack';
procedure flex2pos_WriteOutH(Flex: Pointer; Data: Byte); cdecl; external 'motionrack';
function flex2pos_ReadInL(Flex: Pointer): Byte; cdecl; external 'motionrack';
function flex2pos_ReadInH(Flex: Pointer): Byte; cdecl; external 'motionrack';

type
  { A handle and the object of its Init: objects have no state before their first Init. }
  tOpened = record
    Owner, Handle: Pointer;
  end;

var
  TheRack: Pointer = nil;
  NotOpened: AnsiString = '';
  Opened: array of tOpened;

function Rack: Pointer;
begin
  Rack := TheRack;
end;

procedure CloseOf(Owner: Pointer);
var
  I: Integer;
begin
  for I := High(Opened) downto 0 do
    if Opened[I].Owner = Owner then
    begin
      flex2pos_close(Opened[I].Handle);
      Opened[I] := Opened[High(Opened)];
      SetLength(Opened, Length(Opened) - 1);
    end;
end;

{ Returns the handle, or nil and the reason in NotOpened. }
function OpenFor(Owner: Pointer): Pointer;
var
  RackFile: AnsiString;
begin
  OpenFor := nil;
  NotOpened := '';
  if TheRack = nil then
  begin
    RackFile := GetEnv('MOTIONRACK_RACK');
    if RackFile = '' then RackFile := '[card.p1]'#10'type = "ioflex02"'#10'preloaded = false'#10;
    if mr_rack_open(PAnsiChar(RackFile), TheRack) <> 0 then NotOpened := mr_last_error;
  end;
  if NotOpened <> '' then Exit;
  SetLength(Opened, Length(Opened) + 1);
  Opened[High(Opened)].Owner := Owner;
  if flex2pos_open(TheRack, Opened[High(Opened)].Handle) = 0 then Exit(Opened[High(Opened)].Handle);
  NotOpened := mr_last_error;
  SetLength(Opened, Length(Opened) - 1);
end;

constructor tIOFlex02.Init(Addr: Word);
begin
  CloseOf(@Self);
  Result := Flex_ErrDevice;
  Handle := OpenFor(@Self);
  if Handle <> nil then flex2pos_set_base_address(Handle, Addr);
end;

destructor tIOFlex02.Done;
begin
  CloseOf(@Self);
  Handle := nil;
  Result := Flex_ErrDevice;
end;

procedure tIOFlex02.Configure(Image: Pointer; Size: Longint);
begin
  if Handle = nil then Exit;
  if Size < 0 then Size := 0;
  Result := flex2pos_Configure(Handle, Image, Size);
end;

function tIOFlex02.Why: AnsiString;
begin
  if Handle <> nil then
    Why := flex2pos_why(Handle)
  else
    Why := NotOpened;
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

initialization
  { The library computes with infinities; Free Pascal would stop the program at the first one. }
  SetExceptionMask([exInvalidOp, exDenormalized, exZeroDivide, exOverflow, exUnderflow, exPrecision]);

finalization
  while Length(Opened) > 0 do CloseOf(Opened[0].Owner);
  if TheRack <> nil then mr_rack_close(TheRack);
end.
