// Runs a random program on the twin.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/cards/grating_bus/test/outcome.hpp>
#include <tuple>
#include <utility>

namespace motionrack::grating_bus::twin {

namespace {

void put_changes(Outcome& out, const Twin& twin, std::size_t cards) {
    std::vector<oracle::Change> raw;
    std::vector<std::int64_t> levels;
    for (int line = 0; line < line_count; ++line)
        for (int bit = 0; bit < width[line]; ++bit) {
            for (const LevelChange& change : twin.changes())
                if (change.line == line)
                    raw.push_back({change.at, static_cast<int>(levels.size()), change.level >> bit & 1});
            levels.push_back(rest[line] >> bit & 1);
        }
    for (std::size_t card = 0; card < cards; ++card) {
        const int state = static_cast<int>(levels.size()), done = state + 1;
        for (const StateChange& change : twin.states(static_cast<int>(card)))
            raw.insert(raw.end(), {{change.at, state, change.state}, {change.at, done, change.state == 12}});
        levels.insert(levels.end(), {0, 0});
    }
    out.changes = oracle::settled(std::move(raw), std::move(levels));
}

/// Merges the conflicts of a line's bits, from the first difference to the end of the last.
void put_conflicts(Outcome& out, const Twin& twin) {
    struct Whole {
        Ticks begin, end;
        int line;
        std::uint64_t high, low;
    };
    std::vector<Whole> all;
    std::vector<Conflict> of_bits = twin.conflicts();
    std::stable_sort(of_bits.begin(), of_bits.end(), [](const Conflict& a, const Conflict& b) {
        return std::tie(a.line, a.begin) < std::tie(b.line, b.begin);
    });
    for (const Conflict& bit : of_bits) {
        const Ticks end = bit.end == lasting ? INT64_MAX : bit.end;
        if (all.empty() || all.back().line != bit.line || all.back().end < bit.begin)
            all.push_back({bit.begin, end, bit.line, 0, 0});
        all.back().end = std::max(all.back().end, end);
        for (const int driver : bit.high) all.back().high |= std::uint64_t{1} << driver;
        for (const int driver : bit.low) all.back().low |= std::uint64_t{1} << driver;
    }
    all.erase(std::remove_if(all.begin(), all.end(), [](const Whole& w) { return w.begin == w.end; }), all.end());
    std::stable_sort(all.begin(), all.end(), [](const Whole& a, const Whole& b) {
        return std::tie(a.begin, a.line) < std::tie(b.begin, b.line);
    });
    out.conflict_count = all.size();
    for (std::size_t i = first_compared(all.size()); i < all.size(); ++i)
        out.conflicts.push_back(row({all[i].begin, all[i].end, all[i].line, static_cast<std::int64_t>(all[i].high),
                                     static_cast<std::int64_t>(all[i].low)}));
}

void poll(Outcome& out, const Twin& twin, Ticks at, std::size_t cards) {
    std::string text = row({at});
    for (int line = 0; line < line_count; ++line) text.append(row({twin.levels()[static_cast<std::size_t>(line)]}));
    out.looks.push_back(text);
    for (std::size_t i = 0; i < cards; ++i) {
        const int card = static_cast<int>(i);
        const Counters& c = twin.counters(card);
        text = row({at, card, twin.fresh(card), twin.claimed(card), twin.stale(card), twin.state(card) != 0,
                    twin.off(card), twin.state(card), c.frames, c.broken, c.missed_words, c.alien, c.lines,
                    c.missed_edges, c.overrun});
        const Frame frame = twin.claimed_frame(card);
        text.append(row({frame.sequence, frame.time, frame.words, frame.crc}));
        text.append(words_of(frame));
        out.looks.push_back(text);
    }
}

}  // namespace

std::size_t first_compared(std::size_t conflicts) {
    return conflicts <= Lines::kept ? 0 : conflicts - Lines::kept / 2;
}

std::string row(std::initializer_list<std::int64_t> numbers) {
    std::string out;
    for (const std::int64_t number : numbers) out.append(std::to_string(number)).append(" ");
    return out;
}

std::string words_of(const Frame& frame) {
    std::string out;
    for (std::uint32_t k = 0; k < frame.words; ++k) out.append(row({frame.addresses[k], frame.counts[k]}));
    return out;
}

Outcome on_twin(const Program& program) {
    Twin twin = twin_of(program);
    Outcome out;
    for (const Op& op : program.ops) {
        carry_out(twin, op);
        poll(out, twin, op.at, program.cards.size());
    }
    for (std::size_t i = 0; i < program.cards.size(); ++i) {
        const int card = static_cast<int>(i);
        for (const Published& published : twin.frames(card)) {
            const Frame& frame = published.frame;
            std::string text = row({card, published.at, frame.sequence, frame.time, frame.words, frame.crc});
            text.append(words_of(frame));
            out.frames.push_back(text);
        }
        const Ticks two = 2 * program.cards[i].period;
        const bool any = !twin.frames(card).empty() && twin.frames(card)[0].at <= two;
        if (!any && two <= program.end) out.reports.push_back(row({card, two, 5}));
        for (const StaleChange& change : twin.stale_changes(card))
            if (change.stale) out.reports.push_back(row({card, change.at, 5}));
        for (const Ticks at : twin.broken_rows(card)) out.reports.push_back(row({card, at, 2}));
    }
    std::sort(out.reports.begin(), out.reports.end());
    put_conflicts(out, twin);
    put_changes(out, twin, program.cards.size());
    return out;
}

}  // namespace motionrack::grating_bus::twin
