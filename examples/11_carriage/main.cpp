// A transfer carriage by the card's own commands: A to C fast and held there, C gently to B, back to A at limited
// speed. Then once more with an end stop whose contact opens on the way, and once with the emergency button.
//
//   A 0 ───────────── B 128000 ───────────── C 256000 counts of 0.01 mm
//
//   carriage MACHINE.toml [PICTURE.svg]
#include <fmt/format.h>

#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/trace/svg.hpp>

using namespace motionrack;
namespace db = databoard4002;

namespace {

constexpr std::int64_t a = 0, b = 128'000, c = 256'000;
constexpr double counts_per_mm = 100;

/// What the pen writes down every 5 ms.
struct Record {
    std::vector<double> seconds;
    std::vector<float> mm, mm_s, volts;
    std::vector<trace::SvgSpan> legs;
};

class Carriage {
  public:
    Carriage(const rack::RackConfig& config, const std::vector<std::string>& faults)
        : rack_(config), driver_(port(), port(), {.counts_per_mm = counts_per_mm}) {
        faults_ = *rack::FaultSchedule::create(rack_, faults);
        rack_.start();
        faults_->begin();
        rack_.on_slice(milliseconds(5), [this] { write_down(); });
        scale_ = {.analog = true, .counts_per_volt = config.axes[0].servo->velocity_per_volt * counts_per_mm};
    }

    Result<void> run() {
        MOTIONRACK_CHECK(driver_.connect());
        MOTIONRACK_CHECK(leg("A-C", c, 100'000, max_rate));
        MOTIONRACK_CHECK(driver_.set_deviation(25));
        MOTIONRACK_CHECK(driver_.lock());
        port().pass(whole_seconds(1));
        MOTIONRACK_CHECK(leg("C-B", b, 30'000, max_rate));
        port().pass(milliseconds(500));
        return leg("B-A", a, 100'000, scale_.rate_for(10'000));
    }
    /// After a stop: waits until the carriage stands and the button is released, then goes to A slowly. (The table
    /// counts the way from where a positioning begins: begun while the carriage still runs the other way, it would
    /// creep back to that place first.)
    Result<void> go_home() {
        port().pass(milliseconds(300));
        while (driver_.status().emergency()) port().pass(milliseconds(10));
        const std::string stops = driver_.status().stops();
        fmt::print("  {}; back to A slowly\n", stops.empty() ? "every stop is released" : stops);
        return leg("to A", a, 100'000, scale_.rate_for(10'000));
    }
    const Record& record() const { return record_; }

  private:
    static constexpr int max_rate = db::max_rate;

    sim::VirtualBytePort& port() { return *rack_.card("board")->byte_port(); }

    /// One positioning with a slope of its own; what the table says of it beforehand, and how long it took.
    Result<void> leg(const char* name, std::int64_t target, double counts_s2, int rate) {
        const db::SlopeDemand demand{.top_speed = 49'000,
                                     .acceleration = counts_s2,
                                     .deceleration = counts_s2,
                                     .creep_speed = 300,
                                     .lag_s = 0.01};
        MOTIONRACK_TRY(const db::SlopeTable table, db::design_slope(demand, scale_));
        MOTIONRACK_TRY(const std::int64_t here, driver_.position());
        MOTIONRACK_TRY(const db::SlopeMotion motion, db::motion_of(table, std::abs(target - here), rate, scale_));
        MOTIONRACK_CHECK(driver_.set_slope(table));
        MOTIONRACK_CHECK(driver_.on_regulation());
        MOTIONRACK_CHECK(driver_.set_rate(rate));
        const Instant from = port().now();
        Result<void> moved = driver_.move_to(target, whole_seconds(60), db::Waiting::interrupt);
        const double took = to_seconds(port().now() - from);
        record_.legs.push_back({fmt::format("{} {:.2f} s", name, took), to_seconds(from), to_seconds(port().now())});
        if (!moved) return moved;
        port().pass(milliseconds(100));  // it comes to rest
        MOTIONRACK_TRY(const std::int64_t there, driver_.position());
        fmt::print(
            "  {:<5} {:>7} counts  by the table {:6.3f} s, took {:6.3f} s, at most {:3.0f} mm/s, stands {:+d} counts "
            "from its target\n",
            name, std::abs(target - here), motion.duration_s, took, motion.top_speed / counts_per_mm,
            static_cast<int>(there - target));
        return {};
    }

    void write_down() {
        faults_->apply_due();
        const rack::RunningAxis& axis = rack_.axes()[0];
        const Instant now = rack_.kernel().now();
        record_.seconds.push_back(to_seconds(now));
        record_.mm.push_back(static_cast<float>(axis.machine->position(now)));
        record_.mm_s.push_back(static_cast<float>(axis.velocity(now)));
        record_.volts.push_back(static_cast<float>(axis.servo->volts()));
    }

    rack::Rack rack_;
    std::unique_ptr<rack::FaultSchedule> faults_;
    db::Driver driver_;
    db::SpeedScale scale_;
    Record record_;
};

std::string picture(const Record& r) {
    const std::vector<trace::SvgChart> charts = {{"position, mm", {{"", "z", r.seconds, r.mm}}, {}},
                                                 {"velocity, mm/s", {{"", "y", r.seconds, r.mm_s}}, {}},
                                                 {"voltage at the amplifier, V", {{"", "x", r.seconds, r.volts}}, {}}};
    return trace::svg_timeline("Transfer carriage", charts, r.legs, {.width = 720, .height = 620, .standalone = true});
}

int failed(const Error& error) {
    fmt::print("{}\n", error.text());
    return 1;
}

}  // namespace

int main(int count, char** words) {
    const rack::RackReading machine = rack::read_rack_file(count > 1 ? words[1] : "machine.toml");
    if (!machine.config) return failed(machine.errors.front());
    fmt::print("as it should be\n");
    Carriage good(*machine.config, {});
    if (const auto done = good.run(); !done) return failed(done.error());
    if (count > 2)
        if (const auto done = trace::write_text(picture(good.record()), words[2]); !done) return failed(done.error());

    // The contact of the right end stop opens at 2 s; the button is pressed at 9 s and turned out again two seconds
    // later.
    for (const std::vector<std::string>& faults :
         {std::vector<std::string>{"X.limit_plus=0@2s"}, {"estop=0@9s", "estop=release@11s"}}) {
        fmt::print("with {}\n", fmt::join(faults, ", "));
        Carriage carriage(*machine.config, faults);
        if (const auto done = carriage.run(); !done) fmt::print("  {}\n", done.error().message);
        if (const auto done = carriage.go_home(); !done) return failed(done.error());
    }
}
