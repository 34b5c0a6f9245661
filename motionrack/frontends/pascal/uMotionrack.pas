{ motionrack/c.h for Free Pascal: every function of the C interface (libmotionrack.so) under its own name. The page of
  the C interface, docs/reference/c.md, describes the functions, their limits and errors.

    uses uMotionrack;
    var Rack: pmr_rack;
    begin
      if mr_rack_open('card.c1 = "mcx314"', Rack) <> MR_OK then
      begin
        WriteLn(mr_last_error);
        Halt(1);
      end;
      mr_write16(Rack, 'c1', $0e, 0);
      mr_advance_ns(Rack, 1000000000);
      mr_rack_close(Rack);
    end.

  Compile with -Fu and the unit's folder, -Fl and the library's; programs may be in the modes fpc, tp, delphi and objfpc.
  Call-backs are cdecl and must return: no exception may leave them. A variable of their type takes
  tmr_condition(@Name), and so on, in every mode. }
unit uMotionrack;

{$mode fpc}
{$packrecords c}

interface

const
  { Result of a function. }
  MR_OK = 0;
  MR_BAD_CALL = 1;
  MR_BAD_INPUT = 2;
  MR_REFUSED = 3;
  MR_MACHINE = 4;
  MR_IO = 5;
  MR_INTERNAL = 6;
  MR_STOPPED = 7;

  { Scales per frame. }
  MR_MAX_SCALES = 128;

type
  { A running rack. }
  pmr_rack = Pointer;

  { Counts of all scales at one instant. }
  mr_frame = record
    Sequence, Words: Longword;
    Time100ps: Int64;
    Counts: array[0..MR_MAX_SCALES - 1] of Longint;
    Addresses: array[0..MR_MAX_SCALES - 1] of Byte;
  end;

  { Call-back of mr_conditions and mr_on_condition. }
  tmr_condition = procedure(User: Pointer; Number: QWord; At100ps: Int64; Card: PAnsiChar; Code: Longint;
    Sentence: PAnsiChar); cdecl;

  mr_quantity = record
    Name, Meaning, Unit_: PAnsiChar;
    Min, Max: Double;
    CanSet: Longint;
  end;
  pmr_quantity = ^mr_quantity;
  tmr_quantity = procedure(User: Pointer; Quantity: pmr_quantity); cdecl;

  mr_fault_info = record
    Name, Target, Meaning, Unit_: PAnsiChar;
    Min, Max: Double;
  end;
  pmr_fault_info = ^mr_fault_info;
  tmr_fault = procedure(User: Pointer; Fault: pmr_fault_info); cdecl;

  { A result other than 0 stops the program. }
  tmr_progress = function(User: Pointer; Seconds: Double; Line, Lines: Int64): Longint; cdecl;

  mr_run_options = record
    Tools: PAnsiChar;
    BlockDelete: Longint;
    Progress: tmr_progress;
    User: Pointer;
  end;
  pmr_run_options = ^mr_run_options;

  mr_run_result = record
    Ok, Line, Column: Longint;
    Seconds, PathMm, DeviationMm: Double;
    Sentence: PAnsiChar;
  end;
  pmr_run_result = ^mr_run_result;

{ ---- Racks ---- }
function mr_rack_open(TomlPathOrText: PAnsiChar; var Rack: pmr_rack): Longint; cdecl; external 'motionrack';
procedure mr_rack_close(Rack: pmr_rack); cdecl; external 'motionrack';
function mr_last_error: PAnsiChar; cdecl; external 'motionrack';
function mr_version: PAnsiChar; cdecl; external 'motionrack';

{ ---- Time ---- }
function mr_advance_ns(Rack: pmr_rack; Ns: QWord): Longint; cdecl; external 'motionrack';
function mr_now_ns(Rack: pmr_rack): QWord; cdecl; external 'motionrack';

