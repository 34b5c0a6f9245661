// Runs every fault of the catalogue at its operating points, through the program's command line, and checks the results
// against the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <motionrack/rack/scheduled_text.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/trace/recording.hpp>
#include <nlohmann/json.hpp>
#include <tests/fault/cases.hpp>
#include <tests/ran.hpp>

namespace motionrack::faults {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Returns the instant of "--fault X.motor.stall@0.3s".
Instant instant_of(const std::string& option) {
    const auto timed = rack::read_timed_text(option.substr(option.rfind(' ') + 1));
    EXPECT_TRUE(timed) << option << " has no time";
    return timed ? timed->at : Instant{};
}

class InjectedFault : public InFolder, public testing::WithParamInterface<Case> {
  protected:
    const Case& one() const { return GetParam(); }
    const Fault& fault() const { return GetParam().fault; }

    /// Returns the rack file in the project folder, or writes one.
    std::string rack_file() const {
        const std::string rack = one().text(fault().setup.rack);
        if (rack.find('\n') == std::string::npos) return rack;
        write("rack.toml", rack);
        return "rack.toml";
    }
    std::string options() const {
        std::string out;
        for (const std::string& option : fault().inject) out.append(" ").append(one().text(option));
        return out;
    }
    Instant broken_at() const {
        return fault().inject.empty() ? Instant{} : instant_of(one().text(fault().inject.front()));
    }
    Instant last_motion() const { return broken_at() + from_seconds(*fault().within_ms * 1e-3); }

