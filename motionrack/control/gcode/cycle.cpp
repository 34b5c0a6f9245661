// The moves of a drilling cycle.
#include <algorithm>
#include <motionrack/control/gcode/cycle.hpp>

namespace motionrack::control::gcode {

namespace {
/// A last peck thinner than this (mm) is no peck.
constexpr double thinnest_peck = 1e-9;
}  // namespace

void Cycle::begin(const CyclePlan& plan) {
    plan_ = plan;
    phase_ = Phase::lift;
    at_ = plan.from;
    level_ = plan.level;
    hole_ = 0;
}

void Cycle::straight(Move& move, MoveKind kind, double third) {
    at_[plan_.third] = third;
    move = plan_.pattern;
    move.kind = kind;
    move.end = at_;
}

bool Cycle::next(Move& move) {
    for (;;) {
        switch (phase_) {
            case Phase::lift:
                phase_ = Phase::over;
                if (level_ >= plan_.r) break;
                level_ = plan_.r;
                straight(move, MoveKind::traverse, plan_.r);
                at_[plan_.first] = plan_.pattern.end[plan_.first];
                at_[plan_.second] = plan_.pattern.end[plan_.second];
                return true;
            case Phase::over:
                if (hole_ == plan_.repeats) return false;
                ++hole_;
                at_[plan_.first] = plan_.pattern.end[plan_.first] + hole_ * plan_.step_first;
                at_[plan_.second] = plan_.pattern.end[plan_.second] + hole_ * plan_.step_second;
                phase_ = Phase::approach;
                straight(move, MoveKind::traverse, level_);
                return true;
            case Phase::approach:
                phase_ = Phase::work;
                pecks_ = 1;
                if (level_ == plan_.r) break;
                straight(move, MoveKind::traverse, plan_.r);
                return true;
            case Phase::work: {
                double depth = plan_.code == 830 ? plan_.r - pecks_ * plan_.peck : plan_.bottom;
                const bool last = depth <= plan_.bottom + thinnest_peck;
                if (last) depth = plan_.bottom;
                phase_ = !last ? Phase::back : plan_.code == 820 ? Phase::wait : Phase::leave;
                straight(move, MoveKind::feed, depth);
                return true;
            }
            case Phase::wait:
                phase_ = Phase::leave;
                straight(move, MoveKind::dwell, plan_.bottom);
                move.seconds = plan_.seconds;
                return true;
            case Phase::back:
                phase_ = Phase::again;
                straight(move, MoveKind::traverse, plan_.r);
                return true;
            case Phase::again: {
                phase_ = Phase::work;
                const double depth = plan_.r - pecks_ * plan_.peck;
                ++pecks_;
                straight(move, MoveKind::traverse, std::min(depth + plan_.clearance, plan_.r));
                return true;
            }
            case Phase::leave:
                phase_ = Phase::over;
                level_ = plan_.clear;
                straight(move, MoveKind::traverse, plan_.clear);
                return true;
        }
    }
}

}  // namespace motionrack::control::gcode
