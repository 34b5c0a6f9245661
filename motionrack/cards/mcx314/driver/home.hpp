// Homing of one axis: executes a table of START and WAIT states (home_table.hpp) over the register port, without
// blocking.
//
//   start(now) ──► step(now), step(now), .. every few ms or when the chip interrupts ──► homed() or failed, report()
//
// Every drive is a fixed drive of at most `travel` pulses, and stops are the chip's own (WR1). The stop position is
// therefore independent of the rate of step() calls, and the axis also stops if the host fails.
#pragma once

#include <motionrack/base/switch_edges.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/driver/home_report.hpp>
#include <motionrack/cards/mcx314/driver/home_table.hpp>

namespace motionrack::mcx314 {

/// Settings of a homing: speeds in V units (8,000,000 / range pulses/s), distances in pulses.
struct HomeSettings {
    /// Homing method. 1: decelerating stop at the switch. 2: as 1, then back off and approach the switch again slowly.
    /// 3: as 1, then slowly on to the index. 4: as 2, then slowly on to the index. 5: as 3, then back off and approach
    /// the switch again slowly; this is the source's HomeType4.
    int type = 2;
    bool negative = true;                     ///< direction of the search for the switch
    int input = 0;                            ///< the home switch: IN0 .. IN3
    bool active_high = false;                 ///< its active level
    int index_input = 2;                      ///< the encoder's index: IN0 .. IN3, types 3 to 5
    bool index_high = true;                   ///< its active level
    std::int64_t range = 0;                   ///< R, 16,000 .. 8,000,000; 0: the value written before
    std::int64_t sv = 100;                    ///< 1 .. 8,000
    std::int64_t v = 1000;                    ///< speed of the search, 1 .. 8,000
    std::int64_t a = 100;                     ///< acceleration and deceleration, 1 .. 8,000
    std::int64_t back_v = 0;                  ///< speed off the switch, 1 .. sv; 0: sv
    std::int64_t slow_v = 0;                  ///< second approach and index, 1 .. sv; 0: half of sv
    std::int64_t travel = param::pulses.max;  ///< maximum distance of a search, 1 .. 268,435,455
    std::int64_t index_after =
        -1;  ///< pulses from the switch to the index, within a quarter of `turn`; -1: the first index found
    std::int64_t turn = 0;         ///< pulses of a motor revolution: maximum distance of the index search; 0: `travel`
    std::int64_t hysteresis = -1;  ///< switch hysteresis, pulses; -1: unknown, edges are not compared
    std::int64_t repeats = 2;      ///< repeatability of its edges, pulses
    std::int64_t backoff = 50;     ///< distance driven after the switch is released, 0 .. travel
    Duration settle = milliseconds(5);      ///< settling time of contacts without a change, 0 .. 10 s
    Duration timeout = whole_seconds(600);  ///< limit for one state, > 0; less if distance and speed imply less
    bool turn_at_limit = true;              ///< at the limit switch, reverse the search
    std::int64_t home_position = 0;         ///< LP at home, 32 bit
    std::int64_t home_counts = 0;           ///< EP at home, 32 bit
    // For messages.
    std::string name = {};  ///< name of the axis; "": X, Y, Z, U
    std::string unit = "pulses";
    double pulses_per_unit = 1;  ///< not 0
};

/// Makes settings from the arguments of the source's HomeType1 to 4. WR1Reg is WR1 with the home input and its level.
/// With `type` 3 and 4 the index is at IN2, at its level; if IN2 is the only enabled input, the home switch is at IN2
/// and the index at IN3. Errors: refused if no input is enabled.
Result<HomeSettings> home_settings(int type, unsigned WR1Reg, std::int64_t SV, std::int64_t V, std::int64_t A);

class Home {
  public:
    Home(Driver& driver, int axis) : driver_(driver), axis_(axis) {}

