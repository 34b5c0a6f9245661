// The MCX314 function library: the source's functions over a register port. The range of every argument is checked
// before anything is written. The library accesses the chip only through its registers, so it works with a virtual chip
// as with a real one.
//
// Functions with the source's names (CamelCase) take register units; see units.hpp for millimetres and curves.hpp for
// plans. Axis masks: X 1, Y 2, Z 4, U 8 and their sums. A refused call (ErrorKind::refused) has written nothing.
#pragma once

#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <motionrack/cards/mcx314/driver/status.hpp>
#include <motionrack/cards/mcx314/driver/types.hpp>
#include <optional>
#include <string>

namespace motionrack::mcx314 {

class Driver {
  public:
    Driver(RegisterPort& port, Interrupt& interrupt) : port_(port), interrupt_(interrupt) {}

    // ---- initial
    /// Resets the chip by software, and waits the 875 ns that it takes.
    void RESET();
    /// Executes RESET(), then writes 0 to every mode register, AO, LP and EP, so the chip's own defaults do not matter.
    void initialise();
    /// Selects the pulse output: `mode` 0 two pulse trains, 1 pulse and direction (WR2 PLSMD).
    Result<void> SetPulseMode(unsigned axes, int mode);
    /// Sets the levels of the pulse outputs. `negative`: Low pulses; `direction_high`: direction High in + direction.
    Result<void> SetPulseLevels(unsigned axes, bool negative, bool direction_high);
    /// Sets the multiple M, 1 .. 500: pulses/s = V * M. Writes R = 8,000,000 / M. Not while driving.
    Result<void> SetMultiple(unsigned axes, std::int64_t multiple);
    /// Sets R, 16,000 .. 8,000,000: pulses/s = V * 8,000,000 / R. Not while driving.
    Result<void> SetRange(unsigned axes, std::int64_t range);
    Result<void> SetRange(std::int64_t range) { return SetRange(xyzu, range); }
    /// Writes the smallest whole multiple with which V <= 8,000 reaches `pulses_a_second`, 1 .. 4,000,000.
    Result<void> SetMaxSpeed(unsigned axes, std::int64_t pulses_a_second);
    Result<void> SetMaxSpeed(std::int64_t pulses_a_second) { return SetMaxSpeed(xyzu, pulses_a_second); }
    /// Writes R, 16,000 .. 13,856,407: the second and third axis of a constant vector speed need more than 8,000,000.
    Result<void> WriteRange(unsigned axes, std::int64_t range);

    // ---- speeds and ramps
    Result<void> SetSV(unsigned axes, std::int64_t value);  ///< initial speed, 1 .. 8,000
    Result<void> SetV(unsigned axes, std::int64_t value);   ///< drive speed, 1 .. 8,000; also while driving
    Result<void> SetA(unsigned axes, std::int64_t value);   ///< acceleration, 1 .. 8,000 (125 * M pulses/s2)
    Result<void> SetD(unsigned axes,
                      std::int64_t value);                  ///< deceleration, 1 .. 8,000; used if SetAsymmetric() is on
    Result<void> SetAA(unsigned axes, std::int64_t value);  ///< K, 1 .. 65,535: jerk 62.5e6 / K * M pulses/s3
    /// Sets AO, the pulses reserved for the end at SV, 0 .. 65,535; absent (initially): each drive writes its need.
    Result<void> SetAO(unsigned axes, std::optional<std::int64_t> value);
    /// Sets the pulses of a fixed drive, -268,435,455 .. 268,435,455; the sign is the direction for DriveFixed().
    Result<void> Pulse(unsigned axes, std::int64_t pulses);
    /// Selects automatic deceleration: the chip determines the deceleration point itself. Not for arcs.
    Result<void> AutoDec(unsigned axes = xyzu);
    /// Selects manual deceleration: fixed drives decelerate after `point` pulses, 0 .. 268,435,455.
    Result<void> ManualDec(unsigned axes, std::int64_t point);
    Result<void> ManDec(unsigned axes, std::int64_t point) { return ManualDec(axes, point); }
    /// Sets only the point, also while driving with manual deceleration.
    Result<void> SetDecPoint(unsigned axes, std::int64_t point);
    /// Selects whether decelerations use D instead of A. With automatic deceleration, TCurve_F and SCurve_F then write
    /// the point of best_dec_point(); DriveFixed() does not.
    Result<void> SetAsymmetric(unsigned axes, bool on);
    /// Selects an S-curve or a T-curve for the next drives (WR3 SACC).
    void SetSCurve(unsigned axes, bool on);

