// Tests the declared functions, which pages and Python call: each writes the same registers as the C++ function of its
// name with the same numbers, and the homing functions end at home.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>
#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::mcx314 {
namespace {

/// Records the writes to a port.
class WrittenPort final : public RegisterPort {
  public:
    explicit WrittenPort(RegisterPort& port) : port_(port) {}
    void write(std::uint32_t offset, std::uint16_t value) override {
        written.emplace_back(offset, value);
        port_.write(offset, value);
    }
    std::uint16_t read(std::uint32_t offset) override { return port_.read(offset); }
    std::vector<std::pair<std::uint32_t, std::uint16_t>> written;

  private:
    RegisterPort& port_;
};

std::int64_t taken(const Result<void>& done) {
    EXPECT_TRUE(done) << (done ? std::string() : done.error().message);
    return 0;
}

template <Result<std::vector<HomeReport>> (*function)(Driver&, unsigned, unsigned, std::int64_t, std::int64_t,
                                                      std::int64_t)>
std::int64_t home_between_limits(Driver& driver) {
    EXPECT_FALSE(function(driver, axis_x, 0x12, 60, 900, 110));
    return 0;
}

/// A function with arguments in the order of the declaration, all different, and the same call of the C++ function.
struct BoundCall {
    std::string_view name;
    std::vector<std::int64_t> values;
    std::int64_t (*direct)(Driver&);
    bool homes = false;  ///< fails between two limit switches
};

std::vector<BoundCall> basic_calls() {
    return {
        {"SetPulseMode", {6, 1}, [](Driver& d) { return taken(d.SetPulseMode(6, 1)); }},
        {"SetMultiple", {5, 7}, [](Driver& d) { return taken(d.SetMultiple(5, 7)); }},
        {"SetRange", {400'000}, [](Driver& d) { return taken(d.SetRange(400'000)); }},
        {"SetMaxSpeed", {123'456}, [](Driver& d) { return taken(d.SetMaxSpeed(123'456)); }},
        {"SetSV", {3, 77}, [](Driver& d) { return taken(d.SetSV(3, 77)); }},
        {"SetV", {12, 1234}, [](Driver& d) { return taken(d.SetV(12, 1234)); }},
        {"SetA", {9, 321}, [](Driver& d) { return taken(d.SetA(9, 321)); }},
        {"SetD",
         {6, 123},
         [](Driver& d) {
             taken(d.SetD(6, 123));
             return taken(d.SetAsymmetric(6, true));
         }},
        {"SetAA", {2, 4567}, [](Driver& d) { return taken(d.SetAA(2, 4567)); }},
        {"SetAO", {4, 89}, [](Driver& d) { return taken(d.SetAO(4, 89)); }},
        {"Pulse", {10, -3456}, [](Driver& d) { return taken(d.Pulse(10, -3456)); }},
        {"AutoDec", {}, [](Driver& d) { return taken(d.AutoDec()); }},
        {"ManualDec", {3, 222}, [](Driver& d) { return taken(d.ManualDec(3, 222)); }},
        {"ManDec", {8, 333}, [](Driver& d) { return taken(d.ManDec(8, 333)); }},
        {"TCurve_F", {5, 60, 900, 110, -2500}, [](Driver& d) { return taken(d.TCurve_F(5, 60, 900, 110, -2500)); }},
        {"TCurve_C", {2, 60, 900, 110}, [](Driver& d) { return taken(d.TCurve_C(2, 60, 900, 110)); }},
        {"SCurve_F",
         {4, 60, 900, 110, 700, 2500},
         [](Driver& d) { return taken(d.SCurve_F(4, 60, 900, 110, 700, 2500)); }},
        {"SCurve_C", {8, 60, 900, 110, 700}, [](Driver& d) { return taken(d.SCurve_C(8, 60, 900, 110, 700)); }},
    };
}

