// libFuzzer: waveforms as files, VCD and CSV. The first byte selects the kind of the rest:
//
//  0  any VCD file    it is rejected with a position in the text, or times never decrease and each line has a level in
//  1  any CSV file    each sample; reading in pieces of any size gives the same
//  2  changes         written as VCD and as tables, they give the same levels at the same instants
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <motionrack/decode/capture.hpp>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/csv_writer.hpp>
#include <motionrack/trace/vcd_writer.hpp>
#include <tests/fuzz/scratch_file.hpp>

namespace {

using namespace motionrack;
using decode::Capture;
using decode::SampleBlock;
using fuzz::require;
using fuzz::ScratchFile;

constexpr std::size_t max_chosen = 8, max_samples = 1 << 16;

// ---- content of a capture

/// Returns at most `step` bytes at a time.
class Pieces final : public decode::Source {
  public:
    Pieces(std::string_view text, std::size_t step) : text_(text), step_(step) {}
    Result<std::size_t> read(char* to, std::size_t size) override {
        const std::size_t count = text_.copy(to, std::min(size, step_));
        text_.remove_prefix(count);
        return count;
    }
    std::uint64_t total() const override { return 0; }

  private:
    std::string_view text_;
    std::size_t step_;
};

struct Reading {
    std::string error, cut;
    std::vector<std::string> signals;
    double tick_s = 0;
    std::vector<std::int64_t> times;
    std::vector<std::uint32_t> levels;  ///< one word per sample, one bit per signal
    std::vector<std::string> facts;
    bool operator==(const Reading&) const = default;
};

void take(const SampleBlock& block, std::size_t chosen, Reading& out) {
    require(block.samples > 0 && block.bytes == nullptr && block.planes.size() == chosen,
            "a block has samples of all lines that were chosen");
    for (std::size_t i = 0; i < block.samples && out.levels.size() < max_samples; ++i) {
        std::uint32_t levels = 0;
        for (std::size_t line = 0; line < chosen; ++line)
            levels |= static_cast<std::uint32_t>(block.planes[line][i / 64] >> (i % 64) & 1) << line;
        const std::int64_t time = block.times != nullptr ? block.times[i] : static_cast<std::int64_t>(out.times.size());
        require(out.times.empty() || time >= out.times.back(), "time never goes back");
        out.times.push_back(time);
        out.levels.push_back(levels);
    }
}

std::string error_text(const Error& error, std::string_view text) {
    require(!error.message.empty() && error.file == "fuzz", "an error has a sentence and the file", error.text());
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    require(error.location.line >= 0 && error.location.line <= lines && error.location.column >= 0,
            "the place of an error is in the text", error.text());
    return error.text();
}

void read_samples(Capture& capture, std::string_view text, Reading& out) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < std::min(max_chosen, out.signals.size()); ++i) chosen.push_back(i);
    capture.choose(chosen);
    for (SampleBlock block;;) {
        const Result<bool> more = capture.next(block);
        if (!more) {
            out.error = error_text(more.error(), text);
            break;
        }
        if (!*more) break;
        take(block, chosen.size(), out);
    }
    if (capture.cut()) out.cut = error_text(*capture.cut(), text);
    for (std::size_t line = 0; line < chosen.size(); ++line) {
        const decode::LineFacts& facts = capture.facts(line);
        require((facts.unknown > 0) == !facts.first_unknown.empty(), "where a line was unknown first is told");
        require(facts.known_from != decode::LineFacts::never || facts.unknown == 0, "a line is lost that had a level");
        out.facts.push_back(fmt::format("{} {} {}", facts.known_from, facts.unknown, facts.first_unknown));
    }
}

