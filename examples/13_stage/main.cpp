// A scan and a step stage whose loops are closed by two cards: how far they are apart when the cards read one instant,
// and when they do not.
//
//   stage MACHINE.toml [PICTURE.svg]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/grating.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/trace/svg.hpp>

using namespace motionrack;

namespace {

constexpr double ratio = 4;          // the mask's picture is four times as large as the wafer's
constexpr double warm_up_s = 0.018;  // until the scan is at its speed

/// Differences from the rack file, and a fault.
struct Trial {
    std::string name;
    bool hosts = false;                 ///< all three cards are hosts, without checks
    std::array<double, 3> offset_us{};  ///< of their clocks
    double drift_ppm = 0;               ///< of the clock of card "step"
    double control_delay_us = 20;
    std::string fault;  ///< of card "step", at 0.25 s
};

/// Measured values: at each pulse, and their totals.
struct Record {
    std::vector<double> seconds;
    std::vector<float> mask_mm, apart_nm, seen_nm;
    double peak_nm = 0, squares = 0;
    int scanning = 0;
};

rack::RackConfig with(rack::RackConfig config, const Trial& trial) {
    std::size_t host = 0;
    for (rack::RackCard& card : config.cards) {
        if (card.type != "grating_bus" || !trial.hosts) continue;
        auto& settings = card.settings.edit<rack::GratingBusSettings>();
        settings.role = rack::GratingRole::host;
        settings.verify_lines = false;
        settings.offset_ns = 1e3 * trial.offset_us[host++];
        if (card.name == "step") settings.period_us *= 1 + 1e-6 * trial.drift_ppm;
    }
    for (rack::RackStage& stage : config.stages) stage.servo->control_delay_us = trial.control_delay_us;
    return config;
}

/// Looks at each pulse where the stages really are, which no card knows.
class Experiment {
  public:
    Experiment(const rack::RackConfig& config, const Trial& trial)
        : trial_(trial), rack_(with(config, trial)), mask_(*rack_.stage("scan_x")), wafer_(*rack_.stage("step_x")) {
        rack_.start();
    }

    void run(Duration time) {
        for (Instant t{}; t < time; t += microseconds(200)) {
            while (rack_.kernel().run_until(t) == sim::RunEnd::broken) {  // a card's interrupt
            }
            if (t == milliseconds(250) && !trial_.fault.empty())
                if (const auto done = rack::inject_fault(rack_, trial_.fault, "step"); !done)
                    fmt::print("{}\n", done.error().text());
            poll(t);
        }
    }

    void print() {
        const auto seen = [](const rack::RunningStage& stage) { return length(stage.loop()->error().peak_nm); };
        fmt::print("{}\n", trial_.name);
        fmt::print("  following error that the cards see, at most: scan_x {}, step_x {}\n", seen(mask_), seen(wafer_));
        fmt::print("  scan_x - 4 step_x in truth, while scanning: at most {}, rms {}\n", length(record_.peak_nm),
                   length(std::sqrt(record_.squares / record_.scanning)));
        fmt::print("  conflicts on the bus {}, frames that card step refused {}\n",
                   rack::grating_bus_of(rack_)->lines().all_conflicts(),
                   rack::grating_card_of(rack_, "step")->counter(grating_bus::Card::broken));
        for (const rack::RunningStage& stage : rack_.stages())
            if (!stage.loop()->closed()) fmt::print("  {} is open\n", stage.config.name);
    }
    const Record& record() const { return record_; }

  private:
    static std::string length(double nm) {
        return nm < 1e5 ? fmt::format("{:.0f} nm", nm) : fmt::format("{:.1f} mm", nm * 1e-6);
    }

    void poll(Instant t) {
        const double mask = mask_.motor->position_nm(t), apart = mask - ratio * wafer_.motor->position_nm(t),
                     seconds = to_seconds(t);
        record_.seconds.push_back(seconds);
        record_.mask_mm.push_back(static_cast<float>(mask * 1e-6));
        record_.apart_nm.push_back(static_cast<float>(apart));
        record_.seen_nm.push_back(static_cast<float>(mask_.loop()->error().last_nm));
        if (mask_.wanted(seconds).accel_nm_s2 != 0 || seconds < warm_up_s) return;
        record_.peak_nm = std::max(record_.peak_nm, std::fabs(apart));
        record_.squares += apart * apart;
        ++record_.scanning;
    }

    Trial trial_;
    rack::Rack rack_;
    rack::RunningStage& mask_;
    rack::RunningStage& wafer_;
    Record record_;
};

std::string picture(const Record& one, const Record& three) {
    const std::vector<trace::SvgSpan> spans = {
        {"to", 0.018, 0.268}, {"fro", 0.296, 0.546}, {"to", 0.574, 0.824}, {"fro", 0.852, 1.102}};
    const std::vector<trace::SvgChart> charts = {
        {"mask, mm", {{"", "z", one.seconds, one.mask_mm}}, {}},
        {"mask - 4 x wafer, nm: host and two slaves (red), three hosts (green)",
         {{"", "x", one.seconds, one.apart_nm}, {"", "y", three.seconds, three.apart_nm}},
         {}},
        {"following error that the mask's card sees, nm",
         {{"", "x", one.seconds, one.seen_nm}, {"", "y", three.seconds, three.seen_nm}},
         {}}};
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
    std::array<Trial, 5> trials;
    trials[0].name = "host and two slaves";
    trials[1].name = "host and two slaves, processors that need 180 us";
    trials[1].control_delay_us = 180;
    trials[2].name = "host and two slaves, card step 5 us late from 0.25 s on";
    trials[2].fault = "late=5000";
    trials[3].name = "three hosts, clocks 3 and 7 us apart";
    trials[3].hosts = true, trials[3].offset_us = {0, 3, 7};
    trials[4] = trials[3];
    trials[4].name = "three hosts, one clock 5 ppm fast";
    trials[4].drift_ppm = -5;
    std::vector<Record> records;
    for (const Trial& trial : trials) {
        Experiment experiment(*machine.config, trial);
        experiment.run(milliseconds(1'150));
        experiment.print();
        records.push_back(experiment.record());
    }
    if (count > 2)
        if (const auto done = trace::write_text(picture(records[0], records[3]), words[2]); !done)
            return failed(done.error());
}
