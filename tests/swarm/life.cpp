// Runs the lives of a machine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <motionrack/base/fnv.hpp>
#include <motionrack/journal/test/bad_disk.hpp>
#include <motionrack/operate/journal_writer.hpp>
#include <motionrack/operate/machine.hpp>
#include <tests/invariants/watch.hpp>
#include <tests/swarm/life.hpp>
#include <tests/swarm/order.hpp>
#include <tests/swarm/racks.hpp>
#include <utility>
#include <vector>

namespace motionrack::swarm {

namespace {

using journal::BadDisk;
using operate::InitialAxisState;
using operate::Machine;
using operate::MachineState;
using operate::Status;
using test::Finding;
using test::Rule;
using Order = test::Invariants::Order;
namespace fs = std::filesystem;

enum class Ending : std::uint8_t { clean, killed, power };
constexpr std::array ending_names = {"ends clean", "is killed", "loses power"};

constexpr std::size_t events_kept = 12;
/// mm: tolerance of a recorded valid position; of a servo that of the card's position lock
constexpr double stepper_tolerance = 0.05, servo_tolerance = 0.35;
/// Steps lost this shortly before the end are not detected.
constexpr Duration found_within = milliseconds(100);

class Lives {
  public:
    Lives(std::uint64_t seed, std::string folder) : draws_(seed), folder_(std::move(folder)) {
        config_ = draw_rack(draws_, out_.what);
    }

    SeedEnd drive() {
        const int lives = 1 + draws_.pick(3);
        for (int i = 0; i < lives && !out_.finding; ++i) live(i, i + 1 == lives);
        return std::move(out_);
    }

  private:
    struct Taken {
        std::int64_t number;
        std::string text;
    };

    void live(int life, bool last) {
        const std::string path = folder_ + "/journal.db";
        BadDisk::Plan plan;
        ending_ = last                            ? Ending::clean
                  : draws_.one_in(2)              ? Ending::clean
                  : life == 0 && draws_.one_in(2) ? Ending::power
                                                  : Ending::killed;
        if (!last && ending_ != Ending::power && draws_.one_in(4)) {
            constexpr std::array faults = {BadDisk::Fault::fail, BadDisk::Fault::stay, BadDisk::Fault::tear};
            plan = {faults[static_cast<std::size_t>(draws_.pick(3))], 1 + draws_.pick(150)};
        }
        out_.what += fmt::format("; {}{}", plan.nth > 0 ? fmt::format("disk fails at {}, ", plan.nth) : "",
                                 ending_names[static_cast<std::size_t>(ending_)]);
        if (plan.nth > 0 || ending_ == Ending::power) out_.repeats = false;
        ++out_.lives;
        const BadDisk disk(plan);
        lose_power_after_ = 0;
        disk_ = &disk;
        run(path, last);
        if (ending_ == Ending::power) {
            std::mt19937 luck(static_cast<std::uint32_t>(draws_.raw()));
            disk.write_state(lose_power_after_, luck, path, folder_ + "/found.db");
            for (const char* end : {"", "-journal", "-wal", "-shm", ".lock"}) {
                fs::remove(path + end);
                if (fs::exists(folder_ + "/found.db" + end)) fs::rename(folder_ + "/found.db" + end, path + end);
            }
        }
    }

    void run(const std::string& path, bool last) {
        auto opened = journal::Journal::open(path);
        if (!opened) return;  // the disk fails; the file stays unchanged
        journal_ = std::move(*opened);
        look_for_taken();
        operate::MachineSettings settings;
        settings.initial_axes = standing();
        settings.pace = [this](Instant now) { return pace(now), !stands(); };
        settings.on_status = [this](const Status& status) { see(status); };
        auto made = Machine::make(config_, std::move(settings));
        if (!made) return found({Rule::usable_again, {}, made.error().message});
        machine_ = std::move(*made);
        book_.emplace(*journal_);
        machine_->listen([](const Status&) {},
                         [this](const operate::StopReport& report) {
                             if (book_) book_->stopped(report);
                         });
        watch_.emplace(*machine_, [this](const Finding& finding) { found(finding); });
        if (!draws_.one_in(5)) make_ready();
        ends_ = from_seconds(draws_.number(0.2, 2.5));
        next_ = Instant{};
        is_last_ = last;
        phase_ = 0;
        disturbed_.reset();
        finished_ = forbidden_ = stood_ = false;
        machine_->run();
        end();
    }

    /// Prepares the machine for work, as an operator does first.
    void make_ready() {
        test::Invariants& laws = watch_->invariants();
        EXPECT_TRUE(machine_->enable(true));
        laws.ordered(Order::enable);
        if (draws_.one_in(4)) return;
        for (const InitialAxisState& axis : truth_.empty() ? places() : truth_) {
            static_cast<void>(machine_->manual().set_position(axis.letter, axis.true_position));
            laws.ordered(Order::position);
        }
    }

