// Tests of the exact register accesses of the function library, on a recording port.
#include <gtest/gtest.h>

#include <functional>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <string>
#include <vector>

namespace motionrack::mcx314 {
namespace {

struct PortAccess {
    char kind;  ///< 'w' or 'r'
    std::uint32_t offset;
    std::uint16_t value;
    friend bool operator==(const PortAccess&, const PortAccess&) = default;
};
std::ostream& operator<<(std::ostream& out, const PortAccess& access) {
    return out << access.kind << access.offset << '=' << std::hex << access.value << std::dec;
}

/// Records all accesses; reads return `levels`. Time passes only during waits.
class Notebook final : public RegisterPort, public Interrupt {
  public:
    void write(std::uint32_t offset, std::uint16_t value) override { list.push_back({'w', offset, value}); }
    std::uint16_t read(std::uint32_t offset) override {
        list.push_back({'r', offset, levels[offset / 2]});
        return levels[offset / 2];
    }
    bool wait(Duration timeout) override {
        ++waits;
        if (line_stuck) return true;
        now_ += timeout;
        return false;
    }
    void pass(Duration duration) override { now_ += duration; }
    Instant now() const override { return now_; }
    bool stop_requested() const override { return stop; }

    std::vector<PortAccess> take() { return std::exchange(list, {}); }
    std::vector<PortAccess> list;
    std::array<std::uint16_t, 8> levels = {};
    std::int64_t waits = 0;
    bool line_stuck = false;
    bool stop = false;

  private:
    Instant now_{};
};

PortAccess w0(unsigned axes, unsigned code) {
    return {'w', reg::WR0, static_cast<std::uint16_t>(axes << 8 | code)};
}
PortAccess w(std::uint32_t offset, unsigned value) {
    return {'w', offset, static_cast<std::uint16_t>(value)};
}

class DriverTraffic : public testing::Test {
  protected:
    Notebook port_;
    Driver driver_{port_, port_};
};

TEST_F(DriverTraffic, DataGoesHighWordLowWordCommand) {
    EXPECT_TRUE(driver_.Pulse(axis_x | axis_u, -0x1234567));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w(reg::WR7, 0x0123), w(reg::WR6, 0x4567), w0(9, cmd::P)}));
    EXPECT_TRUE(driver_.LPS(axis_y, -2));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w(reg::WR7, 0xFFFF), w(reg::WR6, 0xFFFE), w0(2, cmd::LP)}));
}

