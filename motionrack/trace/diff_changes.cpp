// Compares two files of changes: at each instant with a change, compares the values of both.
#include <algorithm>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/diff_parts.hpp>

namespace motionrack::trace {

namespace {

constexpr std::uint64_t changes_between_looks = 1 << 16;

/// One of the two files: its next change and its current signal values.
struct Side {
    std::unique_ptr<ChangeSource> source;
    SignalChange next;
    bool more = false;
    std::vector<std::string> values;
    std::vector<bool> known;

    Result<void> step() {
        MOTIONRACK_TRY(more, source->next(next));
        return {};
    }
    void grow(std::size_t size) {
        if (values.size() >= size) return;
        values.resize(size);
        known.resize(size);
    }
    /// Applies the changes at this instant.
    Result<void> take(std::int64_t at_ps, const SignalNames& names, std::vector<std::size_t>& touched,
                      std::uint64_t& taken) {
        while (more && next.at_ps == at_ps) {
            grow(names.size());
            values[next.signal] = next.value;
            known[next.signal] = true;
            touched.push_back(next.signal);
            ++taken;
            MOTIONRACK_CHECK(step());
        }
        return {};
    }
};

std::string shown_change(const std::string& value) {
    return value.empty() ? "no value yet" : value;
}

class Comparison {
  public:
    Comparison(Side& a, Side& b, SignalNames& names) : a_(a), b_(b), names_(names) {}

    Result<void> run(Diff& diff, const DiffSettings& settings) {
        MOTIONRACK_CHECK(a_.step());
        MOTIONRACK_CHECK(b_.step());
        std::uint64_t rounds = 0, taken_by_b = 0;
        while (a_.more || b_.more) {
            const std::int64_t at =
                a_.more && (!b_.more || a_.next.at_ps <= b_.next.at_ps) ? a_.next.at_ps : b_.next.at_ps;
            touched_.clear();
            MOTIONRACK_CHECK(a_.take(at, names_, touched_, diff.compared));
            MOTIONRACK_CHECK(b_.take(at, names_, touched_, taken_by_b));
            a_.grow(names_.size());
            b_.grow(names_.size());
            differs_.resize(names_.size());
            for (const std::size_t signal : touched_) compare(signal, at, diff);
            if (++rounds % changes_between_looks != 0) continue;
            if (settings.progress) settings.progress(a_.source->part());
            if (settings.stop && settings.stop()) {
                diff.stopped = true;
                break;
            }
        }
        report_missing(diff);
        return {};
    }

  private:
    void compare(std::size_t signal, std::int64_t at_ps, Diff& diff) {
        if (differs_[signal] || a_.values[signal] == b_.values[signal]) return;
        differs_[signal] = true;
        diff.differences.push_back({names_.name(signal), Instant{at_ps / 100}, shown_change(a_.values[signal]),
                                    shown_change(b_.values[signal]), ""});
    }

    /// Reports signals that only one file has; these are not signal differences.
    void report_missing(Diff& diff) {
        for (const std::size_t signal : a_.source->declared()) a_.known[signal] = true;
        for (const std::size_t signal : b_.source->declared()) b_.known[signal] = true;
        std::vector<std::string> missing;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (a_.known[i] && b_.known[i]) {
                ++diff.signals;
                continue;
            }
            (a_.known[i] ? diff.only_a : diff.only_b).push_back(names_.name(i));
            missing.push_back(names_.name(i));
        }
        auto& all = diff.differences;
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&](const Difference& one) {
                                     return std::find(missing.begin(), missing.end(), one.signal) != missing.end();
                                 }),
                  all.end());
    }

    Side& a_;
    Side& b_;
    SignalNames& names_;
    std::vector<std::size_t> touched_;
    std::vector<bool> differs_;
};

}  // namespace

Result<Diff> diff_changes(const std::string& a, const std::string& b, FileKind kind, const DiffSettings& settings) {
    const auto open = kind == FileKind::vcd ? open_vcd_changes : open_csv_changes;
    SignalNames names;
    Side side_a, side_b;
    MOTIONRACK_TRY(side_a.source, open(a, names));
    MOTIONRACK_TRY(side_b.source, open(b, names));
    side_a.grow(names.size());
    side_b.grow(names.size());
    Diff diff;
    diff.kind = kind == FileKind::vcd ? "VCD files" : "tables of changes";
    MOTIONRACK_CHECK(Comparison(side_a, side_b, names).run(diff, settings));
    for (const auto& [side, path] : {std::pair<const Side&, const std::string&>(side_a, a), {side_b, b}})
        if (side.source->cut()) diff.notes.push_back(path + " does not end with a line: it was cut off.");
    sort_differences(diff);
    return diff;
}

}  // namespace motionrack::trace
