// Runs a marking job on the virtual card in a simulated machine, with its correction and without, and says what is on the part.
#pragma once

#include <functional>
#include <motionrack/mark/overflow.hpp>
#include <motionrack/mark/plan.hpp>
#include <motionrack/sim/parts/workpiece.hpp>

namespace motionrack::mark {

/// Where the card's output had the spot at an instant, and the part of the time since the last one that its gate was open.
struct FieldSample {
    double at_s = 0;
    Spot at;  ///< mm in the field, of mirrors without delay
    double gate = 0;
};
inline constexpr std::int64_t most_field_samples = 10'000;

/// One run.
struct Marked {
    parts::Deviation deviation;
    std::vector<parts::MarkedPoint> points;
    std::uint64_t lost_points = 0;
    double seconds = 0;       ///< until the card rests
    double duty = 0;          ///< part of it with the gate open
    double marked_mm = 0, energy_j = 0;
    Box reach;  ///< mm in the field: how far the list went with its correction, were there no edge
    std::vector<FieldSample> course;  ///< in even steps, about most_field_samples
    std::vector<Overflow> overflows;    ///< every stretch in which the corrected position was outside the field, in the order of their ends
    std::uint64_t lost_overflows = 0;   ///< more than OverflowLog::most
};

struct Outcome {
    Marked on;                    ///< as the job says
    std::optional<Marked> off;    ///< the same without correction; none if the job has none
    double drawing_mm = 0;
    std::size_t strokes = 0, elements = 0;
    bool drawing_in_field = true;  ///< without the part's movement
    /// How many times its speed the part may have until the corrected position leaves the field; none without correction
    /// or movement. 0: the drawing does not fit even at rest.
    std::optional<double> fits_factor;
    bool fits_any = false;  ///< it fits at any speed that was tried (1000 times)
    Box field;              ///< mm
    std::vector<std::string> notes;
};

struct Watch {
    std::function<void(double part)> progress;  ///< 0 .. 1
    std::function<bool()> stop;                 ///< true: give up
};

inline constexpr double greatest_seconds = 1000;  ///< of virtual time

/// Errors: as list_of; refused: a list that is too long, a job that takes more than greatest_seconds; stopped.
Result<Outcome> run_job(const Job& job, const Prepared& prepared, const Watch& watch = {});

}  // namespace motionrack::mark
