// Blocks are divided at the ends of peak-velocity windows; each channel begins when all of its lines have a level.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/decode/analysis.hpp>

namespace motionrack::decode {

namespace {

/// Lines of a channel by index among the capture's chosen lines; -1: none.
struct ChannelLines {
    std::array<int, 3> at{-1, -1, -1};
};

/// `size` bits of a plane from bit `from` on.
void slice(const std::uint64_t* plane, std::size_t from, std::size_t size, std::vector<std::uint64_t>& out) {
    const std::size_t words = (size + 63) / 64, first = from / 64, shift = from % 64, last = (from + size - 1) / 64;
    out.resize(words);
    for (std::size_t w = 0; w < words; ++w) {
        out[w] = plane[first + w] >> shift;
        if (shift != 0 && first + w + 1 <= last) out[w] |= plane[first + w + 1] << (64 - shift);
    }
}

class ChannelRun {
  public:
    ChannelRun(const ChannelLines& lines, const ChannelSettings& settings) : lines_(lines), decoder_(settings) {}

    /// Samples from .. to of the block, whose first sample has the number `number`.
    void feed(const Capture& capture, const SampleBlock& block, std::uint64_t number, std::size_t from,
              std::size_t to) {
        std::uint64_t known = 0;
        for (const int line : lines_.at)
            if (line >= 0) known = std::max(known, capture.facts(static_cast<std::size_t>(line)).known_from);
        const std::size_t begin = known <= number + from ? from
                                  : known >= number + to ? to
                                                         : static_cast<std::size_t>(known - number);
        if (begin > from) decoder_.skip(begin - from);
        if (begin == to) return;
        if (!begun_) begun_ = number + begin;
        if (block.bytes) {
            const auto bit = [&](std::size_t i) {
                return lines_.at[i] < 0 ? -1
                                        : static_cast<int>(capture.chosen()[static_cast<std::size_t>(lines_.at[i])]);
            };
            decoder_.bytes(block.bytes + begin, to - begin, {bit(0), bit(1), bit(2)});
            return;
        }
        std::array<const std::uint64_t*, 3> planes{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (lines_.at[i] < 0) continue;
            const std::uint64_t* const plane = block.planes[static_cast<std::size_t>(lines_.at[i])];
            if (begin % 64 == 0) {
                planes[i] = plane + begin / 64;
            } else {
                slice(plane, begin, to - begin, pieces_[i]);
                planes[i] = pieces_[i].data();
            }
        }
        decoder_.planes(planes[0], planes[1], planes[2], to - begin);
    }
    /// Ends a window of `seconds` that began at `begin_s`.
    void end_window(double begin_s, double seconds) {
        const std::int64_t counted = decoder_.count() - window_count_;
        window_count_ = decoder_.count();
        const double velocity = static_cast<double>(counted) / seconds;
        if (!peak || std::fabs(velocity) > std::fabs(peak->counts_per_s)) peak = VelocityPeak{velocity, begin_s};
    }
    const ChannelDecoder& decoder() const { return decoder_; }
    std::optional<std::uint64_t> begun() const { return begun_; }

    std::optional<VelocityPeak> peak;
    std::vector<IllegalAt> illegal;
    std::vector<IndexAt> indexes;
    double begun_s = 0;

  private:
    ChannelLines lines_;
    ChannelDecoder decoder_;
    std::optional<std::uint64_t> begun_;
    std::int64_t window_count_ = 0;
    std::array<std::vector<std::uint64_t>, 3> pieces_;
};

class Run {
  public:
    Run(Capture& capture, const std::vector<ChannelSelection>& choices, const AnalysisSettings& settings)
        : capture_(capture), choices_(choices), settings_(settings) {}
    Result<Analysis> all();

  private:
    void choose();
    void feed(const SampleBlock& block);
    void report_times(const SampleBlock& block);
    std::int64_t ticks_of(const SampleBlock& block, std::uint64_t sample) const {
        return block.times ? block.times[sample - number_] : static_cast<std::int64_t>(sample);
    }
    double seconds_of(std::int64_t ticks) const { return static_cast<double>(ticks) * capture_.tick_s(); }
    ChannelResult result_of(const ChannelSelection& choice, const ChannelRun& run) const;