    std::vector<InitialAxisState> places() const {
        std::vector<InitialAxisState> out;
        for (const operate::AxisStatus& axis : machine_->status().axes)
            out.push_back({axis.letter, axis.true_position, axis.true_position, false});
        return out;
    }

    void end() {
        truth_ = places();
        lost_at_end_ = disturbed_ && machine_->now() - *disturbed_ < found_within;
        book_.reset();
        cut_off_ = forbidden_ || ending_ != Ending::clean;
        // An end that could not be written may exist nevertheless.
        if (journal_ && ending_ == Ending::clean) (void)journal_->close();
        journal_.reset();
        watch_.reset();
        machine_.reset();
    }

    /// Axis positions at the start of the next life: as left, with the validity in the journal.
    std::vector<InitialAxisState> standing() {
        std::vector<InitialAxisState> out = truth_;
        if (!journal_->before()) return out;
        for (const InitialAxisState& kept : operate::read_last(*journal_->before(), config_).axes) {
            const auto real = std::find_if(out.begin(), out.end(),
                                           [&](const InitialAxisState& one) { return one.letter == kept.letter; });
            if (real == out.end() || !kept.position_valid) continue;
            if (cut_off_)
                found({Rule::position_is_true,
                       {},
                       fmt::format("the position of axis {} is valid after a run that did not end by itself",
                                   kept.letter)});
            if (std::fabs(kept.true_position - real->true_position) > tolerance() && !lost_at_end_)
                found({Rule::position_is_true,
                       {},
                       fmt::format("the record has axis {} at {:.4f}, it stands at {:.4f}", kept.letter,
                                   kept.true_position, real->true_position)});
            real->commanded = kept.commanded;
            real->position_valid = true;
        }
        return out;
    }