    // ---- drives
    // Refused while one of the axes drives, or before its multiple is set.
    /// Starts a fixed drive with a T-curve; the sign of `pulses` is the direction.
    Result<void> TCurve_F(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t pulses);
    /// Starts a continuous drive with a T-curve, until stopped. `negative`: in - direction (the source knows only +).
    Result<void> TCurve_C(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, bool negative = false);
    Result<void> SCurve_F(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                          std::int64_t pulses);
    Result<void> SCurve_C(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                          bool negative = false);
    /// Returns the plan of TCurve_F (`k` 0) or SCurve_F with these values; writes nothing.
    Result<CurvePlan> plan(int axis, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                           std::int64_t pulses) const;
    /// Starts the drives set by Pulse(), each axis in its direction, all at the same tick.
    Result<void> DriveFixed(unsigned axes);
    /// Write the commands 20h..27h without any check or parameter.
    void Drive(unsigned axes, bool negative);
    void DriveContinuous(unsigned axes, bool negative);
    void Hold(unsigned axes);
    void Start(unsigned axes);
    void SlowStop(unsigned axes);
    void QuickStop(unsigned axes);

    // ---- while driving (on_the_fly.cpp)
    /// Stops the axes of the mask and all axes interpolated with them. An empty mask is refused; it does not mean
    /// "all".
    Result<void> stop(unsigned axes, StopKind kind);
    void stop_all(StopKind kind);
    /// Changes V of driving axes, 1 .. 8,000. Refused if it would have no effect: an axis is stationary, is in an S
    /// ramp (the chip applies it only after the ramp) or decelerates to its end.
    Result<void> change_speed(unsigned axes, std::int64_t v);
    /// Changes the number of pulses of a fixed drive started by this library, counted from its start, signed. Refused:
    /// the opposite direction; fewer pulses than already made plus those for the deceleration (with `margin` of time at
    /// the present speed); during an S ramp; during the final deceleration. The refusal states the pulses made.
    Result<void> change_pulses(int axis, std::int64_t pulses, Duration margin = milliseconds(1));

    // ---- interpolation (interpolation.cpp)
    Result<void> SetCP(unsigned axes, std::int64_t centre);  ///< centre of arcs, relative to the start
    Result<void> SetC(unsigned axes, std::int64_t centre) { return SetCP(axes, centre); }
    Result<void> SetFP(unsigned axes, std::int64_t finish);  ///< finish point of lines and arcs, relative to the start
    Result<void> SetP(unsigned axes, std::int64_t finish) { return SetFP(axes, finish); }
    /// Start lines: C constant speed, T trapezoid, S S-curve. Speeds are those of the longest axis. Lines, arcs, chains
    /// and patterns are refused while any interpolation runs; they end a chain or a pattern left open.
    Result<void> Line2D_C(const LINEDATA& data, unsigned axes);
    Result<void> Line2D_T(const LINEDATA& data, unsigned axes);
    Result<void> Line2D_S(const LINEDATA& data, unsigned axes);
    Result<void> Line3D_C(const LINEDATA& data, unsigned axes);
    Result<void> Line3D_T(const LINEDATA& data, unsigned axes);
    Result<void> Line3D_S(const LINEDATA& data, unsigned axes);
    /// Start arcs. Refused if the finish point is off the circle by more than the tolerance. T-curves decelerate at the
    /// point of ManualDec() of the first axis if it is active, else at one computed from the basic pulses.
    Result<void> CircleCW_C(const CIRCLEDATA& data, unsigned axes);
    Result<void> CircleCCW_C(const CIRCLEDATA& data, unsigned axes);
    Result<void> CircleCW_T(const CIRCLEDATA& data, unsigned axes);
    Result<void> CircleCCW_T(const CIRCLEDATA& data, unsigned axes);
    /// Returns the end of an arc on the chip, and its basic pulses; writes nothing.
    Result<rules::ArcEnd> arc_end(const CIRCLEDATA& data, unsigned axes, bool clockwise) const;
    /// Sets the permitted distance of a finish point from the circle over the radius, 0 .. 1 (0.01); 3 pulses at least.
    Result<void> set_arc_tolerance(double part);
    double arc_tolerance() const { return arc_tolerance_; }
    /// Keeps the path speed of later lines and arcs constant: two axes stepping together take 1.414 times as long,
    /// three 1.732 times. 1: off, 2: two axes, 3: three axes.
    Result<void> SetVectorSpeed(int axes_count);
    /// Returns the speed of every axis, pulses/s, signed, also in interpolations started by this library: the mean over
    /// some pulses. Refused in a bit pattern, in an interpolation started by Line() or Arc(), and after LPS() has moved
    /// its counters.
    Result<std::array<double, 4>> axis_speeds();

