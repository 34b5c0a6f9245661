// Faults at planned instants of a run: "X.limit_plus=0@0.5s" forces a wire, "X.encoder.broken_a@1s" injects a fault.
//
//   kernel ──on_scheduled, at its instant──► break_run ──► between runs: apply_due() ──► WireAccess, inject_fault
#pragma once

#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/scheduled_text.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// NAME[=VALUE]@TIME as the user writes it. NAME is a wire that can be forced (VALUE 0, 1 or release), or TARGET.FAULT
/// (see faults.hpp; the default VALUE is 1). TIME is a number with s, ms or us since the start of the rack.
struct ScheduledFault {
    std::string text;  ///< user's text
    Instant at{};
    std::string name;    ///< name of the wire, or of the fault with its value
    std::string target;  ///< target of the fault; empty: NAME is a wire
    double value = 1;    ///< value of the wire; NaN releases it
    bool done = false;
    std::string refused;  ///< reason for which the part rejected the value when the fault was due; empty: accepted
};

/// Parses texts of users; their names are checked later. Errors: invalid_input for a text without a time.
Result<std::vector<ScheduledText>> read_faults(const std::vector<std::string>& texts);

class FaultSchedule final : public sim::Device {
  public:
    /// Call before the rack starts. On failure nothing is planned. Errors: invalid_input and refused, for the first
    /// text that cannot be executed.
    static Result<std::unique_ptr<FaultSchedule>> create(Rack& rack, const std::vector<std::string>& texts);
    static Result<std::unique_ptr<FaultSchedule>> create_timed(Rack& rack, const std::vector<ScheduledText>& faults);

    /// Call after the rack has started.
    void begin();
    /// Applies the faults that are due. Call between runs, after every broken run.
    void apply_due();
    /// Sentences, by time, about faults that were not applied: the run ended before them, or the part rejected the
    /// value.
    std::vector<std::string> not_done() const;
    /// Takes over the progress of `other`, a schedule of the same texts whose rack's state was copied.
    void copy_from(const FaultSchedule& other);

    void on_scheduled(Instant now) override;

  private:
    explicit FaultSchedule(Rack& rack) : rack_(rack), context_(rack) {}
    Result<void> read_action(const std::string& text, std::string_view action, ScheduledFault& fault);

    Rack& rack_;
    WireAccess context_;
    sim::DeviceId id_{};
    std::vector<ScheduledFault> faults_;  // by time
};

}  // namespace motionrack::rack