    void look_for_taken() {
        const auto entries = journal_->read({0, "command", 10'000});
        if (!entries) return;  // the disk fails
        for (const Taken& one : taken_) {
            const auto there = std::find_if(entries->begin(), entries->end(),
                                            [&](const journal::Entry& entry) { return entry.number == one.number; });
            if (there == entries->end() || there->text != one.text)
                found({Rule::nothing_taken_is_missing,
                       {},
                       fmt::format("entry {} ({}) was acknowledged and is not in the journal", one.number, one.text)});
        }
    }

    // ---- during the run

    void see(const Status& status) {
        if (book_) book_->see(status);
        if (!out_.repeats) return;
        hash(static_cast<std::uint64_t>(status.at.count()));
        hash(static_cast<std::uint64_t>(status.state));
        for (const operate::AxisStatus& axis : status.axes) hash(static_cast<std::uint64_t>(axis.pulses));
    }

    /// Simulates a paused clock: returns true if the same instant is to be repeated, with a status and possibly
    /// commands. Never pauses during a stop, because the invariants count the statuses until the axes decelerate.
    bool stands() {
        const bool may = machine_ && !stood_ && !finished_ && !machine_->rack().stop_latch().latched();
        return stood_ = may && draws_.one_in(20);
    }

    void pace(Instant now) {
        if (!machine_) return;
        if (out_.finding) return finish();
        look_at_journal();
        while (now >= next_ && now < ends_) {
            if (draws_.one_in(7))
                break_something();
            else
                order(draw_order(draws_));
            if (draws_.one_in(8)) continue;  // another one in the same slice
            next_ += from_seconds(draws_.one_in(3) ? draws_.number(0.1, 0.5) : draws_.number(0, 0.05));
        }
        if (now < ends_) return;
        if (is_last_ && !forbidden_)
            use_again(now);
        else
            finish();
    }

    void finish() {
        if (std::exchange(finished_, true)) return;
        if (ending_ != Ending::clean) {  // later events are not in the journal
            lose_power_after_ = disk_->calls();
            book_.reset();
            journal_.reset();
        }
        machine_->quit();
    }

    /// Checks the journal, as a server does.
    void look_at_journal() {
        if (forbidden_ || !journal_) return;
        const std::string failure = journal_->failure();
        if (failure.empty()) return;
        forbidden_ = true;
        machine_->forbid_starts("journal", failure);
    }

    void order(const DrawnOrder& drawn) {
        const Result<void> taken = drawn.give(*machine_, draws_);
        out_.refused += !taken;
        tell(fmt::format("{}{}", drawn.name, taken ? "" : ": " + taken.error().message));
        if (!taken) return;
        ++out_.taken;
        if (drawn.changes) watch_->invariants().ordered(*drawn.changes);
        hash(fnv_of(drawn.name));
        acknowledge(fmt::format("{} {}", drawn.name, out_.taken));
    }

    /// Answers the command once its entry is on disk.
    void acknowledge(const std::string& text) {
        if (!journal_) return;
        std::promise<Result<std::int64_t>> written;
        journal_->write(machine_->now(), "command", text, {},
                        [&written](const Result<std::int64_t>& number) { written.set_value(number); });
        const Result<std::int64_t> number = written.get_future().get();
        if (number) taken_.push_back({*number, text});
        look_at_journal();
    }

    void break_something() {
        const DrawnFault fault = draw_fault(*machine_, draws_);
        if (fault.text.empty()) return;
        ++out_.faults;
        tell(fault.text);
        watch_->invariants().switch_disturbed();
        if (fault.text.find(".hang") != std::string::npos) watch_->invariants().hung();
        if (!fault.disturbs) return;
        watch_->invariants().disturbed();
        disturbed_ = machine_->now();
    }

    /// Clears and resets all faults; then the machine must execute commands.
    void use_again(Instant now) {
        if (now < wait_until_) return;
        wait_until_ = now + milliseconds(300);
        test::Invariants& laws = watch_->invariants();
        switch (phase_++) {
            case 0:
                mend_all(*machine_);
                laws.disturbed();
                laws.switch_disturbed();
                machine_->stop();
                laws.ordered(Order::stop);
                wait_until_ = now + whole_seconds(runs_out() ? 8 : 2);
                return;
            case 1:
                machine_->reset();
                laws.ordered(Order::reset);
                return;
            case 2:
                (void)machine_->enable(true);
                laws.ordered(Order::enable);
                machine_->programs().set_overrides(1, 1);
                machine_->programs().set_single_block(false);
                return;
            case 3:
                for (const operate::AxisStatus& axis : machine_->status().axes) {
                    (void)machine_->manual().set_position(axis.letter, axis.true_position);
                    laws.ordered(Order::position);
                }
                return;
            case 4: {
                laws.ordered(Order::motion);
                const Result<void> begun = machine_->begin_program("G90 G53 G0 X12\nG53 G0 X15\nM2\n", "again.ngc");
                if (!begun) found({Rule::usable_again, now, begun.error().message});
                wait_until_ = now + whole_seconds(12);
                return;
            }
            default: {
                const Status& status = machine_->status();
                const double place = status.axes.front().true_position;
                if (status.state != MachineState::standstill || std::fabs(place - 15) > tolerance())
                    found({Rule::usable_again, now,
                           fmt::format("it was sent to X 15 and is at {:.4f} in the state '{}': {}", place,
                                       operate::name_of(status.state), status.reason)});
                return finish();
            }
        }
    }

    /// A servo without voltage decelerates to a stop by friction.
    bool runs_out() const { return config_.axes.front().servo.has_value(); }
    double tolerance() const { return runs_out() ? servo_tolerance : stepper_tolerance; }

    /// Prints an event for diagnosis.
    void tell(const std::string& event) {
        const operate::AxisStatus& first = machine_->status().axes.front();
        out_.story.push_back(fmt::format("{:9.4f} s, {}, {} {:.4f}{}: {}", to_seconds(machine_->now()),
                                         operate::name_of(machine_->status().state), first.letter, first.commanded,
                                         first.position_valid ? "" : "?", event));
        if (out_.story.size() > events_kept) out_.story.pop_front();
    }
    void found(const Finding& finding) {
        if (!out_.finding && machine_) tell("found; " + machine_->status().reason);
        if (!out_.finding) out_.finding = finding;
    }
    void hash(std::uint64_t value) {
        if (out_.repeats) out_.history = fnv_step(out_.history, value);
    }

    Draws draws_;
    std::string folder_;
    SeedEnd out_;
    rack::RackConfig config_;
    std::vector<InitialAxisState> truth_;  ///< axis positions at the end of the previous life
    std::vector<Taken> taken_;
    bool cut_off_ = false, lost_at_end_ = false;  ///< in the previous life
    // of one life
    Ending ending_ = Ending::clean;
    bool is_last_ = false;
    const BadDisk* disk_ = nullptr;
    std::int64_t lose_power_after_ = 0;
    std::unique_ptr<journal::Journal> journal_;
    std::optional<operate::JournalWriter> book_;
    std::unique_ptr<Machine> machine_;
    std::optional<test::MachineWatch> watch_;
    Instant next_{}, ends_{}, wait_until_{};
    std::optional<Instant> disturbed_;  ///< time of the last fault
    int phase_ = 0;                     ///< state of use_again()
    bool forbidden_ = false, finished_ = false;
    bool stood_ = false;  ///< the clock was paused in the last slice
};

}  // namespace

SeedEnd drive_seed(std::uint64_t seed, const std::string& folder) {
    return Lives(seed, folder).drive();
}

}  // namespace motionrack::swarm