{ ---- The host's bus ---- }
function mr_read8(Rack: pmr_rack; Card: PAnsiChar; Port: Longword; var Value: Byte): Longint; cdecl;
  external 'motionrack';
function mr_write8(Rack: pmr_rack; Card: PAnsiChar; Port: Longword; Value: Byte): Longint; cdecl; external 'motionrack';
function mr_read16(Rack: pmr_rack; Card: PAnsiChar; Offset: Longword; var Value: Word): Longint; cdecl;
  external 'motionrack';
function mr_write16(Rack: pmr_rack; Card: PAnsiChar; Offset: Longword; Value: Word): Longint; cdecl;
  external 'motionrack';
function mr_read32(Rack: pmr_rack; Card: PAnsiChar; Offset: Longword; var Value: Longword): Longint; cdecl;
  external 'motionrack';
function mr_write32(Rack: pmr_rack; Card: PAnsiChar; Offset: Longword; Value: Longword): Longint; cdecl;
  external 'motionrack';
function mr_peek(Rack: pmr_rack; Card, RegisterName: PAnsiChar; var Value: QWord): Longint; cdecl; external 'motionrack';

{ ---- Frames of a grating bus ---- }
function mr_frame_read(Rack: pmr_rack; Card: PAnsiChar; var Frame: mr_frame): Longint; cdecl; external 'motionrack';
function mr_frame_wait(Rack: pmr_rack; Card: PAnsiChar; TimeoutNs: QWord; var Frame: mr_frame): Longint; cdecl;
  external 'motionrack';

{ ---- Wires ---- }
function mr_wire_get(Rack: pmr_rack; Wire: PAnsiChar; var Value: Double): Longint; cdecl; external 'motionrack';
function mr_wire_set(Rack: pmr_rack; Wire: PAnsiChar; Value: Double): Longint; cdecl; external 'motionrack';

{ ---- The machine ---- }
function mr_part_get(Rack: pmr_rack; PartDotQuantity: PAnsiChar; var Value: Double): Longint; cdecl;
  external 'motionrack';
function mr_part_set(Rack: pmr_rack; PartDotQuantity: PAnsiChar; Value: Double): Longint; cdecl; external 'motionrack';
function mr_fault(Rack: pmr_rack; Fault, Target: PAnsiChar): Longint; cdecl; external 'motionrack';
function mr_quantities(Rack: pmr_rack; Tell: tmr_quantity; User: Pointer): Longint; cdecl; external 'motionrack';
function mr_faults(Rack: pmr_rack; Tell: tmr_fault; User: Pointer): Longint; cdecl; external 'motionrack';

{ ---- The controller ---- }
{ Options and Outcome may be nil. }
function mr_run_program(Rack: pmr_rack; PathOrText: PAnsiChar; Options: pmr_run_options; Outcome: pmr_run_result):
  Longint; cdecl; external 'motionrack';
function mr_home(Rack: pmr_rack; Axes: PAnsiChar): Longint; cdecl; external 'motionrack';
function mr_report(Rack: pmr_rack): PAnsiChar; cdecl; external 'motionrack';

{ ---- The whole rack ---- }
function mr_snapshot(Rack: pmr_rack; var Copy: pmr_rack): Longint; cdecl; external 'motionrack';
function mr_state_hash(Rack: pmr_rack): QWord; cdecl; external 'motionrack';
function mr_conditions(Rack: pmr_rack; Since: QWord; Tell: tmr_condition; User: Pointer): Longint; cdecl;
  external 'motionrack';
{ Call = nil ends the calls. }
function mr_on_condition(Rack: pmr_rack; Call: tmr_condition; User: Pointer): Longint; cdecl; external 'motionrack';

{ ---- Recordings ---- }
function mr_trace_start(Rack: pmr_rack; Path, Signals: PAnsiChar): Longint; cdecl; external 'motionrack';
function mr_trace_unit(Rack: pmr_rack; Ns: Double): Longint; cdecl; external 'motionrack';
function mr_trace_stop(Rack: pmr_rack): Longint; cdecl; external 'motionrack';

implementation

uses
  Math;

initialization
  { The library computes with infinities; Free Pascal would stop the program at the first one. }
  SetExceptionMask([exInvalidOp, exDenormalized, exZeroDivide, exOverflow, exUnderflow, exPrecision]);
end.