    /// Writes WR5: the channels of AX1, AX2 and AX3, constant vector speed of two axes, and the junction interrupt.
    void SetInterpolationAxes(int first, int second, int third, bool constant_vector, bool interrupt_at_junctions);
    /// Starts or queues a line of two or three axes; finish points -8,388,608 .. 8,388,607.
    Result<void> Line(const Finish* ends, int count);
    Result<void> Arc(const Finish (&ends)[2], bool clockwise);
    void EnableDeceleration(bool on);
    void ClearInterpolationInterrupt();
    /// Enables interrupts at each junction of continuous interpolation, and when the pattern stack needs data.
    void EnableInterpolationInterrupts(bool junctions, bool patterns);

    // ---- continuous interpolation (chain.cpp)
    // ContStart, then any number of ContLine and ContArc, then ContEnd. The last segment is held back until the next
    // call, because only the last one decelerates. Each call waits until the chip takes it, at most `timeout`.
    Result<void> ContStart(const CONTDATA& data);
    /// Adds a line; `finish`: P of the axes in the mask (two or three); `v`: speed from this segment on, 0: unchanged.
    Result<void> ContLine(unsigned axes, const FourAxes& finish, std::int64_t v = 0,
                          Duration timeout = whole_seconds(60));
    Result<void> ContArc(unsigned axes, const FourAxes& finish, const FourAxes& centre, bool clockwise,
                         std::int64_t v = 0, Duration timeout = whole_seconds(60));
    /// Writes the last segment and waits for its end.
    Result<ContOutcome> ContEnd(Duration timeout = whole_seconds(60));

    // ---- bit patterns and steps (patterns.cpp)
    // BP2D or BP3D, up to three BPStack, BPStart, more BPStack while it runs, BPEnd. The last word has the end code.
    Result<void> BP2D(const BPDATA& data, unsigned axes);
    Result<void> BP3D(const BPDATA& data, unsigned axes);
    /// Waits for room on the stack, at most `timeout`.
    Result<void> BPStack(const BPWORD& word, Duration timeout = whole_seconds(60));
    Result<void> BPStart();
    /// Restores the registers and waits for the end of the drive.
    Result<void> BPEnd(Duration timeout = whole_seconds(60));
    /// Selects the source of the steps of the next interpolation.
    Result<void> SetStep(StepBy by);
    /// Requests one basic pulse (3Ah) of an interpolation whose steps come by command.
    Result<void> Step();