std::vector<BoundCall> path_calls() {
    return {
        {"Line2D_C",
         {800, 0, 900, -700, 0, 6},
         [](Driver& d) {
             return taken(d.Line2D_C({0, 800, 0, 0, 0, {0, 900, -700, 0}}, 6));
         }},
        {"Line3D_C",
         {800, 500, 900, -700, 0, 7},
         [](Driver& d) {
             return taken(d.Line3D_C({0, 800, 0, 0, 0, {500, 900, -700, 0}}, 7));
         }},
        {"Line2D_T",
         {60, 800, 110, 130, 900, 0, 0, -700, 9},
         [](Driver& d) {
             return taken(d.Line2D_T({60, 800, 110, 130, 0, {900, 0, 0, -700}}, 9));
         }},
        {"Line3D_T",
         {60, 800, 110, 0, 500, 900, 0, -700, 11},
         [](Driver& d) {
             return taken(d.Line3D_T({60, 800, 110, 0, 0, {500, 900, 0, -700}}, 11));
         }},
        {"Line2D_S",
         {60, 800, 110, 0, 700, 0, 0, 900, -600, 12},
         [](Driver& d) {
             return taken(d.Line2D_S({60, 800, 110, 0, 700, {0, 0, 900, -600}}, 12));
         }},
        {"Line3D_S",
         {60, 800, 110, 0, 700, 0, 500, 900, -600, 14},
         [](Driver& d) {
             return taken(d.Line3D_S({60, 800, 110, 0, 700, {0, 500, 900, -600}}, 14));
         }},
        {"CircleCW_C",
         {800, 1000, 0, 1000, 0, 1000, 0, 0, 0, 5},
         [](Driver& d) {
             return taken(d.CircleCW_C({0, 800, 0, 0, {1000, 0, 1000, 0}, {1000, 0, 0, 0}}, 5));
         }},
        {"CircleCCW_C",
         {800, 0, 600, 0, 600, 0, 0, 0, 600, 10},
         [](Driver& d) {
             return taken(d.CircleCCW_C({0, 800, 0, 0, {0, 600, 0, 600}, {0, 0, 0, 600}}, 10));
         }},
        {"CircleCW_T",
         {60, 800, 110, 0, 1000, 1000, 0, 0, 1000, 0, 0, 0, 3},
         [](Driver& d) {
             return taken(d.CircleCW_T({60, 800, 110, 0, {1000, 1000, 0, 0}, {1000, 0, 0, 0}}, 3));
         }},
        {"CircleCCW_T",
         {60, 800, 110, 0, 0, 0, 700, 700, 0, 0, 0, 700, 12},
         [](Driver& d) {
             return taken(d.CircleCCW_T({60, 800, 110, 0, {0, 0, 700, 700}, {0, 0, 0, 700}}, 12));
         }},
        {"SetCP", {2, -444}, [](Driver& d) { return taken(d.SetCP(2, -444)); }},
        {"SetC", {4, 555}, [](Driver& d) { return taken(d.SetC(4, 555)); }},
        {"SetFP", {8, -666}, [](Driver& d) { return taken(d.SetFP(8, -666)); }},
        {"SetP", {1, 777}, [](Driver& d) { return taken(d.SetP(1, 777)); }},
    };
}

std::vector<BoundCall> other_calls() {
    return {
        {"HLMTP", {1, 6}, [](Driver& d) { return taken(d.HLMTP(1, 6)); }},
        {"HLMTM", {1, 9}, [](Driver& d) { return taken(d.HLMTM(1, 9)); }},
        {"HLMTSig", {1, 4}, [](Driver& d) { return taken(d.HLMTSig(1, 4)); }},
        {"SLMTP", {1}, [](Driver& d) { return taken(d.SLMTP(1)); }},
        {"SLMTM", {1}, [](Driver& d) { return taken(d.SLMTM(1)); }},
        {"SLMTSig", {1}, [](Driver& d) { return taken(d.SLMTSig(1)); }},
        {"EncoderMode", {1, 2}, [](Driver& d) { return taken(d.EncoderMode(1, 2)); }},
        {"EncoderCWCCW", {2, 8}, [](Driver& d) { return taken(d.EncoderCWCCW(2, 8)); }},
        {"EnableALM", {1}, [](Driver& d) { return taken(d.EnableALM(1)); }},
        {"EnableInPos", {1}, [](Driver& d) { return taken(d.EnableInPos(1)); }},
        {"ALMSig", {1, 3}, [](Driver& d) { return taken(d.ALMSig(1, 3)); }},
        {"InPosSig", {1, 5}, [](Driver& d) { return taken(d.InPosSig(1, 5)); }},
        {"HomeType1", {0x12, 60, 900, 110}, home_between_limits<HomeType1>, true},
        {"HomeType2", {0x12, 60, 900, 110}, home_between_limits<HomeType2>, true},
        {"HomeType3", {0x12, 60, 900, 110}, home_between_limits<HomeType3>, true},
        {"HomeType4", {0x12, 60, 900, 110}, home_between_limits<HomeType4>, true},
        {"LPS", {2, -32'943}, [](Driver& d) { return taken(d.LPS(2, -32'943)); }},
        {"EPS", {8, 4321}, [](Driver& d) { return taken(d.EPS(8, 4321)); }},
        {"ReadLPS", {4}, [](Driver& d) { return std::int64_t{d.ReadLPS(2)}; }},
        {"ReadEPS", {8}, [](Driver& d) { return std::int64_t{d.ReadEPS(3)}; }},
        {"ReadCV", {2}, [](Driver& d) { return std::int64_t{d.ReadCV(1)}; }},
        {"ReadCA", {1}, [](Driver& d) { return std::int64_t{d.ReadCA(0)}; }},
        {"SetCompP", {3, 50'000}, [](Driver& d) { return taken(d.SetCompP(3, 50'000)); }},
        {"SetCompM", {12, -60'000}, [](Driver& d) { return taken(d.SetCompM(12, -60'000)); }},
        {"RESET",
         {},
         [](Driver& d) {
             d.RESET();
             return std::int64_t{0};
         }},
    };
}

