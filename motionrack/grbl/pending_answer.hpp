// Deferred answer to a line: sent when the machine has executed it.
#pragma once

#include <cstdint>
#include <motionrack/grbl/answers.hpp>
#include <optional>
#include <string_view>

namespace motionrack::grbl {

/// Action of the machine that ends before the line is answered.
enum class PendingAction : std::uint8_t { moving, leaving_travel, homing, unlocking };

class PendingAnswer {
  public:
    /// The answers must outlive this.
    explicit PendingAnswer(Answers& answers) : answers_(answers) {}

    bool exists() const { return line_.has_value(); }
    bool waits_for(PendingAction action) const { return line_ && line_->action == action; }
    void begin(PendingAction action, bool program_ends = false);
    /// Suppresses the answer, because the connection of its line has closed.
    void silence();

    // These require a pending answer.
    PendingAction action() const { return line_->action; }
    bool program_ends() const { return line_->program_ends; }
    /// Returns true on the first call for a line: axis positions have to be made valid now.
    bool begins_validation();
    /// Sends a message, unless the answer is suppressed.
    void push(std::string_view text);
    /// Sends the answer, unless it is suppressed.
    void finish(int error);

  private:
    struct PendingLine {
        PendingAction action;
        bool program_ends;
        bool silent = false;     ///< its connection has closed
        bool validated = false;  ///< begins_validation() has returned true (unlocking, homing)
    };

    Answers& answers_;
    std::optional<PendingLine> line_;
};

}  // namespace motionrack::grbl