    // ---- limits and signals (signals.cpp)
    Result<void> HLMTP(int n, unsigned axes);             ///< + limit switch acts at: 0 Low, 1 High
    Result<void> HLMTM(int n, unsigned axes);             ///< - limit switch acts at: 0 Low, 1 High
    Result<void> HLMTSig(int n, unsigned axes);           ///< limit switches stop: 0 at once, 1 decelerating
    Result<void> SLMTP(int n, unsigned axes = xyzu);      ///< COMP+ as software limit: 0 off, 1 on
    Result<void> SLMTM(int n, unsigned axes = xyzu);      ///< COMP- as software limit: 0 off, 1 on
    Result<void> SLMTSig(int n, unsigned axes = xyzu);    ///< COMP+- are compared with: 0 LP, 1 EP
    Result<void> EncoderMode(int n, unsigned axes);       ///< encoder input: 0 A/B quadrature, 1 up and down pulses
    Result<void> EncoderCWCCW(int n, unsigned axes);      ///< A/B edges counted: 0 all, 1 every second, 2 every fourth
    Result<void> EnableALM(int n, unsigned axes = xyzu);  ///< alarm input: 0 off, 1 on
    Result<void> EnableInPos(int n, unsigned axes = xyzu);                ///< in-position input: 0 off, 1 on
    Result<void> ALMSig(int n, unsigned axes);                            ///< alarm acts at: 0 Low, 1 High
    Result<void> InPosSig(int n, unsigned axes);                          ///< in-position acts at: 0 Low, 1 High
    Result<void> SetStopInput(unsigned axes, int input, StopInput mode);  ///< IN0..IN3
    Result<void> SetExternalDrive(unsigned axes, ExternalDrive mode);     ///< nEXPP, nEXPM
    /// MCX314As: actions of an axis (`actions`, SM7) on one of its `conditions` (SM6). 0, 0: none.
    Result<void> SetSynchronous(unsigned axes, std::uint16_t conditions, std::uint16_t actions);
    /// MCX314As: triggers the synchronous actions of axes that have selected the condition CMD.
    Result<void> Synchronous(unsigned axes);
    /// MCX314As: returns the counter that the axis' synchronous action has saved in BR.
    std::int32_t ReadBR(int axis);
    /// Sets nOUT0 .. nOUT7 (4..7 while they do not show the status). After an emergency stop write low before high.
    Result<void> SetOutput(unsigned axes, int output, bool high);
    Result<void> ShowDriveStatus(unsigned axes, bool on);  ///< nOUT4..7 show CMP+, CMP-, accelerating, decelerating
    InputLevels inputs(int axis);

    /// Enables interrupts (cause::..), disables them, and reads and clears those since the last call.
    Result<void> EnableInterrupt(unsigned axes, std::uint16_t causes);
    Result<void> DisableInterrupt(unsigned axes, std::uint16_t causes = cause::all);
    std::uint16_t read_interrupts(int axis);

    /// Write WR1, WR2, WR3 as whole words; the driver stores the written word of each axis.
    void WriteMode1(unsigned axes, std::uint16_t word);
    void WriteMode2(unsigned axes, std::uint16_t word);
    void WriteMode3(unsigned axes, std::uint16_t word);
    std::uint16_t mode1(int axis) const { return kept(axis).mode[0]; }
    std::uint16_t mode2(int axis) const { return kept(axis).mode[1]; }
    std::uint16_t mode3(int axis) const { return kept(axis).mode[2]; }

    // ---- positions and status
    Result<void> LPS(unsigned axes, std::int64_t value);       ///< sets the logical position, 32 bit
    Result<void> EPS(unsigned axes, std::int64_t value);       ///< sets the real (encoder) position
    Result<void> SetCompP(unsigned axes, std::int64_t value);  ///< COMP+, 32 bit
    Result<void> SetCompM(unsigned axes, std::int64_t value);  ///< COMP-
    std::int32_t ReadLPS(int axis);
    std::int32_t ReadEPS(int axis);
    std::int32_t ReadCV(int axis);  ///< present speed, V units; 0 at standstill; in interpolations only of AX1
    std::int32_t ReadCA(int axis);  ///< present acceleration, A units; at constant speed the last value
    MainStatus status();
    DriveStatus axis_status(int axis);
    bool moving(unsigned axes) { return status().driving(axes); }
    /// Returns a complete report of an axis for messages.
    AxisReport report(int axis);
    /// Returns the reports of the axes with an error or stopped by an input; "" if there are none.
    std::string error_text(unsigned axes = xyzu);

