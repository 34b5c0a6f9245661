// The automatic home search of an MCX314As: consecutive drives (map::home_drives), by the state table HomeSteps.
//
//   62h ─► step 1 ─► step 2 ────────────────► step 3 ─► step 4 ─► end
//           (3)       (8)     (12) ─► (15)     (20)      (25)             in brackets: HMST
//                      └─ IN1 or the limit ─┘
#include <iterator>
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

// ST1E, ST1D, ST2E, ..: enable and direction of each step are adjacent.
bool step_enabled(const Extension& ext, int step) {
    return (ext.em7 & em::ST1E.mask << 2 * (step - 1)) != 0;
}
/// Returns the direction of a step's drive: +1 or -1.
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

/// State table of the map's machine "home search", with its states in the same order. The rows of a state try the later
/// steps in turn and take the first that is enabled and has something to do.
struct ChipHomeSearch::HomeSteps {
    enum class State : std::uint8_t { idle, near, home, escape, again, index, offset };
    enum class Event : std::uint8_t { start, drive_ended };

    // ---- guards
    static const Extension& ext_of(const ChipHomeSearch& s, int a) { return s.state_.extension[a]; }
    static unsigned errors_of(const ChipHomeSearch& s, int a) { return s.state_.axis[a].finished & rr1::errors.mask; }
    static unsigned limit_of(const ChipHomeSearch& s, int a, int step) {
        return step_direction(ext_of(s, a), step) > 0 ? rr1::LMTP.mask : rr1::LMTM.mask;
    }
    static bool ended_by_limit(const ChipHomeSearch& s, int a, int step) {
        return errors_of(s, a) == limit_of(s, a, step);
    }
    static bool wants_near(const ChipHomeSearch& s, int a) {
        return step_enabled(ext_of(s, a), 1) && !home_input(s.state_, a, 1);
    }
    static bool wants_escape(const ChipHomeSearch& s, int a) {
        const Extension& ext = ext_of(s, a);
        return step_enabled(ext, 2) &&
               (home_input(s.state_, a, 2) || limit_active(s.state_.axis[a], step_direction(ext, 2)));
    }
    static bool wants_home(const ChipHomeSearch& s, int a) { return step_enabled(ext_of(s, a), 2); }
    static bool wants_index(const ChipHomeSearch& s, int a) {
        return step_enabled(ext_of(s, a), 3) && !home_input(s.state_, a, 3);
    }
    /// Returns true if step 3 is enabled; evaluated where wants_index() is false, so its input is active already.
    static bool misses_index(const ChipHomeSearch& s, int a) { return step_enabled(ext_of(s, a), 3); }
    static bool wants_offset(const ChipHomeSearch& s, int a) { return step_enabled(ext_of(s, a), 4); }

    /// Returns true if the search was cancelled, or the drive ended before the event that its step waits for.
    static bool failed(const ChipHomeSearch& s, int a) {
        const Extension& ext = ext_of(s, a);
        const map::HomeDrive& drive = map::home_drive(ext.home.hmst);
        if (ext.home.cancelled) return true;
        const bool tolerated = drive.step <= 2 && !drive.back && em::LIMIT.test(ext.em7);
        if (ext.home.hmst == 3 && ended_by_limit(s, a, 1) && step_enabled(ext, 2)) return false;
        if ((errors_of(s, a) & ~(tolerated ? limit_of(s, a, drive.step) : 0u)) != 0) return true;
        const Axis& axis = s.state_.axis[a];
        return drive.step == 4 ? axis.gen.n < axis.pulses : !ext.home.found;
    }
    static bool ran_into_limit(const ChipHomeSearch& s, int a) {
        const Extension& ext = ext_of(s, a);
        return !ext.home.cancelled && !em::LIMIT.test(ext.em7) && ended_by_limit(s, a, 2);
    }
    static bool owes_clear(const ChipHomeSearch& s, int a) { return !ext_of(s, a).home.cleared; }

    // ---- actions
    template <int hmst>
    static void drive(ChipHomeSearch& s, int a) {
        s.go(a, hmst);
    }
    template <int hmst>
    static void look_and_drive(ChipHomeSearch& s, int a) {
        s.state_.extension[a].home.seen = home_input(s.state_, a, 2);
        s.go(a, hmst);
    }
    static void finish(ChipHomeSearch& s, int a) { s.finish(a); }
    static void finish_with_error(ChipHomeSearch& s, int a) {
        s.state_.extension[a].home.error = true;
        s.finish(a);
    }
    static void finish_done(ChipHomeSearch& s, int a) {
        const Extension& ext = ext_of(s, a);
        if (!step_enabled(ext, 3)) s.ask_clear(a);
        if (em::PCLR.test(ext.em7)) {
            s.state_.axis[a].lp = 0;
            s.encoders_.set_position(a, 0);
            s.comparators_.compare(a);
            s.encoders_.watch(a);
        }
        s.finish(a);
    }
    /// Requests the clear pulse. If it is enabled, look() continues the search at its end; otherwise the search
    /// continues at once.
    static void clear(ChipHomeSearch& s, int a) {
        s.state_.extension[a].home.cleared = true;
        s.ask_clear(a);
        if (ext_of(s, a).clear_until <= s.state_.tick) run(s, Event::drive_ended, a);
    }