Reading read_capture(std::string_view text, bool is_vcd, double rate_hz, std::size_t step) {
    Reading out;
    decode::CaptureSettings settings;
    settings.sample_rate_hz = rate_hz;
    auto source = std::make_unique<Pieces>(text, step);
    const auto capture =
        is_vcd ? decode::open_vcd(std::move(source), "fuzz") : decode::open_csv(std::move(source), "fuzz", settings);
    if (!capture) {
        out.error = error_text(capture.error(), text);
        return out;
    }
    out.signals = (*capture)->signals();
    out.tick_s = (*capture)->tick_s();
    require(out.tick_s > 0, "a tick takes some time");
    read_samples(**capture, text, out);
    return out;
}

void check_text(std::string_view text, bool is_vcd, std::uint8_t how) {
    const double rate_hz = (how & 1) != 0 ? 1e6 : 0;
    const Reading whole = read_capture(text, is_vcd, rate_hz, text.size() + 1);
    require(whole == read_capture(text, is_vcd, rate_hz, 1 + (how >> 1)), "the size of pieces changes nothing",
            whole.error);
}

// ---- written files

constexpr int wires = 2, bits = 3, line_count = wires + bits;

/// Levels from a time unit on: bits 0 and 1 are the wires, 2 to 4 the vector, most significant bit first.
using Waves = std::map<std::int64_t, std::uint32_t>;

std::uint32_t vector_of(std::uint32_t levels) {
    return (levels >> 2 & 1) << 2 | (levels >> 3 & 1) << 1 | (levels >> 4 & 1);
}

Waves waves_of(std::string_view bytes) {
    Waves out{{0, 0}};
    std::int64_t unit = 0;
    for (; bytes.size() >= 2; bytes.remove_prefix(2)) {
        const auto step = static_cast<std::uint8_t>(bytes[0]), levels = static_cast<std::uint8_t>(bytes[1]);
        unit += (step & 0xF) << (step >> 4);  // 0 to 491,520
        out[unit] = levels & ((1u << line_count) - 1);
    }
    return out;
}

/// Removes repeated levels; keeps the first instant of each.
Waves without_repeats(const Waves& waves) {
    Waves out;
    for (const auto& [unit, levels] : waves)
        if (out.empty() || out.rbegin()->second != levels) out[unit] = levels;
    return out;
}

void check_same(const Waves& wanted, const Waves& seen, std::string_view law) {
    const Waves a = without_repeats(wanted), b = without_repeats(seen);
    const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (differs.first == a.end() && differs.second == b.end()) return;
    const auto text = [](auto at, auto end) {
        return at == end ? std::string("nothing") : fmt::format("{:x} at {}", at->second, at->first);
    };
    require(false, law, fmt::format("{} instead of {}", text(differs.second, b.end()), text(differs.first, a.end())));
}

void write_vcd(const Waves& waves, Duration unit, const std::string& path) {
    auto vcd = trace::VcdWriter::create(path, {unit, false, "$end"});
    require(vcd.has_value(), "a VCD file can be made");
    vcd->push_scope("top $end");
    const auto a = vcd->add_wire("a"), b = vcd->add_wire("a"), v = vcd->add_vector("9 v", bits);
    vcd->pop_scope();
    for (const auto& [at, levels] : waves) {
        vcd->change(a, levels & 1, at * unit);
        vcd->change(b, levels >> 1 & 1, at * unit);
        vcd->change(v, vector_of(levels), at * unit);
    }
    const auto closed = vcd->close(waves.rbegin()->first * unit);
    require(closed.has_value(), "a VCD file can be closed", closed ? "" : closed.error().text());
}

void write_table(const Waves& waves, Duration unit, const std::string& path) {
    auto csv = trace::CsvWriter::create(path, {"time_s", "signal", "value"});
    require(csv.has_value(), "a table can be made");
    for (const auto& [at, levels] : waves) {
        const std::int64_t ticks = (at * unit).count();
        for (const auto& [name, value] :
             {std::pair{"a", levels & 1}, std::pair{"a_2", levels >> 1 & 1}, std::pair{"_9_v", vector_of(levels)}}) {
            csv->add(fmt::format("{}.{:010}", ticks / 10'000'000'000, ticks % 10'000'000'000));
            csv->add(std::string("top__end.") + name);
            csv->add(static_cast<std::int64_t>(value));
            csv->end_line();
        }
    }
    require(csv->close().has_value(), "a table can be closed");
}

