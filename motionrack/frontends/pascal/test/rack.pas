{ Every function of the unit uMotionrack on virtual racks. Prints what is wrong, and at the end how much that was.
  Compiled in the modes fpc, tp, delphi and objfpc. }
program RackFunctions;

uses
  uMotionrack;

const
  HomingRack = '[card.c1]'#10'type = "mcx314"'#10'[axis.X]'#10'card = "c1"'#10'channel = "x"'#10'initial_position_mm = 5'#10 +
    'max_limit_mm = 300'#10'[axis.X.switches]'#10'home_mm = 1'#10'limit_minus_mm = -1'#10'limit_plus_mm = 301'#10;
  Part = 'G21 G90'#10'G1 X7 F1200'#10'M2'#10;

var
  Rack, Copy: pmr_rack;
  Wrong, Seen: Integer;
  ConditionCall: tmr_condition;
  QuantityCall: tmr_quantity;
  FaultCall: tmr_fault;
  ProgressCall: tmr_progress;

procedure Expect(Good: Boolean; const What: string);
begin
  if Good then Exit;
  WriteLn('wrong: ', What, ' (', mr_last_error, ')');
  Inc(Wrong);
end;

procedure OnCondition(User: Pointer; Number: QWord; At100ps: Int64; Card: PAnsiChar; Code: Longint;
  Sentence: PAnsiChar); cdecl;
begin
  Expect((User = @Seen) and (Number > 0) and (At100ps >= 0) and (Card <> nil) and (Code >= 0) and (Sentence <> nil),
    'a condition');
  Inc(Seen);
end;

procedure OnQuantity(User: Pointer; Quantity: pmr_quantity); cdecl;
begin
  Expect((User = @Seen) and (Quantity^.Meaning <> nil) and (Quantity^.Min <= Quantity^.Max), 'a quantity');
  if (Quantity^.CanSet = 1) and (Quantity^.Unit_^ = 'm') then Inc(Seen);
end;

procedure OnFault(User: Pointer; Fault: pmr_fault_info); cdecl;
begin
  Expect((User = @Seen) and (Fault^.Target^ in ['X', 'Y', 'Z', 'A']) and (Fault^.Min <= Fault^.Max), 'a fault');
  Inc(Seen);
end;

function OnProgress(User: Pointer; Seconds: Double; Line, Lines: Int64): Longint; cdecl;
begin
  Expect((User = @Seen) and (Seconds >= 0) and (Line <= Lines), 'progress');
  Inc(Seen);
  if Seen = 1000 then OnProgress := 1 else OnProgress := 0;
end;

