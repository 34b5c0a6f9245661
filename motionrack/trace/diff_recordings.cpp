// Compares two recordings, signal by signal and event by event.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <motionrack/trace/diff_parts.hpp>
#include <motionrack/trace/recording_parts.hpp>
#include <span>

namespace motionrack::trace {

namespace {

constexpr std::size_t diff_block = 1 << 14;

std::size_t first_line_that_differs(std::string_view a, std::string_view b) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < a.size() && i < b.size() && a[i] == b[i]; ++i) line += a[i] == '\n';
    return line;
}

/// Compares the origins of the two recordings.
void compare_heads(const RecordingReader& a, const RecordingReader& b, Diff& diff) {
    const RecordingHead &x = a.head(), &y = b.head();
    if (x.program != y.program)
        diff.made_of.push_back(
            fmt::format("the programs differ, first in line {}", first_line_that_differs(x.program, y.program)));
    if (x.rack != y.rack)
        diff.made_of.push_back(
            fmt::format("the rack files differ, first in line {}", first_line_that_differs(x.rack, y.rack)));
    if (x.tools != y.tools) diff.made_of.emplace_back("the tool tables differ");
    if (x.subprograms != y.subprograms) diff.made_of.emplace_back("the subprograms differ");
    if (x.block_delete != y.block_delete)
        diff.made_of.push_back(fmt::format("only {} was run with --block-delete", x.block_delete ? "A" : "B"));
    if (x.live != y.live)
        diff.made_of.push_back(
            fmt::format("only {} was executed with commands, which splits long moves", x.live ? "A" : "B"));
    if (x.sample_period != y.sample_period)
        diff.made_of.push_back(fmt::format("samples are {} s apart in A, {} s in B", to_seconds(x.sample_period),
                                           to_seconds(y.sample_period)));
    const auto& in_a = a.inputs();
    const auto& in_b = b.inputs();
    for (std::size_t i = 0; i < std::max(in_a.size(), in_b.size()); ++i) {
        if (i < in_a.size() && i < in_b.size() && in_a[i] == in_b[i]) continue;
        const auto reported = [i](const std::vector<RecordedInput>& all) {
            return i < all.size() ? fmt::format("{} at {:.7f} s", all[i].text, to_seconds(all[i].at))
                                  : std::string("none");
        };
        diff.made_of.push_back(
            fmt::format("input {} from outside differs: {} | {}", i + 1, reported(in_a), reported(in_b)));
        break;
    }
    if (x.version != y.version)
        diff.notes.push_back(
            fmt::format("{} was written by version {}, {} by version {}.", a.path(), x.version, b.path(), y.version));
    if (!a.whole()) diff.notes.push_back(a.cut_sentence());
    if (!b.whole()) diff.notes.push_back(b.cut_sentence());
}

void compare_outcomes(const RecordingReader& a, const RecordingReader& b, Diff& diff) {
    if (!a.whole() || !b.whole()) return;
    const auto value = [](const RecordingReader& of, const std::string& name) {
        for (const OutcomeField& fact : of.outcome())
            if (fact.name == name) return fact.text;
        return std::string("none");
    };
    std::vector<std::string> names;
    for (const RecordingReader* one : {&a, &b})
        for (const OutcomeField& fact : one->outcome())
            if (std::find(names.begin(), names.end(), fact.name) == names.end()) names.push_back(fact.name);
    for (const std::string& name : names)
        if (value(a, name) != value(b, name))
            diff.made_of.push_back(
                fmt::format("the outcomes differ in {}: {} | {}", name, value(a, name), value(b, name)));
}