TEST_F(DriverTraffic, ChoosesTheSmallestSufficientMultiple) {
    struct Case {
        std::int64_t speed, range;
    };
    for (const Case& one : {Case{1, 8'000'000}, Case{8'000, 8'000'000}, Case{8'001, 4'000'000}, Case{24'000, 2'666'666},
                            Case{3'999'999, 16'000}, Case{4'000'000, 16'000}}) {
        EXPECT_TRUE(driver_.SetMaxSpeed(one.speed));
        EXPECT_EQ(driver_.written(2, cmd::R), one.range) << one.speed;
        EXPECT_GE(8'000 * driver_.multiple(0), static_cast<double>(one.speed));
    }
    EXPECT_TRUE(driver_.SetMultiple(axis_z, 500));
    EXPECT_EQ(driver_.written(2, cmd::R), 16'000);
    EXPECT_EQ(driver_.written(1, cmd::R), 16'000);
}

struct Switch {
    const char* name;
    Result<void> (Driver::*call)(int, unsigned);
    std::uint16_t mask;
};

TEST_F(DriverTraffic, EachSignalFunctionChangesItsOwnBitOnly) {
    const std::vector<Switch> switches = {{"HLMTP", &Driver::HLMTP, 0x0008},
                                          {"HLMTM", &Driver::HLMTM, 0x0010},
                                          {"HLMTSig", &Driver::HLMTSig, 0x0004},
                                          {"SLMTP", &Driver::SLMTP, 0x0001},
                                          {"SLMTM", &Driver::SLMTM, 0x0002},
                                          {"SLMTSig", &Driver::SLMTSig, 0x0020},
                                          {"EncoderMode", &Driver::EncoderMode, 0x0200},
                                          {"EnableALM", &Driver::EnableALM, 0x2000},
                                          {"EnableInPos", &Driver::EnableInPos, 0x8000},
                                          {"ALMSig", &Driver::ALMSig, 0x1000},
                                          {"InPosSig", &Driver::InPosSig, 0x4000}};
    for (const std::uint16_t before : std::initializer_list<std::uint16_t>{0x0000, 0xFFFF, 0x5AA5})
        for (const Switch& one : switches) {
            driver_.WriteMode2(xyzu, before);
            port_.take();
            EXPECT_TRUE((driver_.*one.call)(1, axis_y));
            EXPECT_TRUE((driver_.*one.call)(0, axis_z));
            const auto set = static_cast<std::uint16_t>(before | one.mask),
                       cleared = static_cast<std::uint16_t>(before & ~one.mask);
            EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w0(2, cmd::NOP), w(reg::WR2, set), w0(4, cmd::NOP),
                                                             w(reg::WR2, cleared)}))
                << one.name;
            EXPECT_EQ(driver_.mode2(0), before) << one.name;
        }
    driver_.WriteMode2(xyzu, 0xF3FF);
    EXPECT_TRUE(driver_.EncoderCWCCW(2, axis_x));
    EXPECT_EQ(driver_.mode2(0), 0xFBFF);
    EXPECT_TRUE(driver_.SetPulseMode(axis_x, 0));
    EXPECT_EQ(driver_.mode2(0), 0xFBBF);
    EXPECT_TRUE(driver_.SetPulseLevels(axis_x, false, false));
    EXPECT_EQ(driver_.mode2(0), 0xFA3F);
}

TEST_F(DriverTraffic, StopInputsInterruptsAndOutputs) {
    EXPECT_TRUE(driver_.SetStopInput(axis_x, 0, StopInput::at_low));
    EXPECT_EQ(driver_.mode1(0), 0x0002);
    EXPECT_TRUE(driver_.SetStopInput(axis_x, 2, StopInput::at_high));
    EXPECT_EQ(driver_.mode1(0), 0x0032);
    EXPECT_TRUE(driver_.EnableInterrupt(axis_x, cause::drive_end | cause::pulse));
    EXPECT_EQ(driver_.mode1(0), 0x8132);
    EXPECT_TRUE(driver_.DisableInterrupt(axis_x, cause::pulse));
    EXPECT_TRUE(driver_.SetStopInput(axis_x, 2, StopInput::off));
    EXPECT_EQ(driver_.mode1(0), 0x8002);
    EXPECT_TRUE(driver_.SetExternalDrive(axis_x, ExternalDrive::fixed));
    EXPECT_EQ(driver_.mode3(0), 0x0010);
    EXPECT_TRUE(driver_.ShowDriveStatus(axis_x, true));
    EXPECT_TRUE(driver_.SetOutput(axis_x, 5, true));
    EXPECT_EQ(driver_.mode3(0), 0x0290);
    port_.take();
    EXPECT_TRUE(driver_.SetOutput(axis_x | axis_u, 2, true));
    EXPECT_TRUE(driver_.SetOutput(axis_y, 0, true));
    EXPECT_TRUE(driver_.SetOutput(axis_u, 2, false));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w(reg::WR4, 0x4004), w(reg::WR4, 0x4014), w(reg::WR4, 0x0014)}));
}

TEST_F(DriverTraffic, InputsAreDecodedForEachAxis) {
    port_.levels[4] = 0x5A00;  // Y: IN1, IN3, EXPP, INPOS
    port_.levels[5] = 0x00A5;  // Z: IN0, IN2, EXPM, ALARM
    const InputLevels y = driver_.inputs(1), z = driver_.inputs(2), u = driver_.inputs(3);
    EXPECT_EQ(y.in, (std::array<bool, 4>{false, true, false, true}));
    EXPECT_TRUE(y.expp && y.in_position && !y.expm && !y.alarm);
    EXPECT_EQ(z.in, (std::array<bool, 4>{true, false, true, false}));
    EXPECT_TRUE(z.expm && z.alarm && !z.expp && !z.in_position);
    EXPECT_EQ(u.in, (std::array<bool, 4>{}));
}

