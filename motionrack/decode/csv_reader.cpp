// Reader of CSV captures: one sample per row, one line per column; as written by sigrok-cli, Saleae and similar tools.
//
//     ; Channels (2/2): A, B          comments begin with ';' or '#'; sigrok's name the channels
//     META samplerate: 1000000        sigrok
//     Time [s],A,B                    a header is a row without values; its first column may be the time
//     0.000001,0,1
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <motionrack/decode/sampler.hpp>

namespace motionrack::decode {

namespace {

constexpr double tick = 1e-12;  ///< unit of times: a picosecond
constexpr double max_duration_s = 4e6;
constexpr std::size_t rows_looked_at = 8;
constexpr std::size_t max_columns = 4096;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '"')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '"')) text.remove_suffix(1);
    return text;
}

/// '0', '1', 'x' for X, Z and unknown; 0 for any other text.
char level_of(std::string_view cell) {
    if (cell.empty()) return 'x';
    if (cell.size() > 1) return 0;
    if (cell[0] == '0' || cell[0] == '1') return cell[0];
    return std::string_view("xXzZuU-?").find(cell[0]) != std::string_view::npos ? 'x' : '\0';
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

/// Seconds per unit of a time column, by its name; 0 if it is not a time.
double time_unit(std::string_view cell) {
    const std::string name = lower(cell);
    static constexpr std::array<std::pair<std::string_view, double>, 5> sigrok = {{{"seconds", 1},
                                                                                   {"milliseconds", 1e-3},
                                                                                   {"microseconds", 1e-6},
                                                                                   {"nanoseconds", 1e-9},
                                                                                   {"picoseconds", 1e-12}}};
    for (const auto& [unit, seconds] : sigrok)
        if (name == unit) return seconds;
    if (name != "t" && name.rfind("time", 0) != 0 && name.rfind("t ", 0) != 0 && name.rfind("t_", 0) != 0 &&
        name.rfind("t[", 0) != 0)
        return 0;
    const auto has = [&](std::string_view unit) {
        const std::size_t at = name.rfind(unit);
        return at != std::string::npos && at > 0 &&
               std::string_view("[(_ ").find(name[at - 1]) != std::string_view::npos &&
               name.find_first_of("abcdefghijklmnopqrstuvwxyz", at + unit.size()) == std::string::npos;
    };
    return has("ms") ? 1e-3 : has("us") || has("\xC2\xB5s") ? 1e-6 : has("ns") ? 1e-9 : has("ps") ? 1e-12 : 1;
}

class CsvCapture final : public Capture {
  public:
    CsvCapture(std::unique_ptr<Source> source, const std::string& name)
        : Capture(std::move(source), name), text_(*source_) {
        format_ = Format::csv;
    }
    Result<void> read_head(double rate_hz);
    void choose(const std::vector<std::size_t>& signals) override;
    Result<bool> next(SampleBlock& block) override;
    std::uint64_t bytes_read() const override { return text_.bytes(); }

  private:
    struct Row {
        std::string text;
        TextPosition location;
        bool cut = false;
    };

    bool next_row(Row& row);
    bool take_comment(std::string_view text);
    void split(std::string_view text);
    Result<void> take_head();
    bool looks_timed(const std::vector<Row>& rows);
    Result<void> take(const Row& row);
    Result<std::int64_t> time_of(std::string_view cell, TextPosition location) const;

    TextReader text_;
    Sampler sampler_;
    std::vector<Row> waiting_;  ///< rows read to identify the columns, the last first
    std::vector<std::string_view> cells_;
    std::vector<std::string> named_;    ///< by sigrok's comment
    std::vector<std::size_t> columns_;  ///< column of each chosen line
    char separator_ = ',';
    std::size_t width_ = 0;  ///< number of columns
    std::size_t first_ = 0;  ///< column of the first line
    double unit_s_ = 1, rate_hz_ = 0;
    std::int64_t now_ = 0;
    bool begun_ = false;
};

/// Returns false if the row is not a comment; stores the rate and channels of a comment.
bool CsvCapture::take_comment(std::string_view text) {
    if (text.rfind("META samplerate:", 0) == 0) {
        if (const auto rate = read_rate(trimmed(text.substr(16)))) rate_hz_ = *rate;
        return true;
    }
    if (trimmed(text).empty()) return true;
    if (text[0] != ';' && text[0] != '#') return false;
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) return true;
    const std::string_view rest = text.substr(colon + 2);
    if (text.find("Channels (") != std::string_view::npos) {
        separator_ = ',';
        split(rest);
        named_.assign(cells_.begin(), cells_.end());
    }
    if (lower(text.substr(0, colon)).find("samplerate") != std::string::npos)
        if (const auto rate = read_rate(rest)) rate_hz_ = *rate;
    return true;
}

