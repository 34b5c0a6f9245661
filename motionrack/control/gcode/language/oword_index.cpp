// Pairs O words with a stack of open ones.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/control/gcode/language/oword_index.hpp>
#include <motionrack/control/gcode/scanner.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::size_t max_problems = 100;

class Indexer {
  public:
    explicit Indexer(OWordIndex& index) : index_(index) {}

    void line(std::string_view text, std::size_t column, const ProgramLines& before, const ProgramLines& after);
    void finish();

  private:
    OWordLocation& open_place() { return index_.locations[static_cast<std::size_t>(open_.back())]; }
    std::string what(const OWordLocation& location) const {
        return fmt::format("o{} {}", labels_[static_cast<std::size_t>(location.label)], name_of(location.word));
    }
    void fail(const OWordLocation& location, std::string message);
    void pair(std::int32_t at);
    void begin_sub(std::int32_t at, const std::string& label);
    void begin_program(std::int32_t at, const std::string& label);
    void branch(std::int32_t at);
    void close(std::int32_t at, OWord opener);
    void inside(std::int32_t at);
    bool fits(std::int32_t at, OWord opener);
    std::int32_t label_number(const std::string& label);

    OWordIndex& index_;
    std::vector<std::int32_t> open_;
    std::map<std::string, std::int32_t> label_numbers_;
    std::vector<std::string> labels_;
};

bool is_loop(OWord word) {
    return word == OWord::while_true || word == OWord::do_once || word == OWord::repeat;
}

std::int32_t Indexer::label_number(const std::string& label) {
    const auto [found, is_first] = label_numbers_.try_emplace(label, static_cast<std::int32_t>(labels_.size()));
    if (is_first) labels_.push_back(label);
    return found->second;
}

void Indexer::fail(const OWordLocation& location, std::string message) {
    if (index_.problems.size() >= max_problems) return;
    Problem problem;
    set_problem(problem, location.text, location.column, GrblStatus::unsupported, std::move(message));
    problem.location.line = location.line;
    index_.problems.push_back(std::move(problem));
}

void Indexer::line(std::string_view text, std::size_t column, const ProgramLines& before, const ProgramLines& after) {
    OWordStatement words;
    Problem problem;
    if (!parse_oword(text, column, words, problem)) {
        problem.location.line = after.number();
        if (index_.problems.size() < max_problems) index_.problems.push_back(std::move(problem));
        return;
    }
    OWordLocation& location = index_.locations.emplace_back(before, after);
    location.word = words.word;
    location.column = words.column;
    location.rest = words.rest;
    location.line = after.number();
    location.label = label_number(words.label);
    location.text = text;
    const auto at = static_cast<std::int32_t>(index_.locations.size() - 1);
    const bool takes_values = location.word == OWord::call || location.word == OWord::endsub ||
                              location.word == OWord::return_sub || location.word == OWord::if_true ||
                              location.word == OWord::else_if || location.word == OWord::while_true ||
                              location.word == OWord::repeat;
    if (!takes_values && !is_rest_empty(text, location.rest))
        fail(location, fmt::format("{}: only a comment may follow it", what(location)));
    if (location.word == OWord::sub)
        begin_sub(at, words.label);
    else if (location.word == OWord::numbered)
        begin_program(at, words.label);
    else
        pair(at);
}

void Indexer::begin_sub(std::int32_t at, const std::string& label) {
    const OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    if (!open_.empty())
        return fail(location,
                    fmt::format("{}: a sub must not be nested, but {} of line {} is open here; end that first",
                                what(location), what(open_place()), open_place().line));
    const auto [found, is_first] = index_.subs.try_emplace(label, at);
    if (!is_first)
        return fail(location,
                    fmt::format("{}: line {} has the same one; each sub needs its own number or name", what(location),
                                index_.locations[static_cast<std::size_t>(found->second)].line));
    index_.locations.back().begin = at;
    open_.push_back(at);
}

/// O100 starts program 100, up to M99 or the end of the program.
void Indexer::begin_program(std::int32_t at, const std::string& label) {
    const OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    if (!open_.empty())
        return fail(
            location,
            fmt::format("O{}: a numbered program must not be nested, but {} of line {} is open here; end that first",
                        label, what(open_place()), open_place().line));
    const auto [found, is_first] = index_.programs.try_emplace(label, at);
    if (is_first) return;
    fail(location, fmt::format("O{}: line {} has the same one; each program needs its own number", label,
                               index_.locations[static_cast<std::size_t>(found->second)].line));
}

void Indexer::pair(std::int32_t at) {
    OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    switch (location.word) {
        case OWord::while_true:
            if (!open_.empty() && open_place().word == OWord::do_once && open_place().label == location.label)
                return close(at, OWord::do_once);
            [[fallthrough]];
        case OWord::if_true:
        case OWord::do_once:
        case OWord::repeat:
            location.begin = at;
            open_.push_back(at);
            return;
        case OWord::endsub:
            return close(at, OWord::sub);
        case OWord::endif:
            return close(at, OWord::if_true);
        case OWord::endwhile:
            return close(at, OWord::while_true);
        case OWord::endrepeat:
            return close(at, OWord::repeat);
        case OWord::else_if:
        case OWord::else_branch:
            return branch(at);
        case OWord::break_loop:
        case OWord::continue_loop:
        case OWord::return_sub:
            return inside(at);
        default:
            return;
    }
}

