// Pairing O words: a stack of what is open.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/control/gcode/language/flow_index.hpp>
#include <motionrack/control/gcode/scanner.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::size_t most_problems = 100;

class Indexer {
  public:
    explicit Indexer(FlowIndex& index) : index_(index) {}

    void line(std::string_view text, std::size_t column, const ProgramLines& before, const ProgramLines& after);
    void finish();

  private:
    FlowPlace& open_place() { return index_.places[static_cast<std::size_t>(open_.back())]; }
    std::string what(const FlowPlace& place) const {
        return fmt::format("o{} {}", labels_[static_cast<std::size_t>(place.label)], name_of(place.word));
    }
    void fail(const FlowPlace& place, std::string message);
    void pair(std::int32_t at);
    void begin_sub(std::int32_t at, const std::string& label);
    void begin_program(std::int32_t at, const std::string& label);
    void branch(std::int32_t at);
    void close(std::int32_t at, FlowWord opener);
    void inside(std::int32_t at);
    bool fits(std::int32_t at, FlowWord opener);
    std::int32_t label_number(const std::string& label);

    FlowIndex& index_;
    std::vector<std::int32_t> open_;
    std::map<std::string, std::int32_t> label_numbers_;
    std::vector<std::string> labels_;
};

bool is_loop(FlowWord word) {
    return word == FlowWord::while_true || word == FlowWord::do_once || word == FlowWord::repeat;
}

std::int32_t Indexer::label_number(const std::string& label) {
    const auto [found, is_first] = label_numbers_.try_emplace(label, static_cast<std::int32_t>(labels_.size()));
    if (is_first) labels_.push_back(label);
    return found->second;
}

void Indexer::fail(const FlowPlace& place, std::string message) {
    if (index_.problems.size() >= most_problems) return;
    Problem problem;
    set_problem(problem, place.text, place.column, GrblStatus::unsupported, std::move(message));
    problem.place.line = place.line;
    index_.problems.push_back(std::move(problem));
}

void Indexer::line(std::string_view text, std::size_t column, const ProgramLines& before, const ProgramLines& after) {
    FlowLine words;
    Problem problem;
    if (!read_flow(text, column, words, problem)) {
        problem.place.line = after.number();
        if (index_.problems.size() < most_problems) index_.problems.push_back(std::move(problem));
        return;
    }
    FlowPlace& place = index_.places.emplace_back(before, after);
    place.word = words.word;
    place.column = words.column;
    place.rest = words.rest;
    place.line = after.number();
    place.label = label_number(words.label);
    place.text = text;
    const auto at = static_cast<std::int32_t>(index_.places.size() - 1);
    const bool takes_values = place.word == FlowWord::call || place.word == FlowWord::endsub ||
                              place.word == FlowWord::give_back || place.word == FlowWord::if_true ||
                              place.word == FlowWord::else_if || place.word == FlowWord::while_true ||
                              place.word == FlowWord::repeat;
    if (!takes_values && !is_rest_empty(text, place.rest))
        fail(place, fmt::format("{}: nothing but a comment may stand behind it", what(place)));
    if (place.word == FlowWord::sub)
        begin_sub(at, words.label);
    else if (place.word == FlowWord::numbered)
        begin_program(at, words.label);
    else
        pair(at);
}

void Indexer::begin_sub(std::int32_t at, const std::string& label) {
    const FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    if (!open_.empty())
        return fail(place, fmt::format("{}: a sub stands by itself, but {} of line {} is open here; end that first",
                                       what(place), what(open_place()), open_place().line));
    const auto [found, is_first] = index_.subs.try_emplace(label, at);
    if (!is_first)
        return fail(place,
                    fmt::format("{}: there is one in line {} already; each sub needs a number or name of its own",
                                what(place), index_.places[static_cast<std::size_t>(found->second)].line));
    index_.places.back().begin = at;
    open_.push_back(at);
}

/// O100: what follows, up to M99 or the end of the program, is program 100.
void Indexer::begin_program(std::int32_t at, const std::string& label) {
    const FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    if (!open_.empty())
        return fail(
            place,
            fmt::format("O{}: a numbered program stands by itself, but {} of line {} is open here; end that first",
                        label, what(open_place()), open_place().line));
    const auto [found, is_first] = index_.programs.try_emplace(label, at);
    if (is_first) return;
    fail(place, fmt::format("O{}: there is one in line {} already; each program needs a number of its own", label,
                            index_.places[static_cast<std::size_t>(found->second)].line));
}

void Indexer::pair(std::int32_t at) {
    FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    switch (place.word) {
        case FlowWord::while_true:
            if (!open_.empty() && open_place().word == FlowWord::do_once && open_place().label == place.label)
                return close(at, FlowWord::do_once);
            [[fallthrough]];
        case FlowWord::if_true:
        case FlowWord::do_once:
        case FlowWord::repeat:
            place.begin = at;
            open_.push_back(at);
            return;
        case FlowWord::endsub:
            return close(at, FlowWord::sub);
        case FlowWord::endif:
            return close(at, FlowWord::if_true);
        case FlowWord::endwhile:
            return close(at, FlowWord::while_true);
        case FlowWord::endrepeat:
            return close(at, FlowWord::repeat);
        case FlowWord::else_if:
        case FlowWord::else_branch:
            return branch(at);
        case FlowWord::leave:
        case FlowWord::go_on:
        case FlowWord::give_back:
            return inside(at);
        default:
            return;
    }
}