TEST_F(DriverTraffic, DrivesOfTwoDirectionsAreHeldAndReleasedTogether) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 1));
    for (const auto set : {&Driver::SetSV, &Driver::SetV, &Driver::SetA}) EXPECT_TRUE((driver_.*set)(xyzu, 5));
    EXPECT_TRUE(driver_.Pulse(axis_x | axis_z, 9));
    EXPECT_TRUE(driver_.Pulse(axis_y, -9));
    EXPECT_TRUE(driver_.DriveFixed(7));
    const std::vector<PortAccess> all = port_.take();
    const std::vector<PortAccess> last(all.end() - 4, all.end());
    EXPECT_EQ(last, (std::vector<PortAccess>{w0(7, cmd::HOLD), w0(5, cmd::FIXED_PLUS), w0(2, cmd::FIXED_MINUS),
                                             w0(7, cmd::START)}));
}

TEST_F(DriverTraffic, ConstantVectorSpeedDoesNotChangeTheRangeOfALaterSingleAxisDrive) {
    EXPECT_TRUE(driver_.SetRange(4'000'000));
    EXPECT_TRUE(driver_.SetVectorSpeed(2));
    port_.take();
    EXPECT_TRUE(driver_.Line2D_C({0, 100, 0, 0, 0, {10'000, 10'000}}, 0x3));
    EXPECT_EQ(driver_.written(1, cmd::R), 5'656'854);
    const std::vector<PortAccess> all = port_.take();
    EXPECT_EQ(all[all.size() - 2], w(reg::WR5, 0x0104));
    EXPECT_EQ(all.back(), w0(0, cmd::LINE2));
    EXPECT_DOUBLE_EQ(driver_.multiple(1), 2);
    EXPECT_TRUE(driver_.TCurve_F(axis_y, 1, 100, 10, 5));
    EXPECT_EQ(driver_.written(1, cmd::R), 4'000'000);
}

/// The order of the accesses is that of the maker's sample: patterns on, data, stack, .., start, .., patterns off.
TEST_F(DriverTraffic, ABitPatternIsStackedStartedAndClosed) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 1));
    EXPECT_TRUE(driver_.BP2D({0, 100, 0, 0}, 0x6));
    EXPECT_EQ(driver_.written(1, cmd::V), 100);
    std::vector<PortAccess> all = port_.take();
    EXPECT_EQ(std::vector<PortAccess>(all.end() - 3, all.end()),
              (std::vector<PortAccess>{w(reg::WR5, 0x0009), w0(0, cmd::BP_CLEAR), w0(0, cmd::BP_ENABLE)}));
    EXPECT_FALSE(driver_.BPStart());
    const BPWORD word{{0x1111, 0x2222, 0x3333}, {0x4444, 0x5555, 0x6666}};
    EXPECT_TRUE(driver_.BPStack(word));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{{'r', reg::RR0, 0},
                                                     w(0x04, 0x1111),
                                                     w(0x06, 0x4444),
                                                     w(0x08, 0x2222),
                                                     w(0x0A, 0x5555),
                                                     w0(0, cmd::BP_STACK)}));
    EXPECT_TRUE(driver_.BPStart());
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w0(0, cmd::BP2)}));
    // Registers that share their offsets with those of the pattern are accessible nevertheless.
    EXPECT_TRUE(driver_.SetV(axis_x, 7));
    EXPECT_TRUE(driver_.HLMTP(1, axis_x));
    EXPECT_TRUE(driver_.SetOutput(axis_x, 0, true));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w0(0, cmd::BP_DISABLE), w(reg::WR7, 0), w(reg::WR6, 7),
                                                     w0(1, cmd::V), w0(0, cmd::BP_ENABLE), w0(0, cmd::BP_DISABLE),
                                                     w0(1, cmd::NOP), w(reg::WR2, 8), w0(0, cmd::BP_ENABLE),
                                                     w0(0, cmd::BP_DISABLE), w(reg::WR4, 1), w0(0, cmd::BP_ENABLE)}));
    // Y and Z drive and three words are stacked: the stack stays full until the timeout.
    port_.levels[0] = 0x6006;
    const Result<void> full = driver_.BPStack(word, milliseconds(1));
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("had no room for 0.001 s"), std::string::npos);
    // The drive ended before its next word was stacked.
    port_.levels[0] = 0;
    port_.take();
    const Result<void> late = driver_.BPStack(word);
    ASSERT_FALSE(late);
    EXPECT_NE(late.error().message.find("came too late"), std::string::npos);
    EXPECT_EQ(port_.take()[1], w0(0, cmd::BP_DISABLE));
    EXPECT_FALSE(driver_.BPEnd());
}