std::vector<BoundCall> bound_calls() {
    std::vector<BoundCall> out = basic_calls();
    for (const std::vector<BoundCall>& more : {path_calls(), other_calls()})
        out.insert(out.end(), more.begin(), more.end());
    return out;
}

/// Makes both limit switches of X act.
void enclose(DriverRig& rig) {
    rig.wire("xlmtm", 0);
    rig.wire("xlmtp", 0);
}

std::vector<std::pair<std::uint32_t, std::uint16_t>> written_directly(const BoundCall& bound, std::int64_t& value) {
    DriverRig rig;
    WrittenPort port(rig.port);
    Driver driver(port, rig.port);
    driver.RESET();
    taken(driver.SetPulseMode(xyzu, 1));
    taken(driver.SetRange(800'000));
    if (bound.homes) enclose(rig);
    port.written.clear();
    value = bound.direct(driver);
    return port.written;
}

std::vector<std::pair<std::uint32_t, std::uint16_t>> written_by_name(const BoundCall& bound, std::int64_t& value) {
    DriverRig rig;
    WrittenPort port(rig.port);
    Library library(port, rig.port);
    EXPECT_TRUE(library.begin());
    const auto call = [&](std::string_view name, const std::vector<std::int64_t>& values) {
        std::map<std::string, std::int64_t, std::less<>> arguments;
        for (const FunctionInfo& function : library.functions())
            for (std::size_t i = 0; function.name == name && i < function.arguments.size(); ++i)
                arguments[std::string(function.arguments[i].name)] = values.at(i);
        const Result<CheckedCall> checked = check_call(library.functions(), name, arguments);
        EXPECT_TRUE(checked) << (checked ? std::string() : checked.error().message);
        return library.call(checked->function, checked->values);
    };
    EXPECT_TRUE(call("SetRange", {800'000}));
    if (bound.homes) enclose(rig);
    port.written.clear();
    const Result<CallAnswer> answer = call(bound.name, bound.values);
    EXPECT_EQ(answer.has_value(), !bound.homes) << (answer ? answer->text : answer.error().message);
    value = answer ? answer->value.value_or(0) : 0;
    return port.written;
}

TEST(DeclaredLibrary, EachOfThe57FunctionsWritesWhatTheCppFunctionWrites) {
    const std::vector<BoundCall> all = bound_calls();
    ASSERT_EQ(all.size(), 57u);
    for (std::size_t i = 0; i < all.size(); ++i) {
        SCOPED_TRACE(std::string(all[i].name));
        EXPECT_EQ(library_functions()[i].name, all[i].name) << "in the order of the declaration";
        ASSERT_EQ(library_functions()[i].arguments.size(), all[i].values.size());
        std::int64_t directly = -1, by_name = -1;
        const auto expected = written_directly(all[i], directly);
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(written_by_name(all[i], by_name), expected);
        EXPECT_EQ(by_name, directly);
    }
}

// ---- homing

/// Returns the rotor position after the homing function, pulses from its start at 20 mm; the switch is at -12,160.
std::int64_t rotor_homed_by(std::string_view name) {
    HomeRig rig;
    rig.start();
    Library library(rig.port, rig.port);
    EXPECT_TRUE(library.begin());
    const auto call = [&](std::string_view function, const std::map<std::string, std::int64_t, std::less<>>& values) {
        const Result<CheckedCall> checked = check_call(library.functions(), function, values);
        EXPECT_TRUE(checked) << (checked ? std::string() : checked.error().message);
        const Result<CallAnswer> answer = library.call(checked->function, checked->values);
        EXPECT_TRUE(answer) << function << ": " << (answer ? std::string() : answer.error().message);
        return answer ? answer->value.value_or(0) : -1;
    };
    call("SetRange", {{"data", 800'000}});
    call("SetAO", {{"axis", 15}, {"data", 0}});
    call("HLMTSig", {{"n", 1}, {"axis", 15}});
    call(name, {{"WR1Reg", 0x12}, {"SV", 50}, {"V", 1000}, {"A", 100}});
    EXPECT_EQ(call("ReadLPS", {{"axis", 1}}), 0) << "home is 0";
    EXPECT_EQ(call("ReadEPS", {{"axis", 1}}), 0);
    EXPECT_FALSE(library.moving());
    return rig.rotor();
}

TEST(DeclaredLibrary, EachHomingFunctionEndsAtThePositionThatTheSourceStates) {
    constexpr std::int64_t edge = -19 * 640;
    EXPECT_NEAR(static_cast<double>(rotor_homed_by("HomeType1")), edge - 399, 8) << "it decelerates from the switch on";
    EXPECT_EQ(rotor_homed_by("HomeType2"), edge);
    EXPECT_EQ(rotor_homed_by("HomeType3"), -4 * pulses_per_turn) << "the first index after the switch";
    EXPECT_EQ(rotor_homed_by("HomeType4"), edge) << "it goes back from the index";
}

}  // namespace
}  // namespace motionrack::mcx314
