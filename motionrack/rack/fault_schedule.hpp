// Faults at planned instants of a run: "X.limit_plus=0@0.5s" drives a wire, "X.encoder.broken_a@1s" breaks a part.
//
//   kernel ──act at the planned instant──► break_run ──► between runs: apply_due() ──► WireAccess, inject_fault
#pragma once

#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/scheduled_text.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// NAME[=VALUE]@TIME as a user writes it. NAME is a wire that can be driven (VALUE 0, 1 or release), or TARGET.FAULT
/// (see faults.hpp; without a VALUE 1). TIME is since the rack was started: a number with s, ms or us.
struct ScheduledFault {
    std::string text;  ///< what the user wrote
    Instant at{};
    std::string name;    ///< of the wire; of the fault with its value
    std::string target;  ///< of the fault; empty: it is a wire
    double value = 1;    ///< of the wire; NaN releases it
    bool done = false;
    std::string refused;  ///< why it could not be done when its time had come: the part cannot have that value
};

/// Takes texts as users write them apart; what they name is looked at later. Errors: invalid_input, one without its
/// time.
Result<std::vector<ScheduledText>> read_faults(const std::vector<std::string>& texts);

class FaultSchedule final : public sim::Device {
  public:
    /// Before the rack is started; nothing is planned if it fails. Errors: invalid_input and refused, for the first
    /// text that cannot be obeyed.
    static Result<std::unique_ptr<FaultSchedule>> create(Rack& rack, const std::vector<std::string>& texts);
    static Result<std::unique_ptr<FaultSchedule>> create_timed(Rack& rack, const std::vector<ScheduledText>& faults);

    /// After the rack was started.
    void begin();
    /// Between runs, whenever one was broken: does what is due.
    void apply_due();
    /// Sentences about what was not done: the run ended before it, or the part refused it; in the order of time.
    std::vector<std::string> not_done() const;
    /// What was done is what `other` has done, a plan of the same texts whose rack's state was copied.
    void copy_from(const FaultSchedule& other);

    void on_scheduled(Instant now) override;

  private:
    explicit FaultSchedule(Rack& rack) : rack_(rack), desk_(rack) {}
    Result<void> read_action(const std::string& text, std::string_view action, ScheduledFault& fault);

    Rack& rack_;
    WireAccess desk_;
    sim::DeviceId id_{};
    std::vector<ScheduledFault> faults_;  // in the order of time
};

}  // namespace motionrack::rack