    void expect_words(const std::string& said) const {
        for (const std::string& words : fault().says) EXPECT_THAT(said, HasSubstr(one().text(words)));
    }
    void run_program() const;
    void look_at_recording(const json& summary) const;
    void look_at_values(const trace::RecordingReader& recording) const;
    void home() const;
    void show_frames() const;
    void play_session() const;
    void run_shell() const;
};

// ---- run: a part program

void InjectedFault::run_program() const {
    write("part.ngc", one().text(fault().setup.program));
    std::string arguments = "run part.ngc -q --no-report --json --record run.h5 --rack ";
    arguments.append(rack_file()).append(options());
    SCOPED_TRACE("motionrack " + arguments);
    const Ran ran = shell("{ " MOTIONRACK_PROGRAM " " + arguments + " > summary.json; }");
    EXPECT_EQ(ran.code, fault().exit) << ran.out;
    const json summary = json::parse(text_of(folder / "summary.json"), nullptr, false);
    ASSERT_TRUE(summary.is_object()) << ran.out;
    std::string said = ran.out + summary["verdict"].get<std::string>();
    for (const json& warning : summary["warnings"]) said += "\n" + warning["text"].get<std::string>();
    expect_words(said);
    if (fault().positions_valid) {
        EXPECT_EQ(summary["position_valid"], *fault().positions_valid) << said;
    }
    if (!fault().within_ms) {
        EXPECT_FALSE(summary.contains("error")) << "it was to go on to its end: " << said;
    }
    look_at_recording(summary);
}

/// Returns times and values of a series.
std::vector<std::pair<Instant, double>> read(const trace::RecordingReader& recording, const std::string& name) {
    std::vector<std::pair<Instant, double>> out;
    const trace::RecordedSeries* series = recording.find(name);
    if (series == nullptr) return out;
    const auto columns = recording.columns(*series);
    if (!columns) return out;
    std::vector<std::int64_t> times(columns->size);
    std::vector<double> values(columns->size);
    EXPECT_TRUE(columns->time.read(0, times.size(), times.data()) &&
                columns->value.read(0, values.size(), values.data()));
    for (std::size_t i = 0; i < times.size(); ++i) out.emplace_back(Instant{times[i]}, values[i]);
    return out;
}

void InjectedFault::look_at_recording(const json& summary) const {
    const auto recording = trace::RecordingReader::open((folder / "run.h5").string());
    ASSERT_TRUE(recording) << recording.error().text();
    EXPECT_TRUE(recording->whole());
    Instant last{};
    for (const json& axis : summary["axes"]) {
        const auto places = read(*recording, axis["axis"].get<std::string>() + ".position");
        ASSERT_FALSE(places.empty());
        for (const auto& [at, place] : places)
            if (place != places.back().second) last = std::max(last, at);
    }
    if (fault().within_ms) {
        EXPECT_LE(to_seconds(last), to_seconds(last_motion())) << "the last motion";
        EXPECT_LE(summary["duration_s"].get<double>(), to_seconds(last_motion()) + 1) << "the program's end";
    }
    look_at_values(*recording);
}

void InjectedFault::look_at_values(const trace::RecordingReader& recording) const {
    for (const std::string& shows : fault().shows) {
        const std::string text = one().text(shows);
        const std::size_t equals = text.find(" = ");
        ASSERT_NE(equals, std::string::npos) << text;
        const auto values = read(recording, text.substr(0, equals));
        ASSERT_FALSE(values.empty()) << "the recording has no " << text;
        EXPECT_EQ(values.back().second, std::stod(text.substr(equals + 3))) << text;
    }
}

// ---- home: homing an axis

void InjectedFault::home() const {
    const std::string arguments = "home X -q --json --rack " + rack_file() + options();
    SCOPED_TRACE("motionrack " + arguments);
    const Ran ran = shell("{ " MOTIONRACK_PROGRAM " " + arguments + " > home.json; }");
    EXPECT_EQ(ran.code, fault().exit) << ran.out;
    const json found = json::parse(text_of(folder / "home.json"), nullptr, false);
    ASSERT_TRUE(found.is_object()) << ran.out;
    const json& axis = found["axes"][0];
    expect_words(ran.out + axis["sentence"].get<std::string>());
    if (fault().positions_valid) {
        EXPECT_EQ(axis["homed"], *fault().positions_valid);
    }
    if (fault().within_ms) {
        EXPECT_LE(axis["duration_s"].get<double>(), to_seconds(last_motion()));
    }
}

// ---- frames: cards of a grating bus, and stages

void InjectedFault::show_frames() const {
    const std::string arguments = "frames " + rack_file() + " -q --duration " + one().text("{for}") + options();
    SCOPED_TRACE("motionrack " + arguments);
    const Ran ran = motionrack(arguments);
    EXPECT_EQ(ran.code, fault().exit) << ran.out;
    expect_words(ran.out);
    if (!fault().within_ms || fault().says.empty()) return;
    // Each of these words appears with its instant: "... at 0.0104120 s ...".
    for (const std::string& pattern : fault().says) {
        const std::size_t words = ran.out.find(one().text(pattern));
        if (words == std::string::npos) continue;
        const std::size_t begin = ran.out.rfind('\n', words),
                          at = ran.out.find(" at ", begin == std::string::npos ? 0 : begin);
        ASSERT_NE(at, std::string::npos) << pattern;
        EXPECT_LE(std::stod(ran.out.substr(at + 4)), to_seconds(last_motion())) << pattern;
    }
}

// ---- session: a rack without a program

double value_of(rack::Session& session, const std::string& name) {
    if (const auto part = session.part(name)) return *part;
    const std::size_t dot = name.find('.');
    const auto value = session.peek(name.substr(0, dot), name.substr(dot + 1));
    EXPECT_TRUE(value) << value.error().message;
    return value ? static_cast<double>(*value) : std::nan("");
}

void InjectedFault::play_session() const {
    const std::string rack = one().text(fault().setup.rack);
    auto session = rack::Session::open(rack.find('\n') == std::string::npos ? (source_root / rack).string() : rack);
    ASSERT_TRUE(session) << session.error().text();
    const auto pass = [&](double ms) { ASSERT_TRUE((*session)->advance(static_cast<std::uint64_t>(ms * 1e6))); };
    for (const std::string& option : fault().inject) {
        const auto timed = rack::read_timed_text(one().text(option));
        ASSERT_TRUE(timed) << option;
        pass(to_seconds(timed->at) * 1e3 - static_cast<double>((*session)->now_ns()) * 1e-6);
        const std::size_t equals = timed->action.find('='), dot = timed->action.find('.');
        const bool wire = (*session)->wire(timed->action.substr(0, equals)).has_value();
        const Result<void> done =
            wire ? (*session)->set_wire(timed->action.substr(0, equals), std::stod(timed->action.substr(equals + 1)))
                 : (*session)->fault(timed->action.substr(dot + 1), timed->action.substr(0, dot));
        ASSERT_TRUE(done) << done.error().text();
    }
    pass(fault().within_ms.value_or(0));
    std::map<std::string, double> before;
    const auto name_of = [&](const std::string& text) { return text.substr(0, text.find(' ')); };
    for (const std::string& shows : fault().shows) before[name_of(shows)] = value_of(**session, name_of(shows));
    pass(100);
    for (const std::string& shows : fault().shows) {
        const std::string text = one().text(shows);
        const double now = value_of(**session, name_of(text)), was = before[name_of(shows)];
        if (text.find(" stands") != std::string::npos)
            EXPECT_LE(std::fabs(now - was), 2) << text;
        else if (text.find(" goes up") != std::string::npos)
            EXPECT_GT(now, was + 2) << text;
        else if (text.find(" goes down") != std::string::npos)
            EXPECT_LT(now, was - 2) << text;
        else
            EXPECT_DOUBLE_EQ(now, std::stod(text.substr(text.find(" = ") + 3))) << text;
    }
    std::string said;
    for (const sim::Condition& condition : (*session)->rack().kernel().conditions())
        said += (*session)->rack().describe(condition) + "\n";
    expect_words(said);
}

// ---- shell: files and signals

void InjectedFault::run_shell() const {
    const std::string path =
        "export PATH=\"" + std::filesystem::path(MOTIONRACK_PROGRAM).parent_path().string() + ":$PATH\"; ";
    const auto in_shell = [&](const std::string& text) { return shell("bash -c '" + path + one().text(text) + "'"); };
    if (!fault().before.empty()) {
        const Ran before = in_shell(fault().before);
        ASSERT_EQ(before.code, 0) << before.out;
    }
    const Ran ran = in_shell(fault().command);
    EXPECT_EQ(ran.code, fault().exit) << ran.out;
    expect_words(ran.out);
    if (fault().after.empty()) return;
    const Ran after = in_shell(fault().after);
    EXPECT_EQ(after.code, 0) << "the kept data are wrong: " << one().text(fault().after) << "\n" << after.out;
}

TEST_P(InjectedFault, DoesWhatTheCatalogueStates) {
    const std::string& by = fault().setup.by;
    if (by == "run") return run_program();
    if (by == "home") return home();
    if (by == "frames") return show_frames();
    if (by == "session") return play_session();
    if (by == "shell") return run_shell();
    FAIL() << "nothing runs a fault by " << by;
}

std::vector<Case> own_cases() {
    std::vector<Case> out;
    for (Case& one : all_cases())
        if (one.fault.setup.by != "test" && one.fault.setup.by != "program") out.push_back(std::move(one));
    return out;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, InjectedFault, testing::ValuesIn(own_cases()),
                         [](const auto& each) { return each.param.name(); });

}  // namespace
}  // namespace motionrack::faults