/// The next row that is not a comment.
bool CsvCapture::next_row(Row& row) {
    std::string_view line;
    while (text_.line(line)) {
        if (text_.location().line == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.remove_prefix(3);
        if (take_comment(line)) continue;
        row.text.assign(line);
        row.location = text_.location();
        row.cut = text_.cut();
        return true;
    }
    return false;
}

void CsvCapture::split(std::string_view text) {
    cells_.clear();
    for (std::size_t at = 0; at <= text.size() && cells_.size() <= max_columns;) {
        const std::size_t end = std::min(text.find(separator_, at), text.size());
        cells_.push_back(trimmed(text.substr(at, end - at)));
        at = end + 1;
    }
}

Result<void> CsvCapture::read_head(double rate_hz) {
    std::vector<Row> rows;
    for (Row row; rows.size() < rows_looked_at && next_row(row);) rows.push_back(row);
    if (text_.error()) return tl::unexpected(in_file(*text_.error()));
    if (rows.empty()) return refuse("The file has no rows. Nothing was decoded.", {});
    std::ptrdiff_t max_count = 0;
    for (const char candidate : {',', ';', '\t'}) {
        const auto found = std::count(rows[0].text.begin(), rows[0].text.end(), candidate);
        if (found > max_count) max_count = found, separator_ = candidate;
    }
    split(rows[0].text);
    width_ = cells_.size();
    if (width_ > max_columns)
        return refuse(fmt::format("A row has more than {} columns. Nothing was decoded.", max_columns),
                      rows[0].location);
    const bool head = std::any_of(cells_.begin(), cells_.end(), [](std::string_view cell) {
        return level_of(cell) == 0 && cell.find_first_not_of("0123456789+-.,eE") != std::string_view::npos;
    });
    if (head) {
        MOTIONRACK_CHECK(take_head());
        rows.erase(rows.begin());
    } else {
        timed_ = looks_timed(rows);
        first_ = timed_ ? 1 : 0;
        for (std::size_t i = first_; i < width_; ++i)
            signals_.push_back(named_.size() == width_ - first_ ? named_[i - first_] : fmt::format("{}", i - first_));
    }
    if (signals_.empty()) return refuse("The file has no column with a line. Nothing was decoded.", {1, 1});
    if (rate_hz > 0) rate_hz_ = rate_hz;
    if (!timed_ && !(rate_hz_ > 0))
        return refuse(
            "The file has no times and no sample rate. Nothing was decoded; add --sample-rate "
            "1M, for instance.",
            {});
    tick_s_ = timed_ ? tick : 1 / rate_hz_;
    waiting_.assign(rows.rbegin(), rows.rend());
    return {};
}

/// Takes the cells as names of columns.
Result<void> CsvCapture::take_head() {
    if (cells_.size() == 3 && time_unit(cells_[0]) > 0 && cells_[1] == "signal" && cells_[2] == "value")
        return refuse("This is a list of changes, a signal a row. Nothing was decoded; record a VCD file instead.",
                      {1, 1});
    const double unit = time_unit(cells_[0]);
    timed_ = unit > 0;
    unit_s_ = timed_ ? unit : 1;
    first_ = timed_ || cells_[0] == "samples" ? 1 : 0;
    for (std::size_t i = first_; i < width_; ++i)
        signals_.emplace_back(cells_[i] == "logic" && named_.size() == width_ - first_ ? named_[i - first_]
                                                                                       : std::string(cells_[i]));
    return {};
}

/// True if the first column of a file without a header is the time: it contains a value that is not a level.
bool CsvCapture::looks_timed(const std::vector<Row>& rows) {
    bool timed = false;
    for (const Row& row : rows) {
        split(row.text);
        timed = timed || (cells_.size() > 1 && level_of(cells_[0]) == 0);
    }
    return timed;
}

void CsvCapture::choose(const std::vector<std::size_t>& signals) {
    Capture::choose(signals);
    columns_.clear();
    for (const std::size_t signal : signals) columns_.push_back(signal + first_);
    sampler_.begin(signals.size());
}

Result<std::int64_t> CsvCapture::time_of(std::string_view cell, TextPosition location) const {
    std::string text(cell);
    if (separator_ != ',') std::replace(text.begin(), text.end(), ',', '.');
    double time = 0;
    const char* const first = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const auto [end, bad] = std::from_chars(first, text.data() + text.size(), time);
    const double seconds = time * unit_s_;
    if (bad != std::errc() || end != text.data() + text.size() || !std::isfinite(seconds) ||
        std::fabs(seconds) > max_duration_s)
        return refuse(
            fmt::format(
                "'{}' is not a time in seconds (up to {:.0f}). Nothing more was decoded; export the time as a number.",
                text.substr(0, 40), max_duration_s),
            location);
    return std::llround(seconds / tick);
}

Result<void> CsvCapture::take(const Row& row) {
    split(row.text);
    if (cells_.size() == width_ + 1 && cells_.back().empty()) cells_.pop_back();
    if (cells_.size() != width_)
        return refuse(
            fmt::format("The row has {} columns, the first row {}. Nothing more was decoded.", cells_.size(), width_),
            row.location);
    std::int64_t time = 0;
    if (timed_) {
        MOTIONRACK_TRY(time, time_of(cells_[0], row.location));
        if (begun_ && time < now_)
            return refuse(fmt::format("Time goes backwards, from {} s to {} s. Nothing more was decoded; the file is "
                                      "damaged or is two files.",
                                      static_cast<double>(now_) * tick, static_cast<double>(time) * tick),
                          row.location);
    }
    for (std::size_t line = 0; line < columns_.size(); ++line) {
        const std::string_view cell = cells_[columns_[line]];
        const char level = level_of(cell);
        if (level == 0)
            return refuse(
                fmt::format(
                    "Column {} holds '{}'; a level is 0, 1, x or z. Nothing more was decoded; export digital lines.",
                    columns_[line] + 1, cell.substr(0, 40)),
                row.location);
        if (level != 'x')
            sampler_.set(line, level == '1', facts_[line]);
        else if (sampler_.lose(line, facts_[line]) && facts_[line].unknown == 1)
            facts_[line].first_unknown = fmt::format("line {}", row.location.line);
    }
    now_ = time;
    begun_ = true;
    sampler_.take(time);
    return {};
}

Result<bool> CsvCapture::next(SampleBlock& block) {
    Row row;
    while (!sampler_.full() && !cut_) {
        if (!waiting_.empty()) {
            row = std::move(waiting_.back());
            waiting_.pop_back();
        } else if (!next_row(row)) {
            if (text_.error()) return tl::unexpected(in_file(*text_.error()));
            break;
        }
        const Result<void> done = take(row);
        if (done) continue;
        if (!row.cut) return tl::unexpected(done.error());
        cut_ =
            Error{ErrorKind::invalid_input,
                  "The file ends inside a row: it is cut off. The rows before that were decoded.", name_, row.location};
    }
    if (sampler_.waiting() == 0) return false;
    sampler_.hand_over(block, timed_);
    return true;
}

}  // namespace

Result<std::unique_ptr<Capture>> open_csv(std::unique_ptr<Source> source, const std::string& name,
                                          const CaptureSettings& settings) {
    auto capture = std::make_unique<CsvCapture>(std::move(source), name);
    MOTIONRACK_CHECK(capture->read_head(settings.sample_rate_hz));
    return capture;
}

}  // namespace motionrack::decode
