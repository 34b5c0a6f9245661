// Real-time commands: single bytes that act immediately, at any position of a line.
#pragma once

#include <cstdint>
#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/grbl_state.hpp>
#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/grbl/override_state.hpp>
#include <motionrack/grbl/reports.hpp>
#include <motionrack/grbl/session_settings.hpp>
#include <motionrack/operate/machine.hpp>
#include <optional>

namespace motionrack::grbl {

/// Causes of a reset of the session: ^X, the door while the machine homes, or another command that includes a reset.
enum class ResetCause : std::uint8_t { requested, door, implicit };

class RealtimeCommands {
  public:
    /// Read and changed by the commands. All must outlive them.
    struct Targets {
        operate::Machine& machine;
        const SessionSettings& settings;
        GrblState& state;
        OverrideState& overrides;
        Reports& reports;
        Answers& answers;
    };
    explicit RealtimeCommands(const Targets& targets) : on_(targets) {}

    /// Executes a command. Returns a cause if the session must be reset now.
    [[nodiscard]] std::optional<ResetCause> act(Realtime what);

  private:
    bool is_jogging() const;
    std::optional<ResetCause> hold();
    std::optional<ResetCause> open_door();
    void resume();
    void stop_spindle();
    bool may_switch_coolant();
    void switch_coolant(bool mist, bool flood);
    bool control() { return take_control(on_.settings, on_.answers); }

    const Targets on_;
};

}  // namespace motionrack::grbl
