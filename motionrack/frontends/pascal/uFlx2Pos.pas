{ uFlex2Pos under its name of 8.3 letters, as its source's example uses it. }
unit uFlx2Pos;

{$mode fpc}

interface

uses
  uFlex2Pos;

const
  cVerNo = uFlex2Pos.cVerNo;
  cVer = uFlex2Pos.cVer;

type
  tIOFlexCmd = uFlex2Pos.tIOFlexCmd;
  tIOFlexSts = uFlex2Pos.tIOFlexSts;
  pIOFlexPos = uFlex2Pos.pIOFlexPos;
  tIOFlexPos = uFlex2Pos.tIOFlexPos;

const
  cNop = uFlex2Pos.cNop;
  cRes = uFlex2Pos.cRes;
  cResNm = uFlex2Pos.cResNm;
  cResNmSig = uFlex2Pos.cResNmSig;
  sNotCal = uFlex2Pos.sNotCal;
  sCal = uFlex2Pos.sCal;

function GetFlexBinAddr: Pointer;
function GetFlexBinSize: Longint;
procedure SetFlexBin(Addr: Pointer; Size: Longint);
function MakeFlexBin(const Project: AnsiString; Ident: Byte; const Modes: array of Word; Addr: Pointer; Size: Longint):
  Longint;

implementation

function GetFlexBinAddr: Pointer;
begin
  GetFlexBinAddr := uFlex2Pos.GetFlexBinAddr;
end;

function GetFlexBinSize: Longint;
begin
  GetFlexBinSize := uFlex2Pos.GetFlexBinSize;
end;

procedure SetFlexBin(Addr: Pointer; Size: Longint);
begin
  uFlex2Pos.SetFlexBin(Addr, Size);
end;

function MakeFlexBin(const Project: AnsiString; Ident: Byte; const Modes: array of Word; Addr: Pointer; Size: Longint):
  Longint;
begin
  MakeFlexBin := uFlex2Pos.MakeFlexBin(Project, Ident, Modes, Addr, Size);
end;

end.
