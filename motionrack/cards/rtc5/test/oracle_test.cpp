// Compares the card, which works in blocks and spans, with its slow twin: random jobs must give the same result.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more jobs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/cards/rtc5/test/job.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>
#include <ostream>
#include <string>
#include <tests/oracle/harness.hpp>
#include <tuple>

namespace motionrack::rtc5 {

namespace twin {
/// For messages of failed tests.
void PrintTo(const Sample& s, std::ostream* out) {
    *out << fmt::format("({}, {}, B {}, {}, laser {}, outside {})", s.x, s.y, s.x_b, s.y_b, s.laser, s.outside);
}
}  // namespace twin

namespace {

constexpr std::int64_t memory = 1700, list1 = 800, list2 = 800;

std::int32_t counted(const Job& job, int encoder, std::int64_t tick) {
    const double t = static_cast<double>(tick);
    return static_cast<std::int32_t>(job.rate[encoder] * t +
                                     40 * (static_cast<double>(tick % 700) / 700 < 0.5 ? 1 : 0));
}
std::uint32_t word_of(const Job& job, std::int64_t tick) {
    return static_cast<std::uint32_t>(tick / job.word_every * 2654435761u);
}

class JobInputs final : public Inputs {
  public:
    explicit JobInputs(const Job& job) : job_(job) {}
    void counts(int encoder, std::int64_t first, std::span<std::int32_t> out) override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = counted(job_, encoder, first + static_cast<std::int64_t>(i));
    }
    bool words(std::int64_t first, std::span<std::uint32_t> out) override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = word_of(job_, first + static_cast<std::int64_t>(i));
        return true;
    }

  private:
    const Job& job_;
};

class Keeper final : public Sink {
  public:
    void samples(const Samples& b) override {
        gaps += b.first != first + static_cast<std::int64_t>(got.size());
        for (std::size_t i = 0; i < b.x.size(); ++i)
            got.push_back({b.x[i], b.y[i], b.x_b.empty() ? 0 : b.x_b[i], b.y_b.empty() ? 0 : b.y_b[i], b.laser[i],
                           outside(b, i)});
    }
    static unsigned outside(const Samples& b, std::size_t i) {
        if (b.corrected_x.empty()) return 0;
        const double x = b.corrected_x[i], y = b.corrected_y[i];
        return (x < min_field ? 1u : 0) | (x > max_field ? 2u : 0) | (y < min_field ? 4u : 0) |
               (y > max_field ? 8u : 0);
    }
    std::int64_t first = 0;
    int gaps = 0;
    std::vector<twin::Sample> got;
};

const CorrectionFile& lens_file() {
    static const CorrectionFile file = *correction_of({});
    return file;
}
const FlyTable& fly_table() {
    static const FlyTable table =
        *FlyTable::read("[Fly2DTable3]\n0 0 0 0\n1000 0 30 -4\n0 2000 -7 9\n1000 2000 11 60\n", 3, "t");
    return table;
}

/// Runs a job on the card and on its twin and compares them.
class Pair {
  public:
    Pair(const Job& job, oracle::Comparison& both)
        : job_(job), both_(both), card_({memory, list1, list2}), twin_(memory, list1, list2), inputs_(job) {
        table_ = table_of(lens_file());
        load();
        if (job.inputs) card_.set_inputs(&inputs_);
    }

    /// Runs the job's acts; stops at the first one after which card and twin differ.
    void run() {
        for (std::size_t i = 0; i < job_.acts.size() && both_.equal(); ++i) {
            act(job_.acts[i]);
            compare();
            if (!both_.equal()) both_.note(fmt::format("after act {} at tick {}{}", i, card_.tick(), where()));
        }
    }

  private:
    void load() {
        for (int list = 1; list <= 2; ++list) {
            static_cast<void>(card_.set_start_list(list));
            for (const Command& c : list == 1 ? job_.list1 : job_.list2)
                if (!card_.put(c)) break;
        }
        for (std::uint32_t i = 0; i < job_.subroutines.size(); ++i) {
            static_cast<void>(card_.parts().lists.load_sub(i));
            for (const Command& c : job_.subroutines[i]) static_cast<void>(card_.put(c));
            static_cast<void>(card_.put(*list_command(Op::list_return, {})));
        }
        std::copy_n(card_.state().lists.subroutines.begin(), 1024, twin_.subroutines);
        std::copy(card_.parts().lists.commands().begin(), card_.parts().lists.commands().end(), twin_.memory.begin());
    }

