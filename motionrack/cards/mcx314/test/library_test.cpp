// Tests the declaration of the library for forms: the same functions as the C header, ranges that the driver accepts,
// results as text, and stops that end waiting functions.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::mcx314 {
namespace {

using Arguments = std::map<std::string, std::int64_t, std::less<>>;

struct LibraryRig : DriverRig {
    LibraryRig() { EXPECT_TRUE(library.begin()); }
    Result<CallAnswer> call(std::string_view name, const Arguments& arguments = {}) {
        MOTIONRACK_TRY(const CheckedCall checked, check_call(library.functions(), name, arguments));
        return library.call(checked.function, checked.values);
    }
    std::int64_t value(std::string_view name, std::int64_t axis) {
        const Result<CallAnswer> answer = call(name, {{"axis", axis}});
        EXPECT_TRUE(answer) << answer.error().message;
        return answer && answer->value ? *answer->value : -1;
    }
    Library library{port, port};
};

/// Returns the initial values of the form of a function.
Arguments starts_of(const FunctionInfo& function) {
    Arguments out;
    for (const ArgumentInfo& one : function.arguments) out[std::string(one.name)] = one.start;
    return out;
}

/// Returns the names in a declaration: "int axis, int data" gives {"axis", "data"}; a structure gives its members.
std::set<std::string> names_of(const std::string& list) {
    std::set<std::string> out;
    const std::regex name(R"((\w+)\s*(,|$))");
    for (auto it = std::sregex_iterator(list.begin(), list.end(), name); it != std::sregex_iterator(); ++it)
        out.insert((*it)[1]);
    out.erase("void");
    return out;
}

TEST(DeclaredLibrary, HasTheFunctionsAndArgumentsOfTheHeader) {
    std::ifstream in(source_dir() + "/motionrack/frontends/mcx314lib/mcx314lib.h");
    std::ostringstream text;
    text << in.rdbuf();
    const std::string header = text.str();
    std::map<std::string, std::set<std::string>> there, here;
    const std::regex prototype(R"(MCX314_API \w+\s+([A-Z]\w*)\(([^)]*)\);)");
    for (auto it = std::sregex_iterator(header.begin(), header.end(), prototype); it != std::sregex_iterator(); ++it)
        there[(*it)[1]] = names_of((*it)[2]);
    for (const FunctionInfo& function : library_functions()) {
        if (function.own) continue;
        std::set<std::string>& arguments = here[std::string(function.name)];
        for (const ArgumentInfo& one : function.arguments) arguments.emplace(one.name);
        const auto structure = there.find(std::string(function.name));
        ASSERT_NE(structure, there.end()) << function.name;
        for (const char* data : {"pLD", "pCD"})
            if (structure->second.count(data) != 0) arguments = structure->second;
    }
    EXPECT_EQ(here.size(), 57u);
    EXPECT_EQ(here, there);
}

TEST(DeclaredLibrary, RejectsEachValueOutOfRangeWithTheRange) {
    LibraryRig rig;
    for (const FunctionInfo& function : library_functions())
        for (const ArgumentInfo& one : function.arguments)
            for (const std::int64_t wrong : {one.min - 1, one.max + 1}) {
                Arguments arguments = starts_of(function);
                arguments[std::string(one.name)] = wrong;
                const Result<CallAnswer> answer = rig.call(function.name, arguments);
                ASSERT_FALSE(answer) << function.name << ' ' << one.name << ' ' << wrong;
                EXPECT_NE(answer.error().message.find(std::to_string(wrong)), std::string::npos);
                EXPECT_NE(answer.error().message.find(range_text(one)), std::string::npos) << answer.error().message;
            }
}

TEST(DeclaredLibrary, AcceptsTheInitialValuesOfItsForms) {
    for (const FunctionInfo& function : library_functions()) {
        if (function.waits) continue;
        LibraryRig rig;
        ASSERT_TRUE(rig.call("SetRange", {{"data", 800'000}}));
        if (function.name == "pattern_start") continue;  // needs pattern steps before
        const Result<CallAnswer> answer = rig.call(function.name, starts_of(function));
        ASSERT_TRUE(answer) << function.name << ": " << answer.error().message;
        EXPECT_FALSE(answer->text.empty()) << function.name;
    }
}

TEST(DeclaredLibrary, ListsTheKnownNamesForAnUnknownOne) {
    LibraryRig rig;
    const auto message = [&](std::string_view name, const Arguments& arguments) {
        const Result<CallAnswer> answer = rig.call(name, arguments);
        EXPECT_FALSE(answer);
        return answer ? std::string() : answer.error().message;
    };
    EXPECT_NE(message("SetW", {}).find("it has SetPulseMode, SetMultiple"), std::string::npos);
    EXPECT_EQ(message("SetV", {{"axis", 1}}),
              "SetV: the argument data is missing; it must be 1 to 8000 x M pulses/s. Nothing was done.");
    EXPECT_EQ(message("SetV", {{"axis", 1}, {"data", 5}, {"more", 1}}),
              "SetV was given 3 arguments; its arguments are: axis, data. Nothing was done.");
    EXPECT_EQ(message("HLMTP", {{"n", 2}, {"axis", 1}}),
              "HLMTP: n is 2, but must be 0 (Low), 1 (High). Nothing was done.");
    EXPECT_EQ(message("ReadLPS", {{"axis", 3}}),
              "ReadLPS: axis is 3, but must be 1 (X), 2 (Y), 4 (Z), 8 (U). Nothing was done.");
}

TEST(DeclaredLibrary, CallsItsFunctionsByTheirNamesInSentencesToo) {
    LibraryRig rig;
    const Result<CallAnswer> early = rig.call("contour_end");
    ASSERT_FALSE(early);
    EXPECT_EQ(early.error().message,
              "contour_end: no chain with a segment is open. Nothing was written. Call contour_begin and contour_line "
              "first.");
}

TEST(DeclaredLibrary, MovesAndReads) {
    LibraryRig rig;
    EXPECT_FALSE(rig.call("TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", 500}}))
        << "no multiple was set";
    ASSERT_TRUE(rig.call("SetRange", {{"data", 800'000}}));
    ASSERT_TRUE(rig.call("TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", -500}}));
    EXPECT_EQ(rig.value("moving", 15), 1);
    const Result<CallAnswer> stands = rig.call("wait", {{"axis", 1}, {"milliseconds", 10'000}});
    ASSERT_TRUE(stands) << stands.error().message;
    EXPECT_EQ(stands->text, "X is at standstill, as commanded.");
    const Result<CallAnswer> place = rig.call("ReadLPS", {{"axis", 1}});
    ASSERT_TRUE(place);
    EXPECT_EQ(place->value, -500);
    EXPECT_EQ(place->text, "-500 pulses");
    ASSERT_TRUE(rig.call("Line3D_S", {{"SV", 100},
                                      {"V", 1000},
                                      {"A", 100},
                                      {"D", 0},
                                      {"K", 1000},
                                      {"PX", 300},
                                      {"PY", -200},
                                      {"PZ", 100},
                                      {"PU", 0},
                                      {"axis", 7}}));
    ASSERT_TRUE(rig.call("wait", {{"axis", 7}, {"milliseconds", 10'000}}));
    EXPECT_EQ(rig.value("ReadLPS", 1), -200);
    EXPECT_EQ(rig.value("ReadLPS", 2), -200);
    EXPECT_EQ(rig.value("ReadLPS", 4), 100);
}

TEST(DeclaredLibrary, DrivesContoursAndPatterns) {
    LibraryRig rig;
    ASSERT_TRUE(rig.call("SetRange", {{"data", 800'000}}));
    ASSERT_TRUE(rig.call("contour_begin", {{"SV", 100}, {"V", 500}, {"A", 100}, {"D", 0}}));
    for (const std::int64_t y : {200, -200})
        ASSERT_TRUE(rig.call("contour_line", {{"axis", 3}, {"PX", 400}, {"PY", y}, {"PZ", 0}, {"PU", 0}, {"V", 0}}));
    const Result<CallAnswer> ended = rig.call("contour_end");
    ASSERT_TRUE(ended) << ended.error().message;
    EXPECT_EQ(ended->text, "The contour of 2 segments has ended.");
    EXPECT_EQ(rig.value("ReadLPS", 1), 800);
    EXPECT_EQ(rig.value("ReadLPS", 2), 0);
    ASSERT_TRUE(rig.call("pattern_begin", {{"SV", 1}, {"V", 100}, {"A", 0}, {"DecPoint", 0}, {"axis", 3}}));
    ASSERT_TRUE(
        rig.call("pattern_steps",
                 {{"plus1", 0x800F}, {"minus1", 0x8000}, {"plus2", 0}, {"minus2", 3}, {"plus3", 0}, {"minus3", 0}}));
    ASSERT_TRUE(rig.call("pattern_start"));
    const Result<CallAnswer> over = rig.call("pattern_end");
    ASSERT_TRUE(over) << over.error().message;
    EXPECT_EQ(rig.value("ReadLPS", 1), 804);
    EXPECT_EQ(rig.value("ReadLPS", 2), -2);
}

TEST(DeclaredLibrary, StopsAtOnceInAFunctionThatWaits) {
    LibraryRig rig;
    std::atomic<bool> stop{false};
    rig.port.set_stop_flag(&stop);
    Instant asked{};
    rig.port.on_slice(milliseconds(2), [&] {
        if (rig.kernel.now() > Instant{} + milliseconds(500) && !stop.exchange(true)) asked = rig.kernel.now();
    });
    ASSERT_TRUE(rig.call("SetRange", {{"data", 16'000}}));
    // A ramp of minutes: a decelerating stop would take as long.
    ASSERT_TRUE(rig.call("TCurve_C", {{"axis", 5}, {"m_SV", 1}, {"m_V", 8000}, {"m_A", 1}}));
    const Result<CallAnswer> answer = rig.call("wait", {{"axis", 15}, {"milliseconds", 60'000}});
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().kind, ErrorKind::stopped);
    EXPECT_LT(rig.kernel.now() - asked, milliseconds(2));
    EXPECT_FALSE(rig.library.moving());
}

/// Requests a stop at the nth access.
class StoppedAt final : public RegisterPort {
  public:
    StoppedAt(RegisterPort& port, std::atomic<bool>& stop) : port_(port), stop_(stop) {}
    void write(std::uint32_t offset, std::uint16_t value) override {
        const bool late = stop_;
        count();
        const int command = offset == reg::WR0 ? value & 0xff : 0;
        drove_late = drove_late || (late && command >= 0x20 && command <= 0x23);
        port_.write(offset, value);
    }
    std::uint16_t read(std::uint32_t offset) override {
        count();
        return port_.read(offset);
    }
    std::int64_t left = 1'000'000;  ///< accesses before it
    bool drove_late = false;        ///< a drive was started after it

  private:
    void count() {
        if (left-- == 0) stop_ = true;
    }
    RegisterPort& port_;
    std::atomic<bool>& stop_;
};

TEST(DeclaredLibrary, StartsNoDriveAfterAStopBetweenAnyTwoAccesses) {
    const Arguments order = {{"axis", 1}, {"m_Pulse", 5000}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}};
    bool ended = false;
    for (std::int64_t n = 0; !ended; ++n) {
        SCOPED_TRACE(n);
        DriverRig rig;
        std::atomic<bool> stop{false};
        StoppedAt port(rig.port, stop);
        rig.port.set_stop_flag(&stop);
        Library library(port, rig.port);
        ASSERT_TRUE(library.begin());
        const Result<CheckedCall> checked = check_call(library.functions(), "TCurve_F", order);
        ASSERT_TRUE(checked) << checked.error().message;
        port.left = n;
        (void)library.call(checked->function, checked->values);
        ended = !stop;  // the function had ended before the stop
        port.left = 1'000'000;
        stop = true;
        library.stop_now();
        rig.kernel.run_until(rig.kernel.now() + milliseconds(1));
        EXPECT_FALSE(library.moving());
        EXPECT_FALSE(port.drove_late);
        ASSERT_LT(n, 500);
    }
}

TEST(DeclaredLibrary, ReportsHowAHomingFailed) {
    LibraryRig rig;
    ASSERT_TRUE(rig.call("SetRange", {{"data", 800'000}}));
    rig.wire("xlmtm", 0);  // both limit switches are active
    rig.wire("xlmtp", 0);
    const Result<CallAnswer> answer = rig.call("HomeType2", {{"WR1Reg", 2}, {"SV", 100}, {"V", 1000}, {"A", 100}});
    ASSERT_FALSE(answer);
    EXPECT_GT(answer.error().message.size(), 30u);
}

}  // namespace
}  // namespace motionrack::mcx314
