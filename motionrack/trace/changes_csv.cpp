// Reads changes from a CSV table.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/csv_rows.hpp>

namespace motionrack::trace {

bool read_ps(std::string_view seconds, std::int64_t& ps) {
    static constexpr std::int64_t a_second = 1'000'000'000'000, max_seconds = 8'640'000;
    std::int64_t whole = 0, part = 0, place = a_second;
    std::size_t i = 0;
    for (; i < seconds.size() && seconds[i] >= '0' && seconds[i] <= '9' && whole <= max_seconds; ++i)
        whole = whole * 10 + (seconds[i] - '0');
    if (i == 0 || whole > max_seconds) return false;
    if (i < seconds.size() && seconds[i] == '.')
        for (++i; i < seconds.size() && seconds[i] >= '0' && seconds[i] <= '9'; ++i)
            part += (place /= 10) * (seconds[i] - '0');
    ps = whole * a_second + part;
    if (i == seconds.size()) return true;
    const double value = number_of(seconds);  // "1e-05"
    if (!(value >= 0 && value <= static_cast<double>(max_seconds))) return false;
    ps = static_cast<std::int64_t>(std::floor(value * 1e12 + 0.5));
    return true;
}

namespace {

class CsvChanges final : public ChangeSource {
  public:
    CsvChanges(CsvRows rows, std::string path, SignalNames& names)
        : rows_(std::move(rows)), path_(std::move(path)), names_(names) {}

    Result<bool> next(SignalChange& change) override {
        MOTIONRACK_TRY(const bool any, rows_.next(fields_));
        if (!any) return false;
        const auto refuse = [&](const char* what) {
            return fail(ErrorKind::invalid_input, what, {rows_.line(), 0}, path_);
        };
        if (!read_ps(fields_[0], change.at_ps)) return refuse("The time must be 0 to 8640000 seconds.");
        if (change.at_ps < last_)
            return refuse("The time is earlier than the previous one. Nothing was compared; times must not decrease.");
        last_ = change.at_ps;
        change.signal = names_.number(fields_[1]);
        change.value = fields_[2];
        return true;
    }
    double part() const override { return rows_.part(); }
    bool cut() const override { return rows_.cut(); }

  private:
    CsvRows rows_;
    std::string path_;
    SignalNames& names_;
    std::vector<std::string> fields_;
    std::int64_t last_ = 0;
};

}  // namespace

Result<std::unique_ptr<ChangeSource>> open_csv_changes(const std::string& path, SignalNames& names) {
    MOTIONRACK_TRY(CsvRows rows, CsvRows::open(path));
    if (rows.head() != std::vector<std::string>{"time_s", "signal", "value"})
        return fail(ErrorKind::invalid_input,
                    "The file is not a table of changes: its header is not time_s,signal,value.", {1, 0}, path);
    return std::make_unique<CsvChanges>(std::move(rows), path, names);
}

}  // namespace motionrack::trace