    // ---- the table
    using enum State;
    static constexpr StateRow<ChipHomeSearch, State, Event, int> rows[] = {
        {idle, Event::start, near, wants_near, drive<3>},
        {idle, Event::start, escape, wants_escape, look_and_drive<12>},
        {idle, Event::start, home, wants_home, look_and_drive<8>},
        {idle, Event::start, index, wants_index, drive<20>},
        {idle, Event::start, idle, misses_index, finish_with_error},
        {idle, Event::start, offset, wants_offset, drive<25>},
        {idle, Event::start, idle, nullptr, finish_done},

        {near, Event::drive_ended, idle, failed, finish},
        {near, Event::drive_ended, escape, wants_escape, look_and_drive<12>},
        {near, Event::drive_ended, home, wants_home, look_and_drive<8>},
        {near, Event::drive_ended, index, wants_index, drive<20>},
        {near, Event::drive_ended, idle, misses_index, finish_with_error},
        {near, Event::drive_ended, offset, wants_offset, drive<25>},
        {near, Event::drive_ended, idle, nullptr, finish_done},

        {home, Event::drive_ended, escape, ran_into_limit, look_and_drive<12>},
        {home, Event::drive_ended, idle, failed, finish},
        {home, Event::drive_ended, index, wants_index, drive<20>},
        {home, Event::drive_ended, idle, misses_index, finish_with_error},
        {home, Event::drive_ended, offset, wants_offset, drive<25>},
        {home, Event::drive_ended, idle, nullptr, finish_done},

        {escape, Event::drive_ended, idle, failed, finish},
        {escape, Event::drive_ended, again, nullptr, drive<15>},

        {again, Event::drive_ended, idle, failed, finish},
        {again, Event::drive_ended, index, wants_index, drive<20>},
        {again, Event::drive_ended, idle, misses_index, finish_with_error},
        {again, Event::drive_ended, offset, wants_offset, drive<25>},
        {again, Event::drive_ended, idle, nullptr, finish_done},

        {index, Event::drive_ended, idle, failed, finish},
        {index, Event::drive_ended, index, owes_clear, clear},
        {index, Event::drive_ended, offset, wants_offset, drive<25>},
        {index, Event::drive_ended, idle, nullptr, finish_done},

        {offset, Event::drive_ended, idle, failed, finish},
        {offset, Event::drive_ended, idle, nullptr, finish_done},
    };
    static_assert(declared<rows_flaw(machine_named(map::machines, "home search"), rows)>());

    /// Returns the state from HMST, which go() and finish() set.
    static State state_of(const ChipHomeSearch& s, int a) {
        for (std::size_t i = 0; i < std::size(map::home_drives); ++i)
            if (map::home_drives[i].hmst == ext_of(s, a).home.hmst) return static_cast<State>(i + 1);
        return idle;
    }
    static void run(ChipHomeSearch& s, Event event, int a) {
        step(rows, state_of(s, a), event, s, a, [](State) {});
    }
};

/// Executes command 62h: starts the home search of axis `a`, unless it is driving.
void ChipHomeSearch::start(int a) {
    if (state_.driving(a)) return kernel_.report(id_, drive_ignored, static_cast<std::int64_t>(cmd::HOME), a);
    state_.extension[a].home = {};
    state_.homing |= 1u << a;
    inputs_.set_wants(a);
    HomeSteps::run(*this, HomeSteps::Event::start, a);
}

void ChipHomeSearch::go(int a, int hmst) {
    Extension& ext = state_.extension[a];
    const map::HomeDrive& drive = map::home_drive(hmst);
    ext.home.hmst = hmst;
    ext.home.found = false;
    const int direction = step_direction(ext, drive.step) * (drive.back ? -1 : 1);
    drives_.start(a, drive_code(drive.step == 4 ? Drive::fixed : Drive::continuous, direction));
}

void ChipHomeSearch::finish(int a) {
    Extension& ext = state_.extension[a];
    state_.homing &= ~(1u << a);
    ext.home.hmst = 0;
    generators_.set_drive_speed(a);
    inputs_.set_wants(a);
    if (em::HMINT.test(ext.em6)) state_.axis[a].flags |= rr3::HMEND.mask;
}

/// Continues the searches whose drive has ended; called at the end of a tick.
void ChipHomeSearch::look() {
    for_each_axis(state_.homing, [&](int a) {
        const Extension& ext = state_.extension[a];
        if (state_.axis[a].gen.drive != Drive::idle) return;
        const bool clearing = ext.home.cleared && ext.clear_until > state_.tick;
        if ((bit(state_.in_place, a) || clearing) && !ext.home.cancelled) return;
        for_each_axis(state_.working, [&](int i) { forward_.bring_up(i, state_.tick); });
        HomeSteps::run(*this, HomeSteps::Event::drive_ended, a);
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