    Capture& capture_;
    const std::vector<ChannelSelection>& choices_;
    const AnalysisSettings& settings_;
    std::vector<ChannelRun> runs_;
    std::vector<ChannelLines> lines_;
    std::uint64_t number_ = 0;  ///< number of the block's first sample
    std::int64_t window_ = 1;   ///< in ticks
    std::int64_t window_begin_ = 0;
    std::int64_t first_ = 0, last_ = 0;
    std::vector<double> line_from_s_;
};

void Run::choose() {
    std::vector<std::size_t> chosen;
    for (const ChannelSelection& choice : choices_) {
        ChannelLines lines;
        const auto take = [&](std::size_t i, std::size_t signal) {
            const auto at = std::find(chosen.begin(), chosen.end(), signal);
            lines.at[i] = static_cast<int>(at - chosen.begin());
            if (at == chosen.end()) chosen.push_back(signal);
        };
        take(0, choice.a);
        take(1, choice.b);
        if (choice.z) take(2, *choice.z);
        lines_.push_back(lines);
        runs_.emplace_back(lines, settings_.channel);
    }
    capture_.choose(chosen);
    line_from_s_.assign(chosen.size(), std::numeric_limits<double>::quiet_NaN());
}

void Run::feed(const SampleBlock& block) {
    if (number_ == 0) first_ = window_begin_ = ticks_of(block, 0);
    std::size_t from = 0;
    while (from < block.samples) {
        const std::int64_t end = window_begin_ + window_;
        std::size_t to = block.samples;
        if (block.times)
            to = static_cast<std::size_t>(std::lower_bound(block.times + from, block.times + block.samples, end) -
                                          block.times);
        else if (static_cast<std::uint64_t>(end) < number_ + block.samples)
            to = static_cast<std::size_t>(static_cast<std::uint64_t>(end) - number_);
        if (to > from)
            for (ChannelRun& run : runs_) run.feed(capture_, block, number_, from, to);
        from = to;
        if (from == block.samples) break;
        for (ChannelRun& run : runs_) run.end_window(seconds_of(window_begin_), seconds_of(window_));
        // Windows without changes are skipped together.
        window_begin_ += (ticks_of(block, number_ + from) - window_begin_) / window_ * window_;
    }
    last_ = ticks_of(block, number_ + block.samples - 1);
}

/// Converts sample numbers of findings in the block to times while the block is valid.
void Run::report_times(const SampleBlock& block) {
    for (ChannelRun& run : runs_) {
        const auto& illegal = run.decoder().illegal_samples();
        while (run.illegal.size() < illegal.size()) {
            const std::uint64_t sample = illegal[run.illegal.size()];
            run.illegal.push_back({sample, seconds_of(ticks_of(block, sample))});
        }
        const auto& indexes = run.decoder().index_events();
        while (run.indexes.size() < indexes.size()) {
            const IndexEvent& event = indexes[run.indexes.size()];
            run.indexes.push_back({event.sample, seconds_of(ticks_of(block, event.sample)), event.count});
        }
        if (const auto begun = run.begun(); begun && *begun >= number_)
            run.begun_s = seconds_of(ticks_of(block, *begun));
    }
    for (std::size_t line = 0; line < line_from_s_.size(); ++line)
        if (const std::uint64_t from = capture_.facts(line).known_from;
            from >= number_ && from < number_ + block.samples)
            line_from_s_[line] = seconds_of(ticks_of(block, from));
}

ChannelResult Run::result_of(const ChannelSelection& choice, const ChannelRun& run) const {
    ChannelResult out;
    const auto& signals = capture_.signals();
    out.name = choice.name;
    out.a = signals[choice.a], out.b = signals[choice.b], out.z = choice.z ? signals[*choice.z] : "";
    const ChannelDecoder& decoder = run.decoder();
    out.count = decoder.count(), out.up = decoder.up(), out.down = decoder.down();
    out.illegal = decoder.illegal(), out.indexes = decoder.indexes();
    out.seconds = run.begun() ? seconds_of(last_) - run.begun_s : 0;
    if (out.seconds > 0) out.mean_per_s = static_cast<double>(out.count) / out.seconds;
    out.peak = run.peak;
    out.first_illegal = run.illegal;
    out.first_indexes = run.indexes;
    for (std::size_t line = 0; line < capture_.chosen().size(); ++line) {
        const std::size_t signal = capture_.chosen()[line];
        if (signal != choice.a && signal != choice.b && choice.z != signal) continue;
        const LineFacts& facts = capture_.facts(line);
        LineNote note{signals[signal], facts.unknown, facts.first_unknown, {}};
        if (facts.known_from > 0) note.from_s = line_from_s_[line];
        if (note.unknown > 0 || note.from_s) out.notes.push_back(note);
    }
    return out;
}

Result<Analysis> Run::all() {
    const double ticks = settings_.window_s / capture_.tick_s();
    if (!(settings_.window_s > 0) || !(ticks < 1e18))
        return fail(
            ErrorKind::refused,
            fmt::format(
                "A window of {} s for the peak velocity: it must be more than 0 and less than 1e18 samples or ticks. "
                "Nothing was decoded.",
                settings_.window_s));
    window_ = std::max<std::int64_t>(1, std::llround(ticks));
    choose();
    Analysis out;
    SampleBlock block;
    for (;;) {
        MOTIONRACK_TRY(const bool more, capture_.next(block));
        if (!more) break;
        if (block.samples == 0) continue;
        feed(block);
        report_times(block);
        number_ += block.samples;
        if (settings_.progress)
            settings_.progress(capture_.bytes_total() == 0 ? -1
                                                           : static_cast<double>(capture_.bytes_read()) /
                                                                 static_cast<double>(capture_.bytes_total()));
        out.stopped = settings_.stop && settings_.stop();
        if (out.stopped) break;
    }
    out.format = capture_.format();
    out.samples = number_;
    out.first_s = seconds_of(first_), out.last_s = seconds_of(last_);
    out.tick_s = capture_.tick_s();
    out.timed = capture_.timed();
    out.window_s = seconds_of(window_);
    out.cut = capture_.cut();
    for (std::size_t i = 0; i < runs_.size(); ++i) out.channels.push_back(result_of(choices_[i], runs_[i]));
    return out;
}

}  // namespace

Result<Analysis> analyse(Capture& capture, const std::vector<ChannelSelection>& choices,
                         const AnalysisSettings& settings) {
    return Run(capture, choices, settings).all();
}

}  // namespace motionrack::decode