    twin::Sample twin_tick() {
        if (job_.inputs) {
            for (int e = 0; e < 2; ++e) twin_.encoders[e].input = counted(job_, e, twin_.now);
            twin_.words.assign(1, word_of(job_, twin_.now));
        }
        return twin_.tick();
    }

    void run_ticks(std::int64_t n, bool looked_at) {
        Keeper keeper;
        keeper.first = card_.tick();
        card_.run_until(card_.tick() + n, looked_at ? &keeper : nullptr);
        both_.same("gaps between samples", 0, keeper.gaps);
        if (looked_at) both_.same("samples", static_cast<std::size_t>(n), keeper.got.size());
        for (std::int64_t i = 0; i < n && both_.equal(); ++i) {
            last_ = twin_tick();
            if (looked_at && keeper.got[static_cast<std::size_t>(i)] != last_)
                both_.same(fmt::format("tick {}", twin_.now - 1), last_, keeper.got[static_cast<std::size_t>(i)]);
        }
        ran_ = ran_ || n > 0;
    }

    void act(const Act& a) {
        if (a.kind == Act::run) return run_ticks(a.a, a.b != 0);
        act_on_lists(a, card_, twin_);
        act_on_inputs(a, card_, twin_);
        act_on_pipeline(a, card_, twin_);
        act_on_words(a, card_, twin_);
    }

    static void act_on_lists(const Act& a, Engine& c, twin::Twin& t) {
        const std::int64_t position = a.a % 2 ? list1 : 0;
        const double x = std::floor(a.v[0] * 9e4);
        if (a.kind == Act::execute) static_cast<void>(c.parts().execution.execute_at(position)), t.execute(position);
        if (a.kind == Act::change) c.parts().execution.auto_change(), t.auto_change = true;
        if (a.kind == Act::loop) c.parts().execution.start_loop(), t.loop = true;
        if (a.kind == Act::quit_loop) c.parts().execution.quit_loop(), t.loop = false;
        if (a.kind == Act::stop) c.stop_execution(), t.stop();
        if (a.kind == Act::pause) c.pause_list(), t.pause();
        if (a.kind == Act::restart) c.restart_list(), t.restart();
        if (a.kind == Act::alone) static_cast<void>(c.goto_xy(x, 5)), t.jump_alone({x, 5});
        if (a.kind == Act::start) c.parts().starts.trigger(), ++t.triggers;
        if (a.kind == Act::laser && a.b) c.parts().laser.enable(), t.laser_disabled = false;
        if (a.kind == Act::laser && !a.b) c.parts().laser.disable(), t.disable_laser();
    }

    static void act_on_inputs(const Act& a, Engine& c, twin::Twin& t) {
        const auto pick = [&](std::int64_t n) { return static_cast<int>(a.a % n); };
        if (a.kind == Act::count) {
            const int e = pick(2);
            t.encoders[e].input += static_cast<std::int32_t>(a.v[1] * 3000);
            c.parts().encoders.set_count(e, t.encoders[e].input);
        }
        if (a.kind == Act::simulate) {
            static_cast<void>(c.parts().encoders.simulate(pick(4)));
            for (int e = 0; e < 2; ++e) t.encoders[e].simulated = pick(4) >> e & 1;
        }
        if (a.kind == Act::tracking) {
            t.tracking[0] = pick(4) * 7, t.tracking[1] = pick(3);
            c.parts().encoders.set_tracking_error(static_cast<std::uint16_t>(pick(4) * 7),
                                                  static_cast<std::uint16_t>(pick(3)));
        }
        if (a.kind == Act::control) {
            t.control = (pick(5) ? 1u : 0u) | (pick(3) ? 0u : 512u) | (pick(7) > 3 ? 1024u : 0u);
            c.set_control_mode(t.control);
        }
        if (a.kind == Act::start_delay) {
            t.start_delay = pick(4) ? pick(2000) - 200 : 0, t.start_encoder = static_cast<int>(a.b);
            t.start_position = pick(2) ? list1 : 0;
            static_cast<void>(c.set_ext_start_delay(static_cast<std::int32_t>(t.start_delay), t.start_encoder));
            c.parts().starts.set_position(t.start_position);
        }
        if (a.kind == Act::watch) {
            static_cast<void>(c.parts().encoders.watch_speed(2, 200, 0.3));
            t.watch_speed = true, t.smooth = 0.3;
            for (auto& e : t.encoders) e.slow1 = e.slow2 = 0;
        }
    }

