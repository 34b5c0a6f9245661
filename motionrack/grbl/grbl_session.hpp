// One Grbl port: bytes of a sender in, bytes for it out, motion by an operate::Machine.
//
//   bytes ─┬─ real-time ones ──► at once: hold, resume, stop, overrides, "<Idle|MPos:..>"
//          └─ lines ─► InputParser ─► one at a time ─┬─ $ commands ──► answers
//                                               └─ G-code, $J= ─► Machine::line, jog_to
//   each line: one "ok" or "error:N"
//
//   no line is taken while a hold, a stop, a homing or the alarm of a limit lasts; then bytes wait, 128 of them
//
// Runs on the motion thread: receive() among what is posted, tick() once a slice. No network, no waiting, no access to
// cards.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <motionrack/grbl/settings.hpp>
#include <motionrack/operate/machine.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::grbl {

struct SessionSettings {
    int axes = 3;  ///< 3: X Y Z; 4: A too, as grblHAL reports it
    /// Good: this sender may move the machine at present. Empty: always.
    std::function<Result<void>()> take_control = {};
    /// Good: a reset of this sender may stop what the machine does at present. Empty: always.
    std::function<Result<void>()> may_stop = {};
    /// Who this sender is, for those who hear of its reset.
    std::function<operate::StopOrigin()> source = {};
    bool onlookers_reset = false;  ///< resets of those who look on are this sender's
    /// A setting was changed, as a sentence.
    std::function<void(const std::string&)> on_setting = {};
};

/// As senders see the machine.
enum class State : std::uint8_t { idle, run, hold, jog, alarm, door, check, home, sleep };

class GrblSession {
  public:
    static constexpr std::size_t planner_blocks = 15;  ///< that a sender can fill

    /// A machine that nobody has enabled is enabled by the first line that moves it: a Grbl has no such state. The
    /// machine must outlive this.
    GrblSession(operate::Machine& machine, SessionSettings settings);

    /// Somebody has connected: what was left of the one before is forgotten, the machine goes on. Sends the banner.
    void greet();
    void receive(std::string_view bytes);
    /// From one who may only look on: reports, holds and ends of jogs are served, resets where the settings say so; all
    /// else is thrown away.
    void observe(std::string_view bytes);
    /// Somebody has stopped or reset the machine: lines of the sender are refused until it unlocks or resets, for they
    /// were meant to be driven behind what was dropped. At once, within the order.
    void stopped(const operate::StopReport& report);
    /// Another has taken control: the same, if the sender was at work.
    void lose_control(const std::string& to);
    /// Every slice: lines that had to wait, answers that are due, alarms.
    void tick();
    /// What is to be sent, whole lines; empties it.
    std::string take_output() { return std::exchange(out_, {}); }

    State state() const;
    const SessionSettingValues& own() const { return own_; }

    /// Percent.
    struct Overrides {
        int feed = 100, rapid = 100, spindle = 100;
        friend bool operator==(const Overrides&, const Overrides&) = default;
    };
    Overrides overrides() const;

  private:
    /// A line that was carried out, and whose answer waits.
    struct Doing {
        enum class What : std::uint8_t { moving, leaving_travel, homing, unlocking } what = What::moving;
        bool silent = false;  ///< the one who asked has gone
        bool program_ends = false;
        bool declared = false;  ///< unlocking: the positions; homing: those of the axes without a switch
    };
    /// Which part of the banner is due.
    enum class Boot : std::uint8_t { done, greeting, reset };

    // session.cpp: lines
    void work();
    bool settled() const;
    bool has_room() const;
    bool must_wait(const Line& line);
    void carry_out(const std::string& text);
    int gcode(const std::string& text);
    control::gcode::Outcome<void> give(const std::string& text, std::int32_t n_word);
    int refused(const control::gcode::Problem& problem);
    bool control();
    void lock(std::string_view why);
    bool finish();
    void finish_answer(int error);
    void end_program();
    void finish_boot();
    void startup();
    void answer(int error);
    void say(std::string_view text);
    void put(std::string_view text) { out_ += text; }
    void alarm(int number, bool needs_reset);
    // commands.cpp
    int command(const std::string& text);
    int command_at_rest(const std::string& text);
    int store(std::string_view text);
    int store_startup_line(std::string_view text);
    int restore(const std::string& text);
    int check_mode();
    int unlock();
    void declare_positions();
    int home();
    bool finish_homing();
    int number_of_homing() const;
    int jog(const std::string& text);
    // realtime.cpp
    void act(Realtime what);
    bool may_switch_coolant();
    void switch_coolant(bool mist, bool flood);
    void override_by(Realtime what);
    void hold();
    void open_door();
    void resume();
    void reset(bool is_asked_for = false);
    void begin_again(bool after_reset);
    void watch_machine();
    bool locked() const;
    void energise();
    // report.cpp
    void report();
    std::string state_text(State now) const;
    std::string values(const control::Point& point) const;
    std::string counted_reports(State now);
    std::string pins() const;
    std::string accessories() const;
    std::string modes_text() const;
    std::string parameters_text() const;
    std::string probe_text() const;
    double spindle_rpm() const;
    const control::gcode::Interpreter& interpreter() const {
        return check_ ? *check_ : machine_.stream().interpreter();
    }

    operate::Machine& machine_;
    SessionSettings settings_;
    SessionSettingValues own_;
    std::array<std::string, 2> startup_lines_;
    std::string build_text_, out_;
    InputParser intake_;
    std::optional<Line> line_;  ///< the next one, which has to wait
    std::optional<Doing> doing_;
    std::optional<control::gcode::Interpreter> check_;  ///< check mode
    std::int32_t line_number_ = 0;
    std::deque<std::pair<std::int32_t, std::int32_t>> n_words_;  ///< of lines that may be driven yet
    Boot boot_ = Boot::done;
    int homing_alarm_ = alarm_homing_reset;  ///< of a homing that is broken off
    bool alarm_ = false;                     ///< until it is unlocked or homed
    bool critical_ = false;                  ///< until a reset
    bool stopped_ = false;                   ///< by somebody else, until it is unlocked or reset
    bool resets_ = false;                    ///< the stop that is told is its own
    bool never_enabled_ = false;             ///< the machine, by anybody
    bool held_ = false, door_ = false, asleep_ = false;
    bool hold_seen_ = false;        ///< the machine has come to its hold
    bool jogging_ = false;          ///< the machine jogs, or brakes after it
    bool stop_told_ = false;        ///< the machine's present error stop
    std::int64_t probes_told_ = 0;  ///< see control::ProbeReport::count
    bool was_g80_ = false;          ///< no motion mode because a line said so
    bool status_wanted_ = false;
    bool spindle_stopped_ = false;
    int spindle_override_ = 100;
    int until_offset_ = 0, until_overrides_ = 0;  ///< reports
    control::Point told_offset_ = {};
    Overrides told_overrides_;
    std::string told_accessories_;
};

}  // namespace motionrack::grbl
