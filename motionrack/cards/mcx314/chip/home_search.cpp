// The automatic home search of an MCX314As: consecutive drives, by the table map::home_drives.
//
//   62h ─► step 1 ─► step 2 ────────────────► step 3 ─► step 4 ─► end
//           (3)       (8)     (12) ─► (15)     (20)      (25)             in brackets: HMST
//                      └─ IN1 or the limit ─┘
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>

namespace motionrack::mcx314 {

namespace {

// ST1E, ST1D, ST2E, ..: enable and direction of each step are adjacent.
bool step_enabled(const Extension& ext, int step) {
    return (ext.em7 & em::ST1E.mask << 2 * (step - 1)) != 0;
}
/// +1 or -1.
int step_direction(const Extension& ext, int step) {
    return (ext.em7 & em::ST1D.mask << 2 * (step - 1)) != 0 ? -1 : 1;
}

}  // namespace

bool home_input(const State& state, int a, int step) {
    const Extension& ext = state.extension[a];
    const Axis& axis = state.axis[a];
    if (step == 3) return input_active(axis, 2) && (!em::SAND.test(ext.em7) || input_active(axis, 1));
    if (em::LIMIT.test(ext.em7)) return limit_active(axis, step_direction(ext, step));
    return input_active(axis, step - 1);
}

bool home_found(State& state, int a) {
    HomingSequence& home = state.extension[a].home;
    const map::HomeDrive& drive = map::home_drive(home.hmst);
    if (drive.step == 4) return false;
    const bool active = home_input(state, a, drive.step);
    if (!drive.back) home.found = home.found || active;
    if (drive.back && active) home.seen = true;
    if (drive.back && !active && home.seen) home.found = true;
    return drive.back ? !active && home.seen : active;
}

/// 62h.
void ChipHomeSearch::start(int a) {
    if (state_.driving(a)) return kernel_.report(id_, drive_ignored, static_cast<std::int64_t>(cmd::HOME), a);
    state_.extension[a].home = {};
    state_.homing |= 1u << a;
    inputs_.set_wants(a);
    if (!next_step(a, 1)) finish(a);
}

/// Starts the drive of a state.
void ChipHomeSearch::go(int a, int hmst) {
    Extension& ext = state_.extension[a];
    const map::HomeDrive& drive = map::home_drive(hmst);
    ext.home.hmst = hmst;
    ext.home.found = false;
    const int direction = step_direction(ext, drive.step) * (drive.back ? -1 : 1);
    drives_.start(a, drive_code(drive.step == 4 ? Drive::fixed : Drive::continuous, direction));
}

/// Starts the first enabled step from `step` on; returns false if there is none, or on an error.
bool ChipHomeSearch::next_step(int a, int step) {
    Extension& ext = state_.extension[a];
    HomingSequence& home = ext.home;
    if (step <= 1 && step_enabled(ext, 1) && !home_input(state_, a, 1)) return go(a, 3), true;
    if (step <= 2 && step_enabled(ext, 2)) {
        home.seen = home_input(state_, a, 2);
        const bool at_limit = limit_active(state_.axis[a], step_direction(ext, 2));
        return go(a, home.seen || at_limit ? 12 : 8), true;
    }
    if (step <= 3 && step_enabled(ext, 3)) {
        if (!home_input(state_, a, 3)) return go(a, 20), true;
        home.error = true;
        return false;
    }
    if (step <= 4 && step_enabled(ext, 4)) return go(a, 25), true;
    if (!step_enabled(ext, 3)) ask_clear(a);
    if (em::PCLR.test(ext.em7)) {
        state_.axis[a].lp = 0;
        encoders_.set_position(a, 0);
        comparators_.compare(a);
        encoders_.watch(a);
    }
    return false;
}

void ChipHomeSearch::finish(int a) {
    Extension& ext = state_.extension[a];
    state_.homing &= ~(1u << a);
    ext.home.hmst = 0;
    generators_.set_drive_speed(a);
    inputs_.set_wants(a);
    if (em::HMINT.test(ext.em6)) state_.axis[a].flags |= rr3::HMEND.mask;
}

/// Continues after the drive of a step.
void ChipHomeSearch::end_drive(int a) {
    Extension& ext = state_.extension[a];
    HomingSequence& home = ext.home;
    const Axis& axis = state_.axis[a];
    const map::HomeDrive& drive = map::home_drive(home.hmst);
    if (home.cancelled) return finish(a);
    const unsigned errors = axis.finished & rr1::errors.mask;
    const unsigned own_limit = step_direction(ext, drive.step) > 0 ? rr1::LMTP.mask : rr1::LMTM.mask;
    const bool limit_is_home = em::LIMIT.test(ext.em7);
    if (home.hmst == 8 && !limit_is_home && errors == own_limit) {
        home.seen = home_input(state_, a, 2);
        return go(a, 12);
    }
    const bool tolerated = drive.step <= 2 && !drive.back && limit_is_home;
    const bool sound = (errors & ~(tolerated ? own_limit : 0u)) == 0;
    bool reached = drive.step == 4 ? axis.gen.n >= axis.pulses : home.found;
    if (home.hmst == 3 && errors == own_limit && step_enabled(ext, 2))
        reached = true;
    else if (!sound)
        reached = false;
    if (!reached) return finish(a);
    if (home.hmst == 12) return go(a, 15);
    if (drive.step == 3 && !home.cleared) {
        home.cleared = true;
        ask_clear(a);
        if (ext.clear_until > state_.tick) return;
    }
    if (!next_step(a, drive.step + 1)) finish(a);
}

/// At the end of a tick: continues searches whose drive has ended.
void ChipHomeSearch::look() {
    for_each_axis(state_.homing, [&](int a) {
        const Extension& ext = state_.extension[a];
        if (state_.axis[a].gen.drive != Drive::idle) return;
        const bool clearing = ext.home.cleared && ext.clear_until > state_.tick;
        if ((bit(state_.in_place, a) || clearing) && !ext.home.cancelled) return;
        for_each_axis(state_.working, [&](int i) { forward_.bring_up(i, state_.tick); });
        end_drive(a);
        requests_.make_stale();
    });
}

void ChipHomeSearch::ask_clear(int a) {
    Extension& ext = state_.extension[a];
    if (!em::DCCE.test(ext.em7)) return;
    ext.clear_until = state_.tick + map::clear_ticks[em::DCCW.get(ext.em7)];
    requests_.sample_at(ext.clear_until);
}

}  // namespace motionrack::mcx314
