// A scan and a step stage whose loops are closed by two cards: how far they are apart when the cards read one instant, and when they do not.
//
//   stage MACHINE.toml [PICTURE.svg]
#include <motionrack/trace/svg.hpp>

#include "machine.hpp"

using namespace stage;

namespace {

const char* words_of(gb::LoopState state) {
    switch (state) {
        case gb::LoopState::stale:
            return "no frame for two periods";
        case gb::LoopState::too_far:
            return "more than 0.1 mm off";
        default:
            return "closed";
    }
}

std::string length(double nm) {
    return nm < 1e5 ? fmt::format("{:.0f} nm", nm) : fmt::format("{:.1f} mm", nm * 1e-6);
}

void print(const Trial& trial, const Record& r) {
    fmt::print("{}\n", trial.name);
    fmt::print("  following error that the cards see, at most: scan.x {}, step.x {}\n", length(r.seen_peak_nm[scan_x]),
               length(r.seen_peak_nm[step_x]));
    fmt::print("  scan.x - 4 step.x in truth, while scanning: at most {}, rms {}\n", length(r.peak_apart_nm), length(r.rms_apart_nm()));
    fmt::print("  conflicts on the bus {}, frames that card step refused {}\n", r.conflicts, r.bad_frames);
    for (std::size_t n = 0; n < axis_count; ++n)
        if (r.states[n] != gb::LoopState::closed) fmt::print("  {} opened its loop at {:.4f} s: {}\n", axis_names[n], to_seconds(r.opened[n]), words_of(r.states[n]));
}

std::string picture(const gb::ScanProfile& scan, const Record& one, const Record& three) {
    std::vector<trace::SvgSpan> spans;
    const double half = scan.period_s() / 2;
    for (int k = 0; scan.lead_s() + half * k < one.seconds.back(); ++k)
        spans.push_back({k % 2 == 0 ? "to" : "fro", scan.lead_s() + half * k, std::min(scan.lead_s() + half * k + 0.25, one.seconds.back())});
    const std::vector<trace::SvgChart> charts = {
        {"mask, mm", {{"", "z", one.seconds, one.scan_mm}}, {}},
        {"mask - 4 x wafer, nm: host and two slaves (red), three hosts (green)", {{"", "x", one.seconds, one.apart_nm}, {"", "y", three.seconds, three.apart_nm}}, {}},
        {"following error that the mask's card sees, nm", {{"", "x", one.seconds, one.seen_nm}, {"", "y", three.seconds, three.seen_nm}}, {}}};
    return trace::svg_timeline("Scan and step stage", charts, spans, {.width = 720, .height = 640, .standalone = true});
}

int failed(const Error& error) {
    fmt::print("{}\n", error.text());
    return 1;
}

}  // namespace

int main(int count, char** words) {
    const rack::RackReading machine = rack::read_rack_file(count > 1 ? words[1] : "machine.toml");
    if (!machine.config) return failed(machine.errors.front());
    const std::array<Trial, 5> trials = {{
        {.name = "host and two slaves"},
        {.name = "host and two slaves, processors that need 180 us", .compute = microseconds(180)},
        {.name = "host and two slaves, card step 5 us late from 0.25 s on", .late_ns = 5'000},
        {.name = "three hosts, clocks 3 and 7 us apart", .hosts = true, .offset_us = {0, 3, 7}},
        {.name = "three hosts, one clock 5 ppm fast", .hosts = true, .offset_us = {0, 3, 7}, .drift_ppm = -5},
    }};
    std::vector<Record> records;
    for (const Trial& trial : trials) {
        records.push_back(Machine(*machine.config, trial).run(milliseconds(1'150)));
        print(trial, records.back());
    }
    if (count > 2)
        if (const auto done = trace::write_text(picture(Machine(*machine.config, {}).scan(), records[0], records[3]), words[2]); !done) return failed(done.error());
}