/// Whether what is open last is `opener` with the label of the place.
bool Indexer::fits(std::int32_t at, FlowWord opener) {
    const FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    const auto opens = [&](std::int32_t one) {
        const FlowPlace& other = index_.places[static_cast<std::size_t>(one)];
        const FlowPlace& first = index_.places[static_cast<std::size_t>(other.begin)];
        return first.word == opener && first.label == place.label;
    };
    if (!open_.empty() && opens(open_.back())) return true;
    if (const auto outer = std::find_if(open_.begin(), open_.end(), opens); outer != open_.end()) {
        open_.erase(outer);  // it has been told of
        fail(place, fmt::format("{}: {} of line {} is open here; end that first", what(place), what(open_place()),
                                open_place().line));
    } else {
        fail(place,
             fmt::format("{}: no o{} {} is open here; {} it with that, or leave it out", what(place),
                         labels_[static_cast<std::size_t>(place.label)], name_of(opener),
                         place.word == FlowWord::else_if || place.word == FlowWord::else_branch ? "precede" : "begin"));
    }
    return false;
}

void Indexer::branch(std::int32_t at) {
    if (!fits(at, FlowWord::if_true)) return;
    FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    FlowPlace& before = open_place();
    if (before.word == FlowWord::else_branch)
        return fail(place, fmt::format("{}: the else of line {} is the last branch", what(place), before.line));
    before.branch = at;
    place.begin = before.begin;
    open_.back() = at;
}

void Indexer::close(std::int32_t at, FlowWord opener) {
    if (!fits(at, opener)) return;
    FlowPlace& last = open_place();
    last.branch = at;
    const std::int32_t begin = last.begin;
    for (std::int32_t one = begin; one != at; one = index_.places[static_cast<std::size_t>(one)].branch)
        index_.places[static_cast<std::size_t>(one)].end = at;
    index_.places[static_cast<std::size_t>(at)].begin = begin;
    index_.places[static_cast<std::size_t>(at)].end = at;
    open_.pop_back();
}

/// break, continue and return stand within their loop or sub.
void Indexer::inside(std::int32_t at) {
    FlowPlace& place = index_.places[static_cast<std::size_t>(at)];
    const bool returns = place.word == FlowWord::give_back;
    for (auto one = open_.rbegin(); one != open_.rend(); ++one) {
        const FlowPlace& other = index_.places[static_cast<std::size_t>(*one)];
        if ((returns ? other.word == FlowWord::sub : is_loop(other.word)) && other.label == place.label) {
            place.begin = *one;
            return;
        }
    }
    fail(place, fmt::format("{}: it stands in no {} o{}", what(place), returns ? "sub" : "loop",
                            labels_[static_cast<std::size_t>(place.label)]));
}

void Indexer::finish() {
    for (const std::int32_t one : open_) {
        const FlowPlace& place = index_.places[static_cast<std::size_t>(one)];
        const FlowPlace& first = index_.places[static_cast<std::size_t>(place.begin)];
        const FlowWord end = first.word == FlowWord::sub          ? FlowWord::endsub
                             : first.word == FlowWord::if_true    ? FlowWord::endif
                             : first.word == FlowWord::while_true ? FlowWord::endwhile
                             : first.word == FlowWord::repeat     ? FlowWord::endrepeat
                                                                  : FlowWord::while_true;
        fail(first, fmt::format("{}: its o{} {} is missing", what(first),
                                labels_[static_cast<std::size_t>(first.label)], name_of(end)));
    }
    std::stable_sort(index_.problems.begin(), index_.problems.end(),
                     [](const Problem& a, const Problem& b) { return a.place.line < b.place.line; });
}

}  // namespace

std::int32_t FlowIndex::at_line(std::int32_t line) const {
    const auto found =
        std::lower_bound(places.begin(), places.end(), line,
                         [](const FlowPlace& place, std::int32_t wanted) { return place.line < wanted; });
    return found != places.end() && found->line == line ? static_cast<std::int32_t>(found - places.begin()) : no_place;
}

FlowIndex index_flow(std::string_view text, bool block_delete) {
    FlowIndex index;
    Indexer indexer(index);
    ProgramLines lines(text);
    ProgramLines before = lines;
    ProgramEnd end(block_delete);
    for (std::string_view line; lines.next(line); before = lines) {
        if (end.is_at(line)) break;
        const std::size_t column = find_flow(line, block_delete);
        if (column != std::string_view::npos && line.size() <= longest_line) indexer.line(line, column, before, lines);
    }
    indexer.finish();
    index.lines = lines.number();
    return index;
}

}  // namespace motionrack::control::gcode