    void act_on_pipeline(const Act& a, Engine& c, twin::Twin& t) const {
        const auto pick = [&](std::int64_t n) { return a.a % n; };
        const int head = static_cast<int>(pick(4)) + 1, once = static_cast<int>(pick(9)) % 4;
        const double x = a.v[0] * 1e4, y = a.v[1] * 1e4, degrees = a.v[0] * 90, scale = 1 + a.v[0] / 2;
        if (a.kind == Act::matrix)
            static_cast<void>(c.parts().heads.set_matrix(head, {a.v[0], a.v[1], a.v[2], a.v[3]}, once)),
                t.set_matrix(head, once, a.v);
        if (a.kind == Act::offset)
            static_cast<void>(c.parts().heads.set_offset(head, {x, y}, once)), t.set_offset(head, once, {x, y});
        if (a.kind == Act::angle)
            static_cast<void>(c.parts().heads.set_angle(head, degrees, once)), t.set_angle(head, once, degrees);
        if (a.kind == Act::scale)
            static_cast<void>(c.parts().heads.set_scale(head, scale, once)), t.set_scale(head, once, scale);
        if (a.kind == Act::hi) {
            static_cast<void>(c.parts().heads.set_hi(3, {1 + a.v[0], 1}, {a.v[1] * 100, 0.5}));
            for (int h = 0; h < 2; ++h)
                t.gain[h][0] = 1 + a.v[0], t.gain[h][1] = 1, t.gain_offset[h][0] = a.v[1] * 100,
                t.gain_offset[h][1] = 0.5;
        }
        if (a.kind == Act::cor) {
            static_cast<void>(c.parts().heads.load_table(table_, 2));
            static_cast<void>(c.parts().heads.select_tables(pick(2) ? 2 : 0, a.b ? 2 : 0));
            t.tables[0] = pick(2) ? &lens_file() : nullptr, t.tables[1] = &lens_file(), t.second_head = a.b;
        }
        if (a.kind == Act::delays) {
            const Delays d{pick(9),       pick(11), pick(30),
                           pick(60) - 20, pick(70), pick(2),
                           pick(3) * 10,  pick(5),  a.v[0] > 0 ? a.v[0] * 40000 : 0};
            static_cast<void>(c.parts().path.set_delays(d));
            t.jump_delay = d.jump, t.mark_delay = d.mark, t.polygon_delay = d.polygon, t.laser_on = d.laser_on;
            t.laser_off = d.laser_off, t.variable_polygon = d.variable_polygon, t.edge_level = d.edge_level;
            t.min_jump = d.min_jump, t.jump_limit = d.jump_limit;
        }
        if (a.kind == Act::init_2d) {
            c.parts().fly.zero_2d(static_cast<std::int32_t>(pick(500)), 7);
            for (auto& e : t.encoders) e.zero = e.travel;
            t.offset_2d = {static_cast<double>(pick(500)), 7};
        }
        if (a.kind == Act::reset_2d) {
            c.parts().fly.load_table(a.b ? std::make_shared<const FlyTable>(fly_table()) : nullptr);
            t.table_2d = a.b ? &fly_table() : nullptr;
        }
    }

    void act_on_words(const Act& a, Engine& c, twin::Twin& t) {
        const auto pick = [&](std::int64_t n) { return static_cast<int>(a.a % n); };
        const double x = pick(2) ? 1 : 0, y = pick(3) ? 0 : 2, turn = pick(5) ? 0 : 4000;
        const auto word = static_cast<std::uint32_t>(a.a);
        const int at_once = static_cast<int>(a.b) * 2;
        if (a.kind == Act::word) c.parts().mcbsp.receive(word), t.receive(word);
        if (a.kind == Act::mcbsp_in)
            static_cast<void>(c.parts().fly.set_mcbsp_in(pick(4), a.v[0] * 3)), t.set_mcbsp_in(pick(4), a.v[0] * 3);
        if (a.kind == Act::multi) static_cast<void>(c.parts().fly.set_multi_mcbsp_in(0, 0, 0)), t.set_multi();
        if (a.kind == Act::online)
            static_cast<void>(c.parts().fly.set_mcbsp_online(x, y, turn)), t.set_online(x, y, turn);
        if (a.kind == Act::apply)
            static_cast<void>(c.apply_mcbsp(1 + pick(4), at_once)), t.apply_online(1 + pick(4), at_once);
        if (a.kind == Act::read_info) {
            both_.same("marking info", t.take_marking_info(), c.parts().flags.take_marking_info());
            both_.same(
                "start and stop info",
                t.startstop | startstop_bit("NO_STOP_SIGNAL") | (t.laser_disabled ? 0 : startstop_bit("LASER_ENABLED")),
                c.get_startstop_info());
            t.startstop = 0;
        }
    }

