// One Grbl port: receives bytes from a sender, returns bytes, and moves an operate::Machine.
//
//   bytes ─┬─ real-time ones ─► RealtimeCommands, immediately: hold, resume, stop, overrides
//          └─ lines ─► LineReader ─► one at a time ─┬─ $ ─────► SystemCommands, SenderSettings
//                                                   └─ G-code ► GcodeLines ─► Machine::line
//   GrblState, OverrideState ─► Reports: "<Idle|MPos:..>"
//   PendingAnswer ─► Answers: for each line one "ok" or "error:N"
//
//   no line is accepted during a hold, a stop, a homing or a limit alarm; then bytes wait, 128 of them
//
// Runs on the motion thread: receive() as posted work, tick() once per slice. Uses no network, never waits, and does
// not access cards.
#pragma once

#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/gcode_lines.hpp>
#include <motionrack/grbl/grbl_state.hpp>
#include <motionrack/grbl/line_reader.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <motionrack/grbl/override_state.hpp>
#include <motionrack/grbl/pending_answer.hpp>
#include <motionrack/grbl/realtime_commands.hpp>
#include <motionrack/grbl/reports.hpp>
#include <motionrack/grbl/sender_settings.hpp>
#include <motionrack/grbl/session_settings.hpp>
#include <motionrack/grbl/system_commands.hpp>
#include <motionrack/operate/machine.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::grbl {

class GrblSession {
  public:
    /// The first line that moves the machine enables it if it was never enabled, since Grbl has no such state. The
    /// machine must outlive this.
    GrblSession(operate::Machine& machine, SessionSettings settings);
    GrblSession(const GrblSession&) = delete;
    GrblSession& operator=(const GrblSession&) = delete;

    /// Handles a new connection: drops pending data of the previous one and sends the banner. The machine continues.
    void greet();
    void receive(std::string_view bytes);
    /// Receives bytes from an observer: serves reports, holds and ends of jogs, and resets if the settings permit;
    /// discards everything else.
    void observe(std::string_view bytes);
    /// Handles a stop or reset by another client: rejects the sender's lines until it unlocks or resets, since they
    /// were meant to follow the dropped lines, or rely on modes that were cleared. Called within the command.
    void stopped(const operate::StopReport& report);
    /// Handles the loss of control to the client `to`: rejects lines like stopped(), if lines were pending or the
    /// machine was active.
    void lose_control(const std::string& to);
    /// Call every slice: processes pending lines, due answers and alarms.
    void tick();
    /// Returns the pending output, whole lines, and clears it.
    std::string take_output() { return answers_.take(); }

    State state() const { return state_.now(); }
    const SessionSettingValues& own() const { return sender_settings_.values(); }

  private:
    /// Pending part of the banner.
    enum class Boot : std::uint8_t { done, greeting, reset };

    void act(Realtime what);
    void work();
    bool must_wait(const Line& line);
    void carry_out(const std::string& text);
    int command(const std::string& text);
    int gcode(const std::string& text);
    control::gcode::Outcome<void> give(const std::string& text, std::int32_t n_word);
    int refused(const control::gcode::Problem& problem);
    void watch_machine();
    void lock(std::string_view why);
    void reset(ResetCause cause);
    void begin_again(bool after_reset);
    bool finish();
    bool finish_refused_reset();
    bool finish_homing();
    void finish_boot();
    void startup();
    void alarm(int number, bool needs_reset);

    operate::Machine& machine_;
    SessionSettings settings_;
    Answers answers_;
    PendingAnswer pending_{answers_};
    LineReader reader_;
    GcodeLines gcode_;
    SenderSettings sender_settings_;
    GrblState state_;
    OverrideState overrides_;
    Reports reports_;
    RealtimeCommands realtime_;
    SystemCommands commands_;
    Boot boot_ = Boot::done;
    bool relies_on_modes_ = false;  ///< a line of this sender was accepted since its last reset, greeting or lock
};

}  // namespace motionrack::grbl
