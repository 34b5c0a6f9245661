// Generates the random programs.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/cards/grating_bus/test/random_bus.hpp>
#include <numeric>
#include <ostream>

namespace motionrack::grating_bus::twin {

Program Maker::make() {
    program_ = {};
    constexpr Ticks grains[] = {1, 7, 10, 100};
    grain_ = grains[below(4)];
    healthy_ = !one_in(3);
    add_cards();
    add_decoder();
    const std::int64_t periods = 3 + below(12);
    program_.end = (periods + 1) * period_;
    const std::int64_t ops = one_in(4) ? 0 : below(one_in(2) ? 8 : 25);
    for (std::int64_t i = 0; i < ops; ++i) program_.ops.push_back(op());
    // Most stuck or disabled items are released or enabled again later.
    for (std::size_t i = 0; i < program_.ops.size() && program_.ops.size() < 60; ++i) {
        Op other = program_.ops[i];
        if (one_in(4)) continue;
        if (other.kind == Op::force)
            other.kind = Op::release;
        else if ((other.kind == Op::off || other.kind == Op::no_latch) && other.a == 1)
            other.a = 0;
        else
            continue;
        other.at = std::min(program_.end, other.at + (one_in(2) ? time(0, 40) : below(2 * period_)));
        program_.ops.push_back(other);
    }
    std::stable_sort(program_.ops.begin(), program_.ops.end(), [](const Op& a, const Op& b) { return a.at < b.at; });
    Op last;
    last.at = program_.end;
    program_.ops.push_back(last);
    return program_;
}

BusTiming Maker::timing() {
    return {Duration{time(1, 30)}, Duration{time(2, 40)}, Duration{time(1, 40)}, Duration{time(1, 12)}};
}

void Maker::set(CardSettings& card, const BusTiming& timing) {
    card.t1 = timing.t1.count(), card.t2 = timing.t2.count(), card.t3 = timing.t3.count(),
    card.clock = timing.clock.count();
}

/// Returns `words` different addresses.
std::vector<int> Maker::list(int words) {
    std::vector<int> all(static_cast<std::size_t>(words + below(8)));
    std::iota(all.begin(), all.end(), 0);
    std::shuffle(all.begin(), all.end(), random_);
    all.resize(static_cast<std::size_t>(words));
    return all;
}

void Maker::add_cards() {
    const std::int64_t count = 1 + below(one_in(5) ? 11 : 4);
    const bool alike = healthy_ || !one_in(3);
    const BusTiming common = timing();
    const int words = static_cast<int>(1 + below(one_in(6) ? 20 : 5)),
              first = one_in(3) ? static_cast<int>(below(6)) : 0;
    const std::vector<int> common_list = one_in(3) ? list(words) : std::vector<int>();
    Ticks max_frame_time = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        CardSettings card;
        card.host = i == 0 ? healthy_ || !one_in(12) : !healthy_ && one_in(8);
        card.clock_out = card.address_out = card.host;
        if (!healthy_ && one_in(15)) card.clock_out = !card.clock_out;
        if (!healthy_ && one_in(15)) card.address_out = !card.address_out;
        card.verify_lines = !one_in(3);
        const BusTiming own = alike || one_in(2) ? common : timing();
        set(card, own);
        card.words = alike || one_in(2) ? words : static_cast<int>(1 + below(6));
        card.first = alike || one_in(2) ? first : static_cast<int>(below(4));
        if (card.words == words && (alike || one_in(2)))
            card.list = common_list;
        else if (one_in(3))
            card.list = list(card.words);
        max_frame_time = std::max(max_frame_time, own.frame_time(card.words).count());
        const auto seed = static_cast<std::uint32_t>(random_());
        card.jitter = [seed](std::int64_t n, Ticks max_delay) { return scatter(seed, n, max_delay); };
        program_.cards.push_back(card);
        program_.seeds.push_back(seed);
    }
    constexpr Ticks margins[] = {1, 3, 50};
    period_ = std::max<Ticks>(10'000, max_frame_time + time(1, 1 + max_frame_time / grain_ / margins[below(3)]));
    for (CardSettings& card : program_.cards) {
        card.period = period_ + ((alike && !one_in(6)) || one_in(2) ? 0 : time(0, 5));
        card.offset = one_in(2) ? 0 : one_in(2) ? time(0, 20) : below(period_);
    }
}

void Maker::add_decoder() {
    int scales = 1 + static_cast<int>(below(8));
    for (const CardSettings& card : program_.cards)
        if (healthy_ || !one_in(8))
            for (int k = 0; k < card.words; ++k) scales = std::max(scales, 1 + static_cast<int>(card.address(k)));
    program_.decoder.scales = scales;
    program_.decoder.latch = one_in(8) ? 0 : time(1, 12);
    program_.decoder.output = time(1, 25);
    if (healthy_) {
        program_.decoder.latch = std::min(program_.decoder.latch, program_.cards[0].t1);
        program_.decoder.output = std::min(program_.decoder.output, program_.cards[0].t2 - 1);
    }
    for (int k = 0; k < scales; ++k)
        program_.scales.push_back(
            {static_cast<std::uint32_t>(random_()), below(7) - 3, one_in(3) ? 1 + below(20) : 500 + below(3000)});
    program_.decoder.count = [scales_of = program_.scales](int scale, Ticks at) {
        return scales_of[static_cast<std::size_t>(scale)].at(at);
    };
}

/// Returns an instant, mostly during a frame and often exactly that of an event.
Ticks Maker::instant() {
    const CardSettings& card =
        program_.cards[static_cast<std::size_t>(below(static_cast<std::int64_t>(program_.cards.size())))];
    const BusTiming timing{Duration{card.t1}, Duration{card.t2}, Duration{card.t3}, Duration{card.clock}};
    const Ticks begin = card.offset + below(program_.end / card.period + 1) * card.period;
    const Ticks frame = timing.frame_time(card.words).count();
    const std::int64_t roll = below(5);
    Ticks at = begin;
    if (roll == 0) at = below(program_.end + 1);
    if (roll == 1) at = begin + below(frame + 1) / grain_ * grain_;
    if (roll == 2)
        at = begin + timing.sample_at(static_cast<int>(below(card.words))).count() + (one_in(2) ? 0 : time(-1, 1));
    if (roll == 3) at = begin + (one_in(2) ? frame : card.period / 2);
    return std::clamp<Ticks>(at, 0, program_.end);
}

Op Maker::op() {
    Op op;
    op.at = instant();
    const std::int64_t what = below(100);
    const std::int64_t cards = static_cast<std::int64_t>(program_.cards.size());
    op.who = static_cast<int>(below(cards));
    const bool host = program_.cards[static_cast<std::size_t>(op.who)].host;
    if (what < 15) {
        op.kind = Op::poll, op.a = below(2);
    } else if (what < 23) {
        op.kind = Op::off, op.a = 1;
    } else if (what < 30) {
        op.kind = Op::reset, op.a = below(2);
    } else if (what < 42) {
        op.kind = host ? Op::poll : Op::late, op.a = one_in(3) ? 0 : one_in(3) ? below(2 * period_) : time(0, 30);
    } else if (what < 50) {
        op.kind = host ? Op::poll : Op::miss_edges, op.a = below(4);
    } else if (what < 55) {
        op.kind = host ? Op::jitter : Op::poll,
        op.a = one_in(3) ? 0 : below(one_in(2) ? period_ / 2 : 1 + period_ / 20);
    } else if (what < 60) {
        op.kind = Op::no_latch, op.who = 0, op.a = 1;
    } else if (what < 78) {
        op.kind = Op::force;
        op.line = static_cast<Line>(below(5));
        op.bit = width[op.line] > 1 && !one_in(6) ? static_cast<int>(below(width[op.line])) : -1;
        op.a = op.bit < 0 && op.line == addr ? below(128) : op.bit < 0 && op.line == data ? below(1 << 30) : below(2);
    } else if (what < 92) {
        op.kind = Op::claim;
    } else if (what < 97) {
        op.kind = Op::give_back;
    } else {
        op.kind = Op::clear;
    }
    return op;
}

Twin twin_of(const Program& program, bool every_tick) {
    Twin twin(program.cards, {program.decoder}, every_tick);
    return twin;
}

void carry_out(Twin& twin, const Op& op) {
    twin.run_to(op.at);
    const bool on = op.a != 0;
    if (op.kind == Op::off) twin.set_off(op.who, on);
    if (op.kind == Op::reset) twin.reset(op.who);
    if (op.kind == Op::late) twin.set_late(op.who, op.a);
    if (op.kind == Op::miss_edges) twin.set_miss_edges(op.who, static_cast<int>(op.a));
    if (op.kind == Op::jitter) twin.set_jitter(op.who, op.a);
    if (op.kind == Op::no_latch) twin.set_no_latch(op.who, on);
    if (op.kind == Op::force) twin.force(op.line, op.bit, static_cast<std::uint32_t>(op.a));
    if (op.kind == Op::release) twin.release(op.line, op.bit);
    if (op.kind == Op::claim) twin.claim(op.who);
    if (op.kind == Op::give_back) twin.give_back(op.who);
    if (op.kind == Op::clear) twin.clear_errors(op.who);
}

std::string listing_of(const Program& program) {
    std::string out;
    const auto add = [&out](const char* name, std::int64_t value) {
        out.append(" ").append(name).append(" ").append(std::to_string(value));
    };
    for (const CardSettings& card : program.cards) {
        out += card.host ? "host " : "slave";
        add("clock_out", card.clock_out), add("address_out", card.address_out), add("checks", card.verify_lines),
            add("first", card.first);
        for (const int address : card.list) add("listed", address);
        add("words", card.words), add("t1", card.t1), add("t2", card.t2), add("t3", card.t3), add("t", card.clock);
        add("period", card.period), add("offset", card.offset);
        out += "\n";
    }
    out += "decoder";
    add("scales", program.decoder.scales), add("latch", program.decoder.latch), add("output", program.decoder.output);
    return out + "\n" + oracle::text_of_steps(program.ops);
}

void PrintTo(const Op& op, std::ostream* out) {
    constexpr const char* kinds[] = {"look",     "off",   "reset",   "late",  "miss_edges", "jitter",
                                     "no_latch", "force", "release", "claim", "give_back",  "clear"};
    *out << op.at << ' ' << kinds[op.kind] << " who " << op.who << " a " << op.a << " line " << op.line << " bit "
         << op.bit;
}

}  // namespace motionrack::grating_bus::twin