TEST_F(DriverTraffic, ThreeAxesOfAPatternUseAllItsRegisters) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 1));
    EXPECT_TRUE(driver_.BP3D({5, 100, 50, 40}, 0xD));
    EXPECT_EQ(driver_.mode3(0), field("WR3", "MANLD").mask);
    EXPECT_EQ(driver_.written(0, cmd::DP), 40);
    port_.take();
    EXPECT_TRUE(driver_.BPStack({{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{{'r', reg::RR0, 0},
                                                     w(0x04, 1),
                                                     w(0x06, 4),
                                                     w(0x08, 2),
                                                     w(0x0A, 5),
                                                     w(0x0C, 3),
                                                     w(0x0E, 6),
                                                     w0(0, cmd::BP_STACK)}));
    EXPECT_TRUE(driver_.BPStart());
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{w0(0, cmd::BP3)}));
    EXPECT_TRUE(driver_.BPEnd());
}

TEST_F(DriverTraffic, StepsByCommand) {
    EXPECT_TRUE(driver_.SetStep(StepBy::command));
    EXPECT_TRUE(driver_.Step());
    EXPECT_EQ(port_.take(), (std::vector<PortAccess>{{'r', reg::RR0, 0}, w(reg::WR5, 0x1000), w0(0, cmd::STEP)}));
    EXPECT_TRUE(driver_.SetStep(StepBy::wire));
    EXPECT_EQ(port_.take().back(), w(reg::WR5, 0x0800));
    // The mode remains when a line selects its axes.
    EXPECT_TRUE(driver_.SetRange(8'000'000));
    EXPECT_TRUE(driver_.Line2D_C({0, 100, 0, 0, 0, {10, 10}}, 0x3));
    const std::vector<PortAccess> all = port_.take();
    EXPECT_EQ(all[all.size() - 2], w(reg::WR5, 0x0804));
}

/// Each wait ends: on a card that drives without end, with an interrupt line that is always or never active.
TEST_F(DriverTraffic, EveryWaitHasATimeout) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 1));
    EXPECT_TRUE(driver_.ContStart({0, 100, 0, 0}));
    EXPECT_TRUE(driver_.ContLine(0x3, {10, 10}));
    EXPECT_TRUE(driver_.ContLine(0x3, {10, 10}));
    for (const bool stuck : {false, true}) {
        port_.line_stuck = stuck;
        port_.levels[0] = 0x010F;  // all axes drive, an interpolation runs, the stack is full
        const Instant before = port_.now();
        const std::vector<std::function<Result<void>()>> waits = {
            [this] { return driver_.wait_until_stopped(xyzu, milliseconds(10)); },
            [this] { return driver_.wait_until_done(axis_x, milliseconds(10)); },
            [this] {
                return driver_.ContLine(0x3, {10, 10}, 0, milliseconds(10));
            },
        };
        for (const auto& wait : waits) {
            const Result<void> result = wait();
            ASSERT_FALSE(result);
            EXPECT_EQ(result.error().kind, ErrorKind::machine);
            EXPECT_NE(result.error().message.find("0.010 s"), std::string::npos) << result.error().message;
        }
        EXPECT_LT(port_.now() - before, milliseconds(40));
        EXPECT_LT(std::exchange(port_.waits, 0), 5'000);
    }
    port_.stop = true;
    EXPECT_FALSE(driver_.wait_until_stopped(axis_x, milliseconds(10)));
    EXPECT_EQ(port_.list[port_.list.size() - 2].kind, 'r');
    port_.take();
    port_.levels[0] = 0;
    EXPECT_TRUE(driver_.wait_until_stopped(axis_x, milliseconds(10)));
}

}  // namespace
}  // namespace motionrack::mcx314