/// Compares bits, so that two NaN are equal.
bool same_number(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Times and values of a signal, read in blocks.
struct Window {
    RecordingReader::Columns columns;
    std::vector<std::int64_t> times = std::vector<std::int64_t>(diff_block),
                              numbers = std::vector<std::int64_t>(diff_block);
    std::vector<double> reals = std::vector<double>(diff_block);

    Result<void> read(std::uint64_t from, std::size_t count, bool number) {
        MOTIONRACK_CHECK(columns.time.read(from, count, times.data()));
        return number ? columns.value.read(from, count, numbers.data()) : columns.value.read(from, count, reals.data());
    }
    std::string value(std::size_t i, bool number, bool step) const {
        if (!number) return fmt::format("{}", reals[i]);
        return step ? fmt::format("{:+}", numbers[i]) : fmt::format("{}", numbers[i]);
    }
};

std::string at_time(const std::string& value, std::int64_t ticks) {
    return fmt::format("{} at {:.10f} s", value, static_cast<double>(ticks) * 1e-10);
}

class SignalComparison {
  public:
    SignalComparison(const RecordedSeries& series, Window& a, Window& b) : series_(series), a_(a), b_(b) {}

    Result<std::optional<Difference>> run() {
        const std::uint64_t size = std::min(a_.columns.size, b_.columns.size);
        for (std::uint64_t from = 0; from < size; from += diff_block) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(diff_block, size - from));
            MOTIONRACK_CHECK(a_.read(from, count, series_.number));
            MOTIONRACK_CHECK(b_.read(from, count, series_.number));
            for (std::size_t i = 0; i < count; ++i)
                if (a_.times[i] != b_.times[i] || differ(i)) return std::optional(difference(i));
        }
        if (a_.columns.size == b_.columns.size) return std::optional<Difference>();
        Window& longer = a_.columns.size > size ? a_ : b_;
        MOTIONRACK_CHECK(longer.read(size, 1, series_.number));
        const std::string more = at_time(longer.value(0, series_.number, step()), longer.times[0]);
        const bool of_a = &longer == &a_;
        return std::optional(Difference{series_.name, Instant{longer.times[0]}, of_a ? more : "nothing more",
                                        of_a ? "nothing more" : more, series_.unit});
    }

  private:
    bool step() const { return series_.unit == "step" && series_.number; }
    bool differ(std::size_t i) const {
        return series_.number ? a_.numbers[i] != b_.numbers[i] : !same_number(a_.reals[i], b_.reals[i]);
    }
    Difference difference(std::size_t i) const {
        const std::int64_t at_a = a_.times[i], at_b = b_.times[i];
        std::string a = a_.value(i, series_.number, step()), b = b_.value(i, series_.number, step());
        if (at_a != at_b) a = at_time(a, at_a), b = at_time(b, at_b);
        return {series_.name, Instant{std::min(at_a, at_b)}, std::move(a), std::move(b), series_.unit};
    }

    const RecordedSeries& series_;
    Window& a_;
    Window& b_;
};

std::optional<std::int64_t> initial_of(const RecordingReader& recording, const std::string& name) {
    for (const RecordedSignal& signal : recording.head().signals)
        if (signal.name == name) return signal.initial;
    return std::nullopt;
}

Result<void> compare_signal(const RecordingReader& a, const RecordingReader& b, const RecordedSeries& in_a,
                            const RecordedSeries& in_b, Diff& diff) {
    if (const auto x = initial_of(a, in_a.name), y = initial_of(b, in_b.name); x != y && x && y) {
        diff.differences.push_back(
            {in_a.name, a.began(), fmt::format("{} at first", *x), fmt::format("{} at first", *y), in_a.unit});
        return {};
    }
    Window of_a, of_b;
    MOTIONRACK_TRY(of_a.columns, a.columns(in_a));
    MOTIONRACK_TRY(of_b.columns, b.columns(in_b));
    if (diff.until) {
        MOTIONRACK_CHECK(of_a.columns.end_before(*diff.until));
        MOTIONRACK_CHECK(of_b.columns.end_before(*diff.until));
    }
    diff.compared += of_a.columns.size;
    MOTIONRACK_TRY(std::optional<Difference> found, SignalComparison(in_a, of_a, of_b).run());
    if (found) diff.differences.push_back(std::move(*found));
    return {};
}

}  // namespace

Result<Diff> diff_recordings(const RecordingReader& a, const RecordingReader& b, const DiffSettings& settings) {
    Diff diff;
    diff.kind = "recordings";
    if (!a.whole() || !b.whole()) diff.until = std::min(a.known_to(), b.known_to());
    if (a.whole() && !b.whole()) diff.until = b.known_to();
    if (!a.whole() && b.whole()) diff.until = a.known_to();
    compare_heads(a, b, diff);
    std::size_t done = 0;
    for (const RecordedSeries& series : a.series()) {
        if (settings.progress) settings.progress(static_cast<double>(done++) / static_cast<double>(a.series().size()));
        if (settings.stop && settings.stop()) {
            diff.stopped = true;
            break;
        }
        const RecordedSeries* other = b.find(series.name);
        if (other == nullptr || other->number != series.number) {
            diff.only_a.push_back(series.name);
            continue;
        }
        ++diff.signals;
        MOTIONRACK_CHECK(compare_signal(a, b, series, *other, diff));
    }
    for (const RecordedSeries& series : b.series())
        if (a.find(series.name) == nullptr) diff.only_b.push_back(series.name);
    compare_outcomes(a, b, diff);
    sort_differences(diff);
    return diff;
}

}  // namespace motionrack::trace