    /// Lists the commands around the twin's present position.
    std::string where() const {
        std::string out = "\n";
        for (std::int64_t i = std::max<std::int64_t>(0, twin_.current - 6); i < std::min(memory, twin_.current + 3);
             ++i) {
            out += fmt::format("{} {} {}\n", i == twin_.current ? "  >" : "   ", i,
                               testing::PrintToString(twin_.memory[static_cast<std::size_t>(i)]));
        }
        return out;
    }

    void compare() {
        const State& s = card_.state();
        both_.same("tick", twin_.now, s.tick);
        both_.same("place", std::tuple(twin_.p.x, twin_.p.y), std::tuple(s.p.x, s.p.y));
        if (ran_ && s.tick > 0)
            both_.same("output", std::tuple(last_.x, last_.y), std::tuple(s.output.a[0], s.output.a[1]));
        const auto of = [](const auto& e) { return std::tuple(e.count(), e.travel, e.slow2); };
        both_.same("encoder 0", of(twin_.encoders[0]), of(s.encoders.counters[0]));
        both_.same("encoder 1", of(twin_.encoders[1]), of(s.encoders.counters[1]));
        both_.same_elements("stored count", twin_.stored, s.encoders.stored);
        std::array<std::int32_t, 4> locations{};
        std::int64_t filled = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            locations[i] = twin_.locations[i].value_or(0);
            filled |= std::int64_t{twin_.locations[i].has_value()} << i;
        }
        both_.same_elements("location", locations, s.mcbsp.memory);
        both_.same("locations with a value", filled, s.mcbsp.filled & 15);
        both_.same_elements("typed value", twin_.typed, s.mcbsp.typed);
        both_.same("marking info", twin_.marking, static_cast<std::uint32_t>(s.flags.marking_info));
        both_.same("start and stop info", twin_.startstop, static_cast<std::uint32_t>(s.flags.startstop_info));
        both_.same_elements("tick of bit", twin_.flag_tick, s.flags.flag_tick);
        both_.same("busy", twin_.running, card_.busy());
        both_.same("command", twin_.current, s.lists.current);
        both_.same("ended unwritten", twin_.unwritten, s.lists.ended_unwritten);
        both_.same("ports", twin_.io, s.io);
        both_.same("laser", twin_.laser, s.laser.on != 0);
        compare_recordings();
    }

    void compare_recordings() {
        const Recording& r = card_.parts().recorder.recording();
        both_.same("period of the recording", twin_.period, r.period);
        both_.same("recorded samples", static_cast<std::int64_t>(twin_.rows.size()), r.count);
        for (std::size_t i = 0; i < twin_.rows.size() && both_.equal(); ++i)
            for (std::size_t k = 0; k < twin_.rows[i].size(); ++k) {
                const auto recorded =
                    card_.parts().recorder.recorded(static_cast<std::int64_t>(k), static_cast<std::int64_t>(i));
                if (recorded != twin_.rows[i][k])
                    both_.same(fmt::format("sample {} of signal {}", i, r.signals[k]), twin_.rows[i][k], recorded);
            }
    }

    const Job& job_;
    oracle::Comparison& both_;
    Engine card_;
    twin::Twin twin_;
    JobInputs inputs_;
    std::shared_ptr<const Table> table_;
    twin::Sample last_;
    bool ran_ = false;
};

}  // namespace

void run_both(const Job& job, oracle::Comparison& both) {
    Pair(job, both).run();
    both.count("acts", job.acts.size());
}

TEST(Rtc5Oracle, RandomJobsGiveTheSameOutputsOnTheCardAndItsTwin) {
    oracle::compare({0, oracle::programs(1500), 20250},
                    [](std::uint64_t seed, std::uint64_t number) { return JobMaker(seed + number).make(); });
}

}  // namespace motionrack::rtc5