    /// Refuses an invalid channel; `who`: function in the message.
    static Result<void> check_channel(int axis, const char* who);

    /// Waits until none of the axes drives. Errors: ErrorKind::machine after `timeout`; ErrorKind::stopped if the user
    /// requested a stop (the axes are then decelerated to standstill).
    Result<void> wait_until_stopped(unsigned axes, Duration timeout);
    /// Waits as wait_until_stopped(). Also ErrorKind::machine, with the reports, if a limit, an alarm or the emergency
    /// input stopped an axis.
    Result<void> wait_until_done(unsigned axes, Duration timeout);

    /// Returns the last written value of a parameter, cmd::R .. cmd::L; absent after a reset.
    std::optional<std::int64_t> written(int axis, unsigned code) const { return kept(axis).data.at(code); }
    /// Returns the pulses/s of one V unit: 8,000,000 / R; 0 before R is written.
    double multiple(int axis) const;

    RegisterPort& port() { return port_; }
    Interrupt& interrupt() { return interrupt_; }

  private:
    enum class Curve : std::uint8_t { constant, t, s };
    /// Speeds of one drive; `D` 0: as A.
    struct Speeds {
        Curve kind = Curve::constant;
        std::int64_t SV = 0, V = 0, A = 0, D = 0, K = 0;
    };
    /// Values of one axis as written last.
    struct Kept {
        std::array<std::optional<std::int64_t>, 16> data = {};  ///< by command code
        std::array<std::uint16_t, 3> mode = {};
        std::int64_t own_range = 0;  ///< R of the axis' own drives; constant vector speed may have changed it
        std::int64_t dec_point = 0;
        bool manual = false;
        bool asymmetric = false;
        bool own_offset = false;  ///< AO was set by SetAO()
        bool negative = false;    ///< direction of Pulse(), or of the last drive
        bool from_known = false;
        std::int32_t from = 0;                                 ///< LP at the start of the present fixed drive
        std::optional<std::int64_t> finish = {}, centre = {};  ///< as set by SetFP() and SetCP()
        std::uint16_t interrupts = 0;                          ///< read during a wait, not yet returned
    };
    /// A segment of an interpolation. `from`: LP of its axes at its start.
    struct Piece {
        unsigned axes = 0;
        bool arc = false, clockwise = false;
        FourAxes finish = {}, centre = {}, from = {};
        int vector_axes = 1;
    };
    struct Chain {
        bool open = false, running = false;
        int generator = 0;
        unsigned axes = 0;
        Speeds speeds = {};
        std::optional<Piece> pending_piece = {};
        std::int64_t pending_v = 0,
                     next_v = 0;  ///< V to be written at the start of a segment: the held-back one, the queued one
        std::int64_t segments = 0;
        FourAxes at = {};  ///< LP at the end of all segments given
    };
    struct PatternPulses {
        unsigned axes = 0;
        int count = 0;
        std::int64_t words = 0;
        bool running = false;
    };

    Kept& kept(int axis);
    const Kept& kept(int axis) const;

    // Traffic.
    void command(unsigned axes, unsigned code);
    void write_data(unsigned axes, unsigned code, std::uint32_t value);
    std::uint32_t read_data(int axis, unsigned code);
    void write_mode(unsigned axes, int number, std::uint16_t word);
    /// Sets bits of a mode register per axis and keeps the others.
    void set_mode(unsigned axes, int number, Field bits, unsigned value);
    void put(unsigned axes, const Parameter& parameter, std::int64_t value);
    /// While an instance exists, WR2 .. WR7 are accessible also during an open bit pattern.
    class PlainRegisters {
      public:
        explicit PlainRegisters(Driver& driver) : driver_(driver.pattern_.axes != 0 ? &driver : nullptr) {
            if (driver_) driver_->command(0, cmd::BP_DISABLE);
        }
        ~PlainRegisters() {
            if (driver_) driver_->command(0, cmd::BP_ENABLE);
        }
        PlainRegisters(const PlainRegisters&) = delete;
        PlainRegisters& operator=(const PlainRegisters&) = delete;

