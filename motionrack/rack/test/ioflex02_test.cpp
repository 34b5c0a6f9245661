// The IOFLEX02 in a rack: on the host's bus, its lines forced manually and driven by an axis' encoder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <sstream>

namespace motionrack::rack {
namespace {

namespace io = ioflex02;
using ::testing::HasSubstr;

/// A rack whose lines are forced and whose card is read over the bus.
struct Ioflex02Bench {
    explicit Ioflex02Bench(const std::string& text = "card.p1 = \"ioflex02\"")
        : session(std::move(*Session::open(text))) {
        EXPECT_TRUE(session->advance(1'000));  // the first sample counts nothing
    }
    void set(const std::string& wire, int level) {
        ASSERT_TRUE(session->set_wire(wire, level));
        ASSERT_TRUE(session->advance(1'000));
    }
    /// Turns the encoder at `channel` forward by a number of counts.
    void turn(int counts, const std::string& card = "p1", int channel = 0) {
        for (int i = 0; i < counts; ++i) {
            const bool a = phase % 4 == 0 || phase % 4 == 2;
            const int level = phase % 4 < 2;
            ++phase;
            set(card + (a ? ".a" : ".b") + std::to_string(channel), level);
        }
    }
    std::uint32_t read(const char* reg, const char* card = "p1", std::uint32_t base = 0x2300) {
        return *session->read(card, 16, base + offset(reg));
    }
    void write(const char* reg, unsigned value, const char* card = "p1", std::uint32_t base = 0x2300) {
        ASSERT_TRUE(session->write(card, 16, base + offset(reg), value));
    }
    static std::uint32_t offset(std::string_view reg) {
        for (const RegisterInfo& each : io::card_map().registers)
            if (each.name == reg) return each.offset;
        ADD_FAILURE() << reg;
        return 0;
    }
    std::int64_t position(int axis, const char* card = "p1") {
        return *session->peek(card, std::to_string(axis) + ".POSITION");
    }

    std::unique_ptr<Session> session;
    int phase = 0;
};

TEST(Ioflex02InARack, CountsItsLinesAndAnswersAtItsBaseAddress) {
    Ioflex02Bench bench;
    EXPECT_EQ(bench.read("SIGNATURE"), 0x4F49u);
    bench.turn(10);
    EXPECT_EQ(bench.position(0), 10);
    EXPECT_EQ(bench.position(1), 0);
    EXPECT_EQ(*bench.session->peek("p1", "0.CALIBRATED"), 1);
    const auto beside = bench.session->read("p1", 16, 0);
    ASSERT_FALSE(beside);
    EXPECT_THAT(beside.error().message, HasSubstr("0x2300"));
    EXPECT_THAT(bench.session->read("p1", 8, 0x2300).error().message, HasSubstr("accesses of 16 bits"));
    EXPECT_THAT(bench.session->peek("p1", "HEIGHT").error().message, HasSubstr("SIGNATURE"));
}

TEST(Ioflex02InARack, IsCalibratedAtTheIndexAfterTheCalibrationInput) {
    Ioflex02Bench bench;
    bench.turn(7);
    bench.write("CMD", io::cResNmSig);
    EXPECT_EQ(*bench.session->peek("p1", "0.CALIBRATED"), 0);
    bench.set("p1.z0", 1);
    bench.set("p1.z0", 0);
    EXPECT_EQ(*bench.session->peek("p1", "0.CALIBRATED"), 0) << "an index before the calibration input does nothing";
    bench.set("p1.cal0", 1);
    bench.set("p1.z0", 1);
    EXPECT_EQ(*bench.session->peek("p1", "0.CALIBRATED"), 1);
    EXPECT_EQ(bench.position(0), 0);
}

TEST(Ioflex02InARack, SeveralCardsShareABusAndOneAddressIsAConflict) {
    Ioflex02Bench bench(
        "[card.p1]\ntype = \"ioflex02\"\n[card.p2]\ntype = \"ioflex02\"\nbase_address = 0x2400\nserial = 2\n");
    bench.turn(5, "p2", 3);
    EXPECT_EQ(bench.position(3, "p2"), 5);
    EXPECT_EQ(bench.position(3, "p1"), 0);
    EXPECT_EQ(bench.read("SERIAL", "p2", 0x2400), 2u);
    Ioflex02Bench same("[card.p1]\ntype = \"ioflex02\"\n[card.p2]\ntype = \"ioflex02\"\nserial = 2\n");
    static_cast<void>(same.read("SERIAL"));
    const auto conditions = same.session->rack().kernel().conditions();
    ASSERT_FALSE(conditions.empty());
    EXPECT_THAT(same.session->rack().describe(conditions.front()), HasSubstr("2300"));
}

constexpr const char* measured = R"(
[card.motion]
type = "mcx314"
[card.flex]
type = "ioflex02"
[axis.X]
card = "motion"
channel = "x"
[axis.X.switches]
home_mm = 1
[wires]
"flex.a2" = "X.enc_a"
"flex.b2" = "X.enc_b"
"flex.z2" = "X.enc_z"
"flex.cal2" = "X.home"
)";

TEST(Ioflex02InARack, AnAxisEncoderIsReadBesideTheCardThatMovesIt) {
    Rack rack(good(measured));
    JobSettings settings;
    settings.program = "G21 G90\nG1 X20 F3000\nG1 X12.5 F6000\n";
    Job job(rack, settings);
    rack.start();
    const JobOutcome out = job.run();
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_EQ(out.axes[0].encoder_counts, 10'000);
    EXPECT_EQ(*rack.card("flex")->inspect("2.POSITION"), 10'000) << "every edge, there and back";
    EXPECT_EQ(*rack.card("flex")->inspect("2.ILLEGAL_TRANSITIONS"), 0);
}

TEST(Ioflex02InARack, FaultsOfItsLinesDoNotAffectOtherCards) {
    Rack rack(good(measured));
    JobSettings settings;
    settings.program = "G21 G90\nG1 X20 F3000\n";
    Job job(rack, settings);
    rack.start();
    ASSERT_TRUE(inject_fault(rack, "encoder.dirt=3", "X"));
    const JobOutcome out = job.run();
    ASSERT_TRUE(out.ended);
    EXPECT_EQ(out.axes[0].encoder_counts, 16'000);
    EXPECT_EQ(*rack.card("flex")->inspect("2.POSITION"), 16'000 - 4 * 12)
        << "three lines of four counts in each of four turns";
    ASSERT_TRUE(inject_fault(rack, "encoder.noise=50", "X"));
    rack.kernel().run_until(rack.kernel().now() + whole_seconds(1));
    EXPECT_EQ(*rack.card("flex")->inspect("2.POSITION"), 16'000 - 4 * 12)
        << "what comes and goes counts nothing in the end";
    EXPECT_THAT(inject_fault(rack, "encoder.noise=-1", "X").error().message, HasSubstr("with the value -1"));
    Rack plain(good("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n"));
    EXPECT_THAT(inject_fault(plain, "encoder.noise=5", "X").error().message, HasSubstr("no part with the fault"));
}

TEST(Ioflex02InARack, ItsSixteenInputsHaveTwoNamesEach) {
    Ioflex02Bench bench;
    bench.set("p1.in8", 1);  // A of axis 2
    bench.set("p1.b2", 1);
    EXPECT_EQ(bench.position(2), 2);
    EXPECT_EQ(bench.read("IN"), 0x300u);
    EXPECT_EQ(*bench.session->wire("p1.a2"), 1);
    EXPECT_EQ(*bench.session->wire("p1.in9"), 1);
    bench.set("p1.a2", 0);
    EXPECT_EQ(*bench.session->wire("p1.in8"), 0);
    std::string by_number = measured;
    for (const auto& [name, number] : {std::pair{"flex.a2", "flex.in8"}, {"flex.b2", "flex.in9"}})
        by_number.replace(by_number.find(name), std::string(name).size(), number);
    Rack rack(good(by_number));
    JobSettings settings;
    settings.program = "G21 G90\nG1 X20 F3000\n";
    Job job(rack, settings);
    rack.start();
    ASSERT_TRUE(job.run().ended);
    EXPECT_EQ(*rack.card("flex")->inspect("2.POSITION"), 16'000);
}

TEST(Ioflex02InARack, AnInputIsRecordedByTheRequestedName) {
    Ioflex02Bench bench;
    const auto file = std::filesystem::temp_directory_path() / "motionrack_ioflex02_names.vcd";
    const auto recorded = [&](const char* signals) {
        EXPECT_TRUE(bench.session->start_trace(file.string(), signals));
        bench.set("p1.cal0", 1);
        EXPECT_TRUE(bench.session->stop_trace());
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        std::filesystem::remove(file);
        return text.str();
    };
    EXPECT_THAT(recorded("p1.in3"), HasSubstr("p1_in3 $end"));
    const std::string all = recorded("p1.*");
    EXPECT_THAT(all, HasSubstr("p1_cal0 $end"));
    EXPECT_THAT(all, testing::Not(HasSubstr("p1_in3 $end"))) << "one wire, one signal";
}

TEST(Ioflex02InARack, ItsRackFilesAreChecked) {
    const struct {
        const char* text;
        const char* says;
    } wrong[] = {
        {"[card.p1]\ntype = \"ioflex02\"\nbase_address = 0x2310\n", "a multiple of 256, such as 8960"},
        {"[card.p1]\ntype = \"ioflex02\"\n[card.p2]\ntype = \"ioflex02\"\nbase_address = 0x2400\n",
         "the same serial number 1"},
        {"[card.p1]\ntype = \"ioflex02\"\n[axis.X]\ncard = \"p1\"\n", "do not drive axes"},
        {"[card.p1]\ntype = \"ioflex02\"\n[wires]\n\"p1.a4\" = \"estop\"\n", "p1.a4"},
        {"[card.p1]\ntype = \"ioflex02\"\n[wires]\n\"p1.a0\" = \"estop\"\n\"p1.in0\" = \"estop\"\n",
         "p1.a0, which p1.in0 is too, is wired twice"},
        {"[card.p1]\ntype = \"ioflex02\"\nimage = \"78zz\"\n", "Digits 3 and 4"},
        {"[card.p1]\ntype = \"ioflex02\"\nimage = \"78da\"\n", "cannot be unpacked"},
    };
    for (const auto& each : wrong) {
        const RackReading reading = read_rack_text(each.text);
        EXPECT_FALSE(reading.config);
        EXPECT_THAT(all_texts(reading.errors), HasSubstr(each.says));
    }
}

TEST(Ioflex02InARack, ACopyOfTheRackContinuesIdentically) {
    Ioflex02Bench bench(measured);
    bench.turn(3, "flex", 0);
    const auto copy = *bench.session->copy();
    ASSERT_TRUE(bench.session->advance(1'000'000));
    ASSERT_TRUE(copy->advance(1'000'000));
    EXPECT_EQ(bench.session->state_hash(), copy->state_hash());
    EXPECT_EQ(*copy->peek("flex", "0.POSITION"), 3);
}

}  // namespace
}  // namespace motionrack::rack
