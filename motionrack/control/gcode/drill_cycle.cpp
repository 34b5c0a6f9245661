// Moves of a cycle: down to the bottom, then a list of acts for each code.
#include <algorithm>
#include <motionrack/control/gcode/drill_cycle.hpp>

namespace motionrack::control::gcode {

namespace {
/// A thinner last peck (mm) is skipped.
constexpr double thinnest_peck = 1e-9;
}  // namespace

std::span<const DrillCycleMoves::Act> DrillCycleMoves::acts_of(std::int16_t code) {
    static constexpr Act drills[] = {Act::rapid_clear};
    static constexpr Act waits[] = {Act::wait, Act::rapid_clear};
    static constexpr Act taps[] = {Act::stop, Act::turn_back, Act::wait, Act::feed_clear, Act::stop, Act::turn};
    static constexpr Act bores[] = {Act::feed_r, Act::rapid_clear};
    static constexpr Act stops[] = {Act::wait, Act::stop, Act::rapid_clear, Act::turn};
    static constexpr Act waits_and_bores[] = {Act::wait, Act::feed_clear};
    switch (code) {
        case 820:
            return waits;
        case 740:
        case 840:
            return taps;
        case 850:
            return bores;
        case 860:
            return stops;
        case 890:
            return waits_and_bores;
        default:
            return drills;
    }
}

void DrillCycleMoves::begin(const DrillCycle& plan) {
    plan_ = plan;
    phase_ = DrillPhase::lift;
    at_ = plan.from;
    level_ = plan.level;
    hole_ = 0;
}

void DrillCycleMoves::straight(CanonCall& step, MoveKind kind, double third) {
    at_[plan_.third] = third;
    step.kind = CanonCallKind::move;
    step.move = plan_.pattern;
    step.move.kind = kind;
    step.move.end = at_;
}

void DrillCycleMoves::spindle(CanonCall& step, Spindle how) const {
    step.kind = CanonCallKind::spindle;
    step.spindle = how;
    step.speed_rpm = plan_.speed_rpm;
}

void DrillCycleMoves::act(Act what, CanonCall& step) {
    const Spindle back = plan_.spindle == Spindle::clockwise ? Spindle::counter_clockwise : Spindle::clockwise;
    switch (what) {
        case Act::wait:
            straight(step, MoveKind::dwell, plan_.bottom);
            step.move.seconds = plan_.seconds;
            return;
        case Act::stop:
            return spindle(step, Spindle::off);
        case Act::turn_back:
            return spindle(step, back);
        case Act::turn:
            return spindle(step, plan_.spindle);
        case Act::feed_r:
            return straight(step, MoveKind::feed, plan_.r);
        case Act::feed_clear:
            return straight(step, MoveKind::feed, plan_.clear);
        case Act::rapid_clear:
            return straight(step, MoveKind::rapid, plan_.clear);
    }
}

bool DrillCycleMoves::next(CanonCall& step) {
    for (;;) {
        switch (phase_) {
            case DrillPhase::lift:
                phase_ = DrillPhase::over;
                if (level_ >= plan_.r) break;
                level_ = plan_.r;
                straight(step, MoveKind::rapid, plan_.r);
                at_[plan_.first] = plan_.pattern.end[plan_.first];
                at_[plan_.second] = plan_.pattern.end[plan_.second];
                return true;
            case DrillPhase::over:
                if (hole_ == plan_.repeats) return false;
                ++hole_;
                at_[plan_.first] = plan_.pattern.end[plan_.first] + hole_ * plan_.step_first;
                at_[plan_.second] = plan_.pattern.end[plan_.second] + hole_ * plan_.step_second;
                phase_ = DrillPhase::approach;
                straight(step, MoveKind::rapid, level_);
                return true;
            case DrillPhase::approach:
                phase_ = DrillPhase::work;
                pecks_ = 1;
                if (level_ == plan_.r) break;
                straight(step, MoveKind::rapid, plan_.r);
                return true;
            case DrillPhase::work: {
                double depth = is_pecking(plan_.code) ? plan_.r - pecks_ * plan_.peck : plan_.bottom;
                const bool last = depth <= plan_.bottom + thinnest_peck;
                if (last) depth = plan_.bottom;
                phase_ = last ? DrillPhase::leave : plan_.code == 730 ? DrillPhase::again : DrillPhase::back;
                acts_ = 0;
                straight(step, MoveKind::feed, depth);
                return true;
            }
            case DrillPhase::back:
                phase_ = DrillPhase::again;
                straight(step, MoveKind::rapid, plan_.r);
                return true;
            case DrillPhase::again: {
                phase_ = DrillPhase::work;
                const double depth = plan_.r - pecks_ * plan_.peck;
                ++pecks_;
                straight(step, MoveKind::rapid, std::min(depth + plan_.clearance, plan_.r));
                return true;
            }
            case DrillPhase::leave: {
                const std::span<const Act> acts = acts_of(plan_.code);
                act(acts[acts_++], step);
                if (acts_ < acts.size()) return true;
                phase_ = DrillPhase::over;
                level_ = plan_.clear;
                return true;
            }
        }
    }
}

}  // namespace motionrack::control::gcode