      private:
        Driver* driver_;
    };
    void write_outputs(std::uint16_t word);
    void write_path_mode(std::uint16_t word);
    bool fetch_interrupts(int axis);

    // Checks: write nothing.
    static Result<void> check_count(const char* who, unsigned axes, int count);
    static Result<void> check_speeds(unsigned axes, const Speeds& speeds);
    static Result<void> check_standing(unsigned axes, const char* who, MainStatus main);
    Result<void> check_standing(unsigned axes, const char* who) { return check_standing(axes, who, status()); }
    Result<void> check_free(unsigned axes, const char* who);
    Result<void> check_initialised(unsigned axes, const char* who) const;
    Result<void> check_piece(const char* who, const Piece& piece) const;
    Result<void> check_chain_speed(int axis, std::int64_t v) const;
    std::string not_changeable(int axis, MainStatus main);

    // A check, then the write.
    Result<void> write(unsigned axes, const Parameter& parameter, std::int64_t value);
    Result<void> write_switch(const char* who, unsigned axes, int number, Field bits, int n, int max_n,
                              const char* meanings);
    Result<void> change_interrupts(const char* who, unsigned axes, std::uint16_t causes, bool on);

    // Drives.
    CurveData curve_of(int axis, const Speeds& speeds, std::optional<std::int64_t> pulses) const;
    Speeds written_speeds(int axis) const;
    Result<CurveData> planned_curve(const char* who, int axis, Speeds speeds, std::optional<std::int64_t> pulses) const;
    void put_speeds(unsigned axes, const Speeds& speeds);
    void put_deceleration(int axis, const CurveData& curve);
    void own_range_again(unsigned axes);
    void note_direction(unsigned axes, bool negative);
    void begin_fixed(unsigned axes);
    Result<void> start_curve(const char* who, unsigned axes, const Speeds& speeds, std::optional<std::int64_t> pulses,
                             bool negative);

    // Interpolation.
    static std::int64_t basic_pulses(const Piece& piece);
    Piece piece_of(unsigned axes, const FourAxes& finish, const FourAxes* centre, bool clockwise) const;
    void read_start(Piece& piece);
    void put_piece(const Piece& piece);
    Result<void> start_piece(const char* who, Piece piece, const Speeds& speeds);
    Result<void> line(const char* who, const LINEDATA& data, unsigned axes, int count, Curve kind);
    Result<void> circle(const char* who, const CIRCLEDATA& data, unsigned axes, bool clockwise, Curve kind);
    Result<void> add_to_chain(const char* who, const Piece& piece, std::int64_t v, Duration timeout);
    Result<void> give_pending_piece(bool last, Duration timeout);
    void aim_at_end(const Piece& piece);
    void note_end(const Piece& piece);
    Result<void> wait_for_junction(Duration timeout, bool may_end = false);
    Result<void> begin_pattern(const char* who, const BPDATA& data, unsigned axes, int count);
    void close_pattern();
    void abandon_path();
    std::array<double, 4> shares(const Piece& piece);
    double mean_range(const Piece& piece, int generator, const std::array<double, 4>& share) const;

    void doze(unsigned axes, Duration slice);

    RegisterPort& port_;
    Interrupt& interrupt_;
    std::array<Kept, 4> kept_ = {};
    std::uint16_t outputs_ = 0;         ///< WR4 as written
    std::uint16_t path_mode_ = 0;       ///< WR5 as written
    unsigned path_axes_ = 0;            ///< axes of the last interpolation
    std::array<Piece, 2> pieces_ = {};  ///< the last two segments: running and queued, or previous and running
    Chain chain_;
    PatternPulses pattern_;
    double arc_tolerance_ = 0.01;
    int vector_axes_ = 1;
};

}  // namespace motionrack::mcx314