/// Returns true if the innermost open word is `opener` with the label of the location.
bool Indexer::fits(std::int32_t at, OWord opener) {
    const OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    const auto opens = [&](std::int32_t one) {
        const OWordLocation& other = index_.locations[static_cast<std::size_t>(one)];
        const OWordLocation& first = index_.locations[static_cast<std::size_t>(other.begin)];
        return first.word == opener && first.label == location.label;
    };
    if (!open_.empty() && opens(open_.back())) return true;
    if (const auto outer = std::find_if(open_.begin(), open_.end(), opens); outer != open_.end()) {
        open_.erase(outer);  // already reported
        fail(location, fmt::format("{}: {} of line {} is open here; end that first", what(location), what(open_place()),
                                   open_place().line));
    } else {
        fail(location,
             fmt::format("{}: no o{} {} is open here; {} it with that, or leave it out", what(location),
                         labels_[static_cast<std::size_t>(location.label)], name_of(opener),
                         location.word == OWord::else_if || location.word == OWord::else_branch ? "precede" : "begin"));
    }
    return false;
}

void Indexer::branch(std::int32_t at) {
    if (!fits(at, OWord::if_true)) return;
    OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    OWordLocation& before = open_place();
    if (before.word == OWord::else_branch)
        return fail(location, fmt::format("{}: the else of line {} is the last branch", what(location), before.line));
    before.branch = at;
    location.begin = before.begin;
    open_.back() = at;
}

void Indexer::close(std::int32_t at, OWord opener) {
    if (!fits(at, opener)) return;
    OWordLocation& last = open_place();
    last.branch = at;
    const std::int32_t begin = last.begin;
    for (std::int32_t one = begin; one != at; one = index_.locations[static_cast<std::size_t>(one)].branch)
        index_.locations[static_cast<std::size_t>(one)].end = at;
    index_.locations[static_cast<std::size_t>(at)].begin = begin;
    index_.locations[static_cast<std::size_t>(at)].end = at;
    open_.pop_back();
}

/// Checks that break, continue and return are inside their loop or sub.
void Indexer::inside(std::int32_t at) {
    OWordLocation& location = index_.locations[static_cast<std::size_t>(at)];
    const bool returns = location.word == OWord::return_sub;
    for (auto one = open_.rbegin(); one != open_.rend(); ++one) {
        const OWordLocation& other = index_.locations[static_cast<std::size_t>(*one)];
        if ((returns ? other.word == OWord::sub : is_loop(other.word)) && other.label == location.label) {
            location.begin = *one;
            return;
        }
    }
    fail(location, fmt::format("{}: it is not inside {} o{}", what(location), returns ? "sub" : "loop",
                               labels_[static_cast<std::size_t>(location.label)]));
}

void Indexer::finish() {
    for (const std::int32_t one : open_) {
        const OWordLocation& location = index_.locations[static_cast<std::size_t>(one)];
        const OWordLocation& first = index_.locations[static_cast<std::size_t>(location.begin)];
        const OWord end = first.word == OWord::sub          ? OWord::endsub
                          : first.word == OWord::if_true    ? OWord::endif
                          : first.word == OWord::while_true ? OWord::endwhile
                          : first.word == OWord::repeat     ? OWord::endrepeat
                                                            : OWord::while_true;
        fail(first, fmt::format("{}: its o{} {} is missing", what(first),
                                labels_[static_cast<std::size_t>(first.label)], name_of(end)));
    }
    std::stable_sort(index_.problems.begin(), index_.problems.end(),
                     [](const Problem& a, const Problem& b) { return a.location.line < b.location.line; });
}

}  // namespace

std::int32_t OWordIndex::at_line(std::int32_t line) const {
    const auto found =
        std::lower_bound(locations.begin(), locations.end(), line,
                         [](const OWordLocation& location, std::int32_t wanted) { return location.line < wanted; });
    return found != locations.end() && found->line == line ? static_cast<std::int32_t>(found - locations.begin())
                                                           : no_location;
}

OWordIndex index_owords(std::string_view text, bool block_delete) {
    OWordIndex index;
    Indexer indexer(index);
    ProgramLines lines(text);
    ProgramLines before = lines;
    ProgramEndDetector end(block_delete);
    for (std::string_view line; lines.next(line); before = lines) {
        if (end.is_at(line)) break;
        const std::size_t column = find_oword(line, block_delete);
        if (column != std::string_view::npos && line.size() <= max_line_length)
            indexer.line(line, column, before, lines);
    }
    indexer.finish();
    index.lines = lines.number();
    return index;
}

}  // namespace motionrack::control::gcode