procedure RacksAndTime;
begin
  Expect(mr_version^ in ['0'..'9'], 'mr_version');
  Expect((mr_rack_open('card.c1 = "mcx315"', Rack) = MR_BAD_INPUT) and (Rack = nil), 'a rack file with a mistake');
  Expect(mr_last_error^ <> #0, 'mr_last_error');
  Expect(mr_rack_open('card.c1 = "mcx314"', Rack) = MR_OK, 'mr_rack_open');
  Expect(mr_advance_ns(Rack, 1000) = MR_OK, 'mr_advance_ns');
  Expect(mr_now_ns(Rack) = 1000, 'mr_now_ns');
end;

procedure TheBus;
var
  Low: Word;
  Octet: Byte;
  Long: Longword;
  Value: QWord;
begin
  Low := 0;
  Expect(mr_write16(Rack, 'c1', $0e, 0) = MR_OK, 'mr_write16');
  Expect(mr_write16(Rack, 'c1', $0c, 100) = MR_OK, 'WR6');
  Expect(mr_write16(Rack, 'c1', $00, $0106) = MR_OK, 'P');
  Expect(mr_write16(Rack, 'c1', $00, $0120) = MR_OK, 'drive');
  Expect(mr_advance_ns(Rack, 1000000000) = MR_OK, 'a second');
  Expect(mr_write16(Rack, 'c1', $00, $0110) = MR_OK, 'LP to RR6');
  Expect((mr_read16(Rack, 'c1', $0c, Low) = MR_OK) and (Low = 100), 'mr_read16');
  Expect((mr_peek(Rack, 'c1', 'x.LP', Value) = MR_OK) and (Value = 100), 'mr_peek');
  Expect((mr_read8(Rack, 'c1', 0, Octet) = MR_REFUSED) and (mr_write8(Rack, 'c1', 0, 0) = MR_REFUSED), '8 bits');
  Expect((mr_read32(Rack, 'c1', 0, Long) = MR_REFUSED) and (mr_write32(Rack, 'c1', 0, 0) = MR_REFUSED), '32 bits');
end;

procedure WiresAndTheMachine;
var
  Value: Double;
begin
  Expect((mr_wire_get(Rack, 'c1.xlmtp', Value) = MR_OK) and (Value = 1), 'mr_wire_get');
  Expect(mr_wire_set(Rack, 'c1.xlmtp', 0) = MR_OK, 'mr_wire_set');
  Expect((mr_part_get(Rack, 'X.position_pulses', Value) = MR_OK) and (Value = 100), 'mr_part_get');
  Expect(mr_part_set(Rack, 'Y.position_mm', 2) = MR_OK, 'mr_part_set');
  Expect(mr_fault(Rack, 'encoder.broken_a', 'X') = MR_OK, 'mr_fault');
  QuantityCall := tmr_quantity(@OnQuantity);
  Seen := 0;
  Expect((mr_quantities(Rack, QuantityCall, @Seen) = MR_OK) and (Seen = 3), 'mr_quantities');
  FaultCall := tmr_fault(@OnFault);
  Seen := 0;
  Expect((mr_faults(Rack, FaultCall, @Seen) = MR_OK) and (Seen = 24), 'mr_faults');
end;

procedure TheWholeWorld;
var
  Told: Integer;
begin
  Expect(mr_snapshot(Rack, Copy) = MR_OK, 'mr_snapshot');
  Expect(mr_state_hash(Copy) = mr_state_hash(Rack), 'mr_state_hash');
  mr_rack_close(Copy);
  ConditionCall := tmr_condition(@OnCondition);
  Seen := 0;
  Expect(mr_on_condition(Rack, ConditionCall, @Seen) = MR_OK, 'mr_on_condition');
  Expect((mr_fault(Rack, 'motor.lose_steps=64', 'Y') = MR_OK) and (Seen >= 1), 'the call-back');
  Told := Seen;
  Expect(mr_on_condition(Rack, nil, nil) = MR_OK, 'no call-back');
  Expect((mr_fault(Rack, 'motor.lose_steps=64', 'Y') = MR_OK) and (Seen = Told), 'no more of it');
  Seen := 0;
  Expect((mr_conditions(Rack, 0, ConditionCall, @Seen) = MR_OK) and (Seen > Told), 'mr_conditions');
end;

procedure Recordings;
begin
  Expect(mr_trace_unit(Rack, 10) = MR_OK, 'mr_trace_unit');
  Expect(mr_trace_start(Rack, '/no/such/folder/a.h5', nil) = MR_IO, 'mr_trace_start');
  Expect(mr_trace_stop(Rack) = MR_REFUSED, 'mr_trace_stop');
  mr_rack_close(Rack);
end;

procedure TheController;
var
  Options: mr_run_options;
  Outcome: mr_run_result;
  Value: Double;
begin
  Expect(mr_rack_open(HomingRack, Rack) = MR_OK, 'the second rack');
  FillChar(Options, SizeOf(Options), 0);
  ProgressCall := tmr_progress(@OnProgress);
  Options.Progress := ProgressCall;
  Options.User := @Seen;
  Seen := 0;
  Expect(mr_run_program(Rack, 'G1 Xq'#10, @Options, @Outcome) = MR_BAD_INPUT, 'a wrong program');
  Expect((Outcome.Ok = 0) and (Outcome.Line = 1) and (Outcome.Column > 0), 'its line and column');
  Expect(mr_run_program(Rack, Part, @Options, @Outcome) = MR_OK, 'mr_run_program');
  Expect((Outcome.Ok = 1) and (Outcome.PathMm > 1.9) and (Outcome.PathMm < 2.1) and (Outcome.Seconds > 0.1) and
    (Outcome.DeviationMm < 0.1) and (Outcome.Sentence^ <> #0), 'its outcome');
  Expect(Seen > 1, 'its progress');
  Expect(mr_report(Rack)^ <> #0, 'mr_report');
  Expect((mr_home(Rack, 'X') = MR_OK) and (mr_part_get(Rack, 'X.position_mm', Value) = MR_OK) and (Value < 1.1),
    'mr_home');
  Expect((mr_run_program(Rack, Part, nil, @Outcome) = MR_OK) and (Outcome.PathMm > 0), 'the next program');
  mr_rack_close(Rack);
end;

procedure Frames;
var
  Frame: mr_frame;
begin
  Expect(mr_rack_open('card.g1 = "grating_bus"', Rack) = MR_OK, 'the third rack');
  Expect(mr_frame_read(Rack, 'g1', Frame) = MR_REFUSED, 'no frame yet');
  FillChar(Frame, SizeOf(Frame), 255);
  Expect((mr_frame_wait(Rack, 'g1', 1000000, Frame) = MR_OK) and (Frame.Words > 0) and
    (Frame.Words <= MR_MAX_SCALES) and (Frame.Time100ps = 0) and (Frame.Counts[127] = 0), 'mr_frame_wait');
  Expect(mr_frame_read(Rack, 'g1', Frame) = MR_OK, 'mr_frame_read');
  mr_rack_close(Rack);
end;

begin
  Wrong := 0;
  RacksAndTime;
  TheBus;
  WiresAndTheMachine;
  TheWholeWorld;
  Recordings;
  TheController;
  Frames;
  WriteLn(Wrong, ' wrong');
  if Wrong > 0 then Halt(1);
end.
