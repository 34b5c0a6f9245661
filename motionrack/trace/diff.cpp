// Chooses the comparison for two files and prints its result.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/diff_parts.hpp>
#include <motionrack/trace/file_bytes.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t differences_shown = 10, names_shown = 10;

const char* name_of_kind(FileKind kind) {
    switch (kind) {
        case FileKind::hdf5:
            return "a recording (HDF5)";
        case FileKind::vcd:
            return "a VCD file";
        case FileKind::csv:
            break;
    }
    return "a CSV file";
}

bool is_table_of_changes(const CsvRows& rows) {
    return rows.head() == std::vector<std::string>{"time_s", "signal", "value"};
}

}  // namespace

Result<FileKind> kind_of_file(const std::string& path) {
    MOTIONRACK_TRY(FileBytes bytes, FileBytes::open(path));
    int first = bytes.get();
    if (first < 0) return fail(ErrorKind::invalid_input, "The file is empty.", {}, path);
    if (first == 0x89) return FileKind::hdf5;
    while (first == ' ' || first == '\t' || first == '\r' || first == '\n') first = bytes.get();
    if (first == '$') return FileKind::vcd;
    if (first >= 0x20 && first < 0x7F) return FileKind::csv;
    return fail(ErrorKind::invalid_input, "Unknown file format. The file must be HDF5, VCD or CSV.", {}, path);
}

void sort_differences(Diff& diff) {
    std::stable_sort(diff.differences.begin(), diff.differences.end(),
                     [](const Difference& a, const Difference& b) { return a.at < b.at; });
}

Result<Diff> diff_files(const std::string& a, const std::string& b, const DiffSettings& settings) {
    MOTIONRACK_TRY(const FileKind kind, kind_of_file(a));
    MOTIONRACK_TRY(const FileKind other, kind_of_file(b));
    if (kind != other)
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} is {}, {} is {}; only files of the same kind can be compared.", a,
                                name_of_kind(kind), b, name_of_kind(other)));
    if (kind == FileKind::hdf5) {
        MOTIONRACK_TRY(const RecordingReader of_a, RecordingReader::open(a));
        MOTIONRACK_TRY(const RecordingReader of_b, RecordingReader::open(b));
        return diff_recordings(of_a, of_b, settings);
    }
    if (kind == FileKind::vcd) return diff_changes(a, b, kind, settings);
    MOTIONRACK_TRY(const CsvRows rows_a, CsvRows::open(a));
    MOTIONRACK_TRY(const CsvRows rows_b, CsvRows::open(b));
    if (is_table_of_changes(rows_a) && is_table_of_changes(rows_b)) return diff_changes(a, b, kind, settings);
    return diff_tables(a, b, settings);
}

namespace {

std::string time_text(const Difference& one) {
    if (!one.at) return "at no instant";
    return fmt::format("at {:.10f} s ({} ns, tick {})", to_seconds(*one.at),
                       fmt::format("{}.{}", one.at->count() / 10, one.at->count() % 10), one.at->count());
}

std::string list_text(const std::vector<std::string>& names) {
    std::string out;
    for (std::size_t i = 0; i < names.size() && i < names_shown; ++i) out += (i == 0 ? "" : ", ") + names[i];
    return names.size() > names_shown ? out + fmt::format(" and {} more", names.size() - names_shown) : out;
}

}  // namespace

std::string diff_text(const Diff& diff, const std::string& a, const std::string& b) {
    std::string out = fmt::format("A  {}\nB  {}\n", a, b);
    const std::string how_far = diff.until ? fmt::format(" up to {:.6f} s", to_seconds(*diff.until)) : "";
    if (diff.same() && !diff.stopped)
        return out + fmt::format("The two {} are the same{}: {} signals, {} values.\n", diff.kind, how_far,
                                 diff.signals, diff.compared);
    for (const std::string& sentence : diff.made_of) out += fmt::format("  {}\n", sentence);
    if (!diff.only_a.empty()) out += fmt::format("  only A has {}: {}\n", diff.only_a.size(), list_text(diff.only_a));
    if (!diff.only_b.empty()) out += fmt::format("  only B has {}: {}\n", diff.only_b.size(), list_text(diff.only_b));
    if (diff.differences.empty())
        out += fmt::format("The {} signals of the two {} are the same{}: {} values.\n", diff.signals, diff.kind,
                           how_far, diff.compared);
    else
        out += fmt::format("{} of {} signals differ{}. The first difference:\n", diff.differences.size(), diff.signals,
                           how_far);
    for (std::size_t i = 0; i < diff.differences.size() && i < differences_shown; ++i) {
        const Difference& one = diff.differences[i];
        if (i == 1) out += "The first differences of the other signals:\n";
        const std::string unit = one.unit.empty() ? "" : ", " + one.unit;
        out += fmt::format("  {}{}, {}\n    A: {}\n    B: {}\n", one.signal, unit, time_text(one), one.a, one.b);
    }
    if (diff.differences.size() > differences_shown)
        out += fmt::format("  and {} more signals\n", diff.differences.size() - differences_shown);
    return out;
}

std::string diff_json(const Diff& diff, const std::string& a, const std::string& b) {
    nlohmann::ordered_json json = {{"a", a},
                                   {"b", b},
                                   {"kind", diff.kind},
                                   {"same", diff.same()},
                                   {"signals", diff.signals},
                                   {"values", diff.compared}};
    if (diff.until) json["until_s"] = to_seconds(*diff.until);
    json["differing"] = diff.differences.size();
    json["only_a"] = diff.only_a;
    json["only_b"] = diff.only_b;
    json["made_of"] = diff.made_of;
    json["notes"] = diff.notes;
    json["differences"] = nlohmann::ordered_json::array();
    for (const Difference& one : diff.differences) {
        nlohmann::ordered_json each = {{"signal", one.signal}, {"unit", one.unit}, {"a", one.a}, {"b", one.b}};
        if (one.at) {
            each["time_s"] = to_seconds(*one.at);
            each["ticks"] = one.at->count();
        }
        json["differences"].push_back(std::move(each));
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace motionrack::trace