/// Rows of levels, as exported by a logic analyser.
std::string rows_of(const Waves& waves, Duration unit) {
    std::string out = "Time [s],A,B,C,D,E\n";
    for (const auto& [at, levels] : waves) {
        const std::int64_t ticks = (at * unit).count();
        out += fmt::format("{}.{:010}", ticks / 10'000'000'000, ticks % 10'000'000'000);
        for (int line = 0; line < line_count; ++line) out += fmt::format(",{}", levels >> line & 1);
        out += '\n';
    }
    return out;
}

/// Changes as read by `diff`.
Waves changes_of(const std::string& path, bool is_vcd, std::int64_t unit_ps) {
    trace::SignalNames names;
    const auto source = is_vcd ? trace::open_vcd_changes(path, names) : trace::open_csv_changes(path, names);
    require(source.has_value(), "changes that were written are read", source ? "" : source.error().text());
    Waves out;
    std::uint32_t levels = 0;
    for (trace::SignalChange change;;) {
        const auto more = (*source)->next(change);
        require(more.has_value(), "a change that was written is read", more ? "" : more.error().text());
        if (!*more) break;
        require(change.at_ps % unit_ps == 0, "a change is at a whole unit of time");
        const std::string& name = names.name(change.signal);
        if (name == "top__end.a") levels = (levels & ~1u) | (change.value == "1");
        if (name == "top__end.a_2") levels = (levels & ~2u) | (change.value == "1") << 1;
        if (name == "top__end._9_v") {
            const auto value = static_cast<std::uint32_t>(std::stoul(change.value, nullptr, is_vcd ? 2 : 10));
            levels = (levels & 3) | (value >> 2 & 1) << 2 | (value >> 1 & 1) << 3 | (value & 1) << 4;
        }
        out[change.at_ps / unit_ps] = levels;
    }
    return out;
}

Waves samples_of(const Reading& reading, std::int64_t ticks_per_unit) {
    require(reading.error.empty() && reading.cut.empty(), "a capture that was written is read", reading.error);
    require(reading.signals.size() == line_count, "a capture has the lines that were written");
    Waves out;
    for (std::size_t i = 0; i < reading.times.size(); ++i) {
        require(reading.times[i] % ticks_per_unit == 0, "a sample is at a whole unit of time");
        out[reading.times[i] / ticks_per_unit] = reading.levels[i];
    }
    return out;
}

void check_written(std::string_view bytes, std::uint8_t how) {
    static const ScratchFile file("fuzz.vcd");
    file.clear();
    const Waves waves = waves_of(bytes.substr(0, 2000));
    std::int64_t ticks = 1;  // of 100 ps, per unit
    for (int i = how % 4; i > 0; --i) ticks *= 10;
    const Duration unit{ticks};
    write_vcd(waves, unit, file.path());
    write_table(waves, unit, file.beside("fuzz.csv"));
    check_same(waves, samples_of(read_capture(file.bytes(), true, 0, 4096), 1), "a VCD file has the levels written");
    check_same(waves, samples_of(read_capture(rows_of(waves, unit), false, 0, 4096), ticks * 100),
               "rows of levels are read as they are");
    check_same(waves, changes_of(file.path(), true, ticks * 100), "a VCD file has the changes written");
    check_same(waves, changes_of(file.beside("fuzz.csv"), false, ticks * 100), "a table has the changes written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::string_view rest(reinterpret_cast<const char*>(data) + 2, size - 2);
    if (data[0] % 3 == 2)
        check_written(rest, data[1]);
    else
        check_text(rest, data[0] % 3 == 0, data[1]);
    return 0;
}