    /// Starts the homing. Errors: refused (nothing moves, the position keeps its validity) for settings out of range, a
    /// driving axis, alarm, emergency stop, or both limits active. After the start the position is invalid and the
    /// software limits are disabled, until homing succeeds.
    Result<void> start(const HomeSettings& settings, Instant now);
    /// Executes one poll; never waits. `now` must not decrease.
    void step(Instant now);
    /// Decelerates and aborts the homing. Valid in every state; no effect after the end.
    void stop();

    bool running() const { return running_; }
    bool homed() const { return report_.homed; }
    /// Returns the name of the present state; "" before the first start.
    std::string_view state() const { return table_ == nullptr ? std::string_view{} : state_->name; }
    const HomeReport& report() const { return report_; }
    const HomeSettings& settings() const { return settings_; }
    Driver& driver() { return driver_; }
    int axis() const { return axis_; }

  private:
    /// Data of one poll of the chip.
    struct PollData {
        bool driving = false;
        DriveStatus status;
        bool switch_on = false;
        bool index_on = false;
        std::int32_t lp = 0;
        std::int32_t cv = 0;
    };

    unsigned mask() const { return 1u << axis_; }
    PollData poll();
    Result<void> check_ready();
    void note_switch(const PollData& poll, Instant now);
    void note_braking(const PollData& poll, Instant now);
    ChipHomingEdge edge_here(const PollData& poll, Instant now);
    bool limit_ahead(const PollData& poll, SearchDirection search_direction) const;
    void enter(std::string_view name, const PollData& poll, Instant now);
    bool leave_by(HomingTransition cause, const PollData& poll, Instant now);
    void run(const PollData& poll, Instant now);
    void drive(const PollData& poll, Instant now);
    void wait_end(const PollData& poll, Instant now);
    void drive_reached(const PollData& poll, Instant now);
    bool is_edge_of_switch(const ChipHomingEdge& edge);
    bool stopped_early() const;
    void zero(const PollData& poll, Instant now);
    void fail(HomeFault fault, const PollData& poll, Instant now);
    void finish(const PollData& poll, Instant now);
    std::int64_t distance(const PollData& poll) const;
    std::int64_t run_up() const;
    Duration drive_time(std::int64_t pulses, std::int64_t v) const;
    double hertz(std::int64_t v) const;
    std::int64_t speed() const;
    std::uint16_t stop_inputs() const;
    // home_text.cpp
    std::string text(std::int64_t pulses) const;
    std::string place(std::int32_t lp) const;
    std::string switch_text() const;
    std::pair<std::string, std::string> input_failure(const std::string& how_far) const;
    std::string why_failed(const PollData& poll) const;

    Driver& driver_;
    int axis_;
    HomeSettings settings_;
    const HomeTable* table_ = nullptr;
    const HomeState* state_ = nullptr;
    HomeReport report_;
    SwitchEdges edges_;
    std::optional<EdgeConflict> conflict_;
    bool running_ = false;
    bool stop_asked_ = false;
    bool switch_on_ = false;                 ///< as last seen, or as the chip's stop shows
    bool edge_in_state_ = false;             ///< the edge that the state waits for was seen; later changes are bounce
    std::optional<ChipHomingEdge> braking_;  ///< first poll that showed a deceleration of the search
    bool at_speed_ = false;                  ///< V was reached in this drive
    bool turned_ = false;                    ///< the search has reversed at a limit
    bool again_ = false;                     ///< the search is repeated with a run-up
    Instant steady_since_{};
    Instant deadline_ = never;
    std::int32_t last_lp_ = 0;
    std::int32_t last_cv_ = 0;
    std::int64_t planned_ = 0;       ///< pulses of the present drive
    std::string_view failed_in_;     ///< state in which the homing failed
    std::int64_t failed_after_ = 0;  ///< pulses of the drive in that state
    std::uint16_t mode_before_[3] = {};
};

}  // namespace motionrack::mcx314
