// Generates random jobs.
#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/test/job.hpp>
#include <ostream>
#include <tests/oracle/harness.hpp>

namespace motionrack::rtc5 {

double JobMaker::coordinate() {
    if (one_of(12)) return std::floor(real(-700000, 700000));
    if (one_of(30)) return std::floor(real(-9000000, 9000000));
    return std::floor(real(-60000, 60000));
}

double JobMaker::count_scale() {
    if (one_of(6)) return 0;
    return one_of(4) ? real(-3000, 3000) : real(-20, 20);
}

double JobMaker::value_of(Op op, const ParamInfo& param) {
    if (one_of(60)) return one_of(2) ? kind_info(param.kind).min : kind_info(param.kind).max;
    switch (param.kind) {
        case Kind::coordinate:
            return coordinate();
        case Kind::centre:
            return one_of(3) ? std::floor(real(-900000, 900000)) : coordinate() / 1 + 0;
        case Kind::count: {
            if (op == Op::simulate_ext_start || op == Op::set_ext_start_delay_list)
                return one_of(5) ? 0 : std::floor(real(-300, 3000));
            return one_of(10) ? std::floor(real(-2147483648.0, 2147483647)) : std::floor(real(-500, 3000));
        }
        case Kind::ticks:
            if (param.name == "Period" && op != Op::laser_on_list) return static_cast<double>(below(6));
            return one_of(8) ? static_cast<double>(below(900)) : static_cast<double>(below(12));
        case Kind::half_us:
            return param.name == "LaserOnDelay" && one_of(3) ? -static_cast<double>(below(130))
                                                             : static_cast<double>(below(150));
        case Kind::switching:
            return static_cast<double>(below(30)) - 5;
        case Kind::micros:
            return real(0, 400);
        case Kind::speed:
            return one_of(5) ? real(1.6, 4000) * 50 : real(1000, 800000);
        case Kind::angle:
            return one_of(5) ? std::floor(real(-3600, 3600)) : real(-400, 400);
        case Kind::scale:
            if (param.name == "Resolution") return one_of(5) ? real(-150, 150) : real(-50000, 50000);
            if (param.name == "Smooth") return real(0, 1);
            return count_scale();
        case Kind::factor:
            return one_of(3) ? 1 : real(-1.5, 1.5);
        case Kind::head:
            return static_cast<double>(1 + below(4));
        case Kind::index:
            return static_cast<double>(below(param.name == "at_once" ? 4 : 2));
        case Kind::port:
            return op == Op::set_control_mode_list
                       ? static_cast<double>((below(3) ? 1 : 0) | (one_of(3) ? 512 : 0) | (one_of(3) ? 1024 : 0))
                       : static_cast<double>(below(65536));
        case Kind::signal:
            return map::signals[below(std::size(map::signals))].number;
        case Kind::amplitude:
            return one_of(4) ? 0 : static_cast<double>(below(3000));
        case Kind::frequency:
            return one_of(5) ? 0 : real(-6000, 6000);
        case Kind::place:
            return static_cast<double>(one_of(3) ? below(30) : below(1700));
        case Kind::subroutine:
            return static_cast<double>(below(4));
        case Kind::number:
            if (op == Op::set_mcbsp_in_list) return static_cast<double>(below(4));
            if (op == Op::clear_fly_overflow) return static_cast<double>(below(8));
            return static_cast<double>(below(3)) - 1;
    }
    return 0;
}

Command JobMaker::command() {
    constexpr Op path[] = {
        Op::jump_abs,         Op::jump_rel,   Op::mark_abs,       Op::mark_rel,       Op::mark_abs,
        Op::mark_rel,         Op::arc_abs,    Op::arc_rel,        Op::timed_mark_abs, Op::micro_vector_abs,
        Op::micro_vector_rel, Op::long_delay, Op::set_mark_speed, Op::set_jump_speed, Op::set_scanner_delays,
        Op::set_laser_delays};
    while (true) {
        const Op op = below(calm_ ? 10 : 3) ? path[below(std::size(path))]
                                            : static_cast<Op>(2 + below(static_cast<std::int64_t>(op_count) - 2));
        if ((op == Op::wait_for_encoder || op == Op::wait_for_encoder_mode || op == Op::wait_for_encoder_in_range ||
             op == Op::wait_for_mcbsp) &&
            below(3))
            continue;
        std::vector<double> values;
        for (int i = 0; i < info(op).param_count(); ++i)
            values.push_back(value_of(op, info(op).params[static_cast<std::size_t>(i)]));
        if (const auto made = list_command(op, values)) return *made;
    }
}

void JobMaker::fill(std::vector<Command>& list) {
    const std::int64_t size = 1 + below(one_of(3) ? 90 : 25);
    for (std::int64_t i = 0; i < size; ++i) {
        list.push_back(command());
        if (!one_of(25)) continue;
        for (std::int64_t n = below(700); n > 0; --n)
            list.push_back(*list_command(Op::micro_vector_rel, {static_cast<double>(below(200)) - 100, 7, -1, -1}));
    }
    if (!one_of(6)) list.push_back(*list_command(Op::set_end_of_list, {}));
}

Act JobMaker::act() {
    Act out;
    const std::int64_t what = below(100);
    if (what < 40) return {Act::run, one_of(4) ? below(5000) : below(300), below(3)};
    if (what < 52) return {Act::execute, below(2)};
    out.kind = static_cast<Act::Kind>(1 + below(Act::kinds - 1));
    out.a = static_cast<std::int64_t>(random_() >> 1), out.b = below(2);
    for (double& v : out.v) v = real(-1, 1);
    return out;
}

Job JobMaker::make() {
    Job out;
    calm_ = one_of(2);
    fill(out.list1);
    fill(out.list2);
    out.subroutines.resize(static_cast<std::size_t>(below(4)));
    for (auto& sub : out.subroutines)
        for (std::int64_t i = below(8); i > 0; --i) sub.push_back(command());
    out.inputs = one_of(3);
    out.steady = one_of(2);
    for (double& r : out.rate) r = one_of(3) ? 0 : real(-30, 30);
    out.word_every = 1 + below(40);
    if (one_of(2)) out.acts.push_back({Act::simulate, below(4)});
    const std::int64_t size = 4 + below(40);
    for (std::int64_t i = 0; i < size; ++i) out.acts.push_back(act());
    out.acts.push_back({Act::run, 200, 1});
    return out;
}

std::string listing_of(const Job& job) {
    std::string out = fmt::format("inputs {}, counts per tick {} {}, a word every {} ticks\n", job.inputs, job.rate[0],
                                  job.rate[1], job.word_every);
    out += oracle::text_of_steps(job.acts);
    out += "list 1\n" + oracle::text_of_steps(job.list1) + "list 2\n" + oracle::text_of_steps(job.list2);
    for (const auto& sub : job.subroutines) out += "subroutine\n" + oracle::text_of_steps(sub);
    return out;
}

void PrintTo(const Act& act, std::ostream* out) {
    constexpr const char* names[Act::kinds] = {
        "run",    "load",    "execute",   "change",   "loop",     "quit_loop", "stop",     "pause",       "restart",
        "alone",  "start",   "word",      "count",    "simulate", "tracking",  "control",  "start_delay", "matrix",
        "offset", "angle",   "scale",     "hi",       "cor",      "delays",    "mcbsp_in", "multi",       "online",
        "apply",  "init_2d", "read_info", "reset_2d", "watch",    "laser"};
    *out << fmt::format("{} {} {} ({} {} {} {})", names[act.kind], act.a, act.b, act.v[0], act.v[1], act.v[2],
                        act.v[3]);
}

void PrintTo(const Command& command, std::ostream* out) {
    *out << info(command.op).name;
    for (int k = 0; k < std::min(info(command.op).param_count(), 4); ++k)
        *out << fmt::format(" {}", command.p[static_cast<std::size_t>(k)]);
}

}  // namespace motionrack::rtc5
