// Waves of a job, counted by independent software: sigrok-cli reads the VCD file of a run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <set>
#include <sstream>
#include <tests/text_of.hpp>
#include <tests/wave_readers.hpp>

namespace motionrack::rack {
namespace {

using test::last_number;

TEST(Waves, SigrokCountsThePulsesAndEncoderEdgesOfAJob) {
    if (std::system("sigrok-cli --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "sigrok-cli is not installed: apt-get install sigrok-cli";
    const std::string path =
        (std::filesystem::temp_directory_path() / ("motionrack_wave_" + std::to_string(::getpid()) + ".vcd")).string();
    const std::string program = "G21 G90\nG1 X2 Y1 F600\nG1 X0.5\nM2\n";
    JobOutcome outcome;
    {
        Rack rack(*read_rack_text(*rack_template("router")).config);
        RecorderSettings waves;
        waves.sink = wave_sink({path});
        waves.signals = {"X.*"};
        auto recorder = Recorder::create(rack, waves);
        ASSERT_TRUE(recorder) << recorder.error().text();
        JobSettings settings;
        settings.program = program;
        settings.on_slice = [&recorder] { (*recorder)->drain(); };
        Job job(rack, settings);
        rack.start();
        (*recorder)->begin();
        outcome = job.run();
        ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
        ASSERT_TRUE((*recorder)->finish());
    }
    // 2 mm out and 1.5 mm back: 640 pulses and 800 encoder counts a millimetre.
    EXPECT_EQ(outcome.axes[0].pulses_sent, 2240);
    EXPECT_EQ(last_number(path, "counter:data=X_step:data_edge=rising", "counter=edge_count"), 2240);
    EXPECT_EQ(last_number(path, "stepper_motor:step=X_step:dir=X_dir", "stepper_motor=position"), 321)
        << "told when it is left";
    EXPECT_EQ(outcome.axes[0].encoder_counts, 400);
    EXPECT_EQ(last_number(path, "graycode:d0=X_enc_a:d1=X_enc_b", "graycode=count"), 401);
    std::filesystem::remove(path);
}

/// A recording in progress, with all signals of a rack.
struct RecordedRack {
    const char* rack;
    std::string signals;
    std::uint64_t ns;
    void (*drive)(Session&);
};

void turn_x(Session& session) {
    const auto command = [&](unsigned axes, unsigned code, unsigned value) {
        for (const auto& [at, word] : {std::pair{0x0Eu, value >> 16}, {0x0Cu, value & 0xFFFF}, {0u, axes << 8 | code}})
            static_cast<void>(session.write("c1", 16, at, word));
    };
    for (const auto& [code, value] : {std::pair{0u, 800'000u}, {2u, 400u}, {4u, 10u}, {5u, 2'000u}, {6u, 700u}})
        command(1, code, value);
    command(1, 0x20, 0);
}

void position(Session& session) {
    for (const auto& [port, value] : {std::pair{1u, 13u},
                                      {3u, unsigned{'R'}},
                                      {0u, 16'000u & 0xFF},
                                      {0u, 16'000u >> 8},
                                      {3u, unsigned{'N'}},
                                      {0u, 100u},
                                      {0u, 0u},
                                      {0u, 0u},
                                      {3u, unsigned{'G'}}}) {
        static_cast<void>(session.write("c1", 8, port, value));
        static_cast<void>(session.advance(150'000));
    }
}

void stand(Session&) {}

/// Advances 1 ms: a belt and a stage move by themselves. sigrok misses an edge of the belt at the last instant.
void look_on(Session& session) {
    EXPECT_TRUE(session.advance(1'000'000));
}

TEST(Waves, AreReadCompletelyByEveryReader) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("motionrack_all_" + std::to_string(::getpid()) + ".vcd")).string();
    const RecordedRack recorded_racks[] = {
        {"card.c1 = \"mcx314\"", "*", 200'000'000, turn_x},
        {"card.c1 = \"databoard4002\"", "*", 200'000'000, position},
        {"card.c1 = \"ioflex02\"", "*", 1'000'000, stand},
        {"[card.h]\ntype = \"grating_bus\"\n[card.c2]\ntype = \"grating_bus\"\n[card.d]\ntype = "
         "\"grating_decoder\"\n",
         "*", 500'000, stand},
        {"[card.s]\ntype = \"rtc5\"\nlist_memory = 2000\n[belt.line]\ncard = \"s\"\nvelocity_mm_s = 100\n"
         "counts_per_mm = 100\n[scanner.head]\ncard = \"s\"\n",
         "*", 49'990'000, look_on},
        {"[card.d]\ntype = \"grating_decoder\"\nscales = 1\n[card.h]\ntype = \"grating_bus\"\nscales = 1\n"
         "[stage.table]\ncard = \"h\"\ninput = 0\n[stage.table.servo]\nprofile = \"scan\"\nfrom_mm = 0\n"
         "to_mm = 4\nmax_velocity_mm_s = 20\nmax_accel_mm_s2 = 2000\n",
         "table.*", 50'000'000, look_on},
    };
    for (const RecordedRack& one : recorded_racks) {
        SCOPED_TRACE(one.rack);
        const auto session = std::move(*Session::open(one.rack));
        ASSERT_TRUE(session->start_trace(path, one.signals));
        one.drive(*session);
        ASSERT_TRUE(session->advance(one.ns));
        ASSERT_TRUE(session->stop_trace());
        const test::StrictVcd vcd(text_of(path));
        const std::int64_t unit_ns = vcd.unit == "100 ns" ? 100 : vcd.unit == "10 ns" ? 10 : 1;
        EXPECT_EQ(vcd.end, static_cast<std::int64_t>(session->now_ns()) / unit_ns) << "the end is marked";
        const int compared = test::expect_every_reader_reads(path, vcd);
        EXPECT_TRUE(compared > 0 || one.drive == stand) << "nothing moved";
        std::filesystem::remove(path);
    }
}

/// Runs a move of X and Y with a recording of `signals` and returns the text of the file.
std::string recorded(const std::string& ending, const std::vector<std::string>& signals) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("motionrack_waves_" + std::to_string(::getpid()) + ending)).string();
    Rack rack(*read_rack_text(*rack_template("router")).config);
    RecorderSettings waves;
    waves.sink = wave_sink({path, *wave_format(path)});
    waves.signals = signals;
    auto recorder = Recorder::create(rack, waves);
    EXPECT_TRUE(recorder) << recorder.error().text();
    JobSettings settings;
    settings.program = "G21 G90\nG1 X2 Y1 F600\nG1 X0.5\nM2\n";
    settings.on_slice = [&recorder] { (*recorder)->drain(); };
    Job job(rack, settings);
    rack.start();
    (*recorder)->begin();
    EXPECT_TRUE(job.run().ended);
    EXPECT_TRUE((*recorder)->finish());
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(path);
    return text;
}

TEST(Waves, EachScopeIsOpenedOnceAndNoneIsEmpty) {
    for (const std::vector<std::string>& signals : {std::vector<std::string>{"X.*"}, {}, {"motion.?lp", "estop"}}) {
        std::istringstream text(recorded(".vcd", signals));
        std::set<std::string> scopes, names;
        std::string line, last;
        while (std::getline(text, line) && line != "$enddefinitions $end") {
            std::istringstream words(line);
            std::string kind, type, name;
            words >> kind >> type >> name;
            EXPECT_TRUE(kind != "$scope" || scopes.insert(name).second) << name << " is opened twice";
            EXPECT_TRUE(kind != "$upscope" || last == "$var") << "a scope with nothing in it";
            if (kind == "$var") {
                words >> name >> name;
                EXPECT_TRUE(names.insert(name).second) << name;
            }
            last = kind;
        }
        EXPECT_EQ(names.count("X_limit_minus"), signals.size() == 2 ? 0u : 1u);
        for (const std::string& name : names) EXPECT_EQ(name.find("_2_"), std::string::npos) << name;
    }
}

TEST(Waves, ACsvRecordingHasEveryChangeInOrderOfTime) {
    std::istringstream text(recorded(".csv", {"X.step", "X.dir", "motion.xlp"}));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "time_s,signal,value\r");
    double before = 0;
    int rises = 0;
    std::int64_t pulses = 0, counter = 0;
    int sense = 1;
    std::string name;
    while (std::getline(text, line)) {
        const std::size_t first = line.find(','), second = line.rfind(',');
        const double at = std::stod(line.substr(0, first));
        name = line.substr(first + 1, second - first - 1);
        const int value = std::stoi(line.substr(second + 1));
        EXPECT_GE(at, before);
        before = at;
        if (name == "X.dir") sense = value != 0 ? 1 : -1;
        if (name == "X.step" && value == 1) ++rises, pulses += sense;
        if (name == "motion.xlp") {
            counter = value;
            EXPECT_EQ(counter, pulses) << "LP at " << at;
        }
    }
    EXPECT_EQ(rises, 2240);
    EXPECT_EQ(pulses, 320);
    EXPECT_EQ(counter, 320);
}

TEST(Waves, AFileOfAnotherKindIsRefused) {
    EXPECT_EQ(wave_format("a.vcd").value(), WaveFormat::vcd);
    EXPECT_EQ(wave_format("a.csv").value(), WaveFormat::csv);
    EXPECT_EQ(wave_format("a.h5").value(), WaveFormat::hdf5);
    for (const char* name : {"a.hdf5", "a", ".vcd", "a.vcd.gz", ""}) EXPECT_FALSE(wave_format(name)) << name;
    EXPECT_NE(wave_format("a.txt").error().message.find(".h5"), std::string::npos);
}

TEST(Waves, TheUnitShowsEachEdgeThatAScaleOfItsCountRateHas) {
    const auto unit_at = [](const std::string& megahertz) {
        const std::string grating = "scales = 1\n[card.host]\ntype = \"grating_bus\"\nscales = 1\n";
        Rack rack(
            *read_rack_text(
                 "[card.decoder]\ntype = \"grating_decoder\"\n" + grating +
                 "[stage.mask]\ncard = \"host\"\ninput = 0\n[stage.mask.scale]\nmax_count_rate_mhz = " + megahertz)
                 .config);
        RecorderTap tap(rack.kernel());
        const std::string path =
            (std::filesystem::temp_directory_path() / ("motionrack_unit_" + std::to_string(::getpid()) + ".vcd"))
                .string();
        RecorderSettings waves;
        waves.sink = wave_sink({path});
        waves.signals = {"mask.scale.?"};
        waves.tap = &tap;
        auto recorder = Recorder::create(rack, waves);
        rack.start();
        (*recorder)->begin();
        EXPECT_TRUE((*recorder)->finish());
        const std::string text = text_of(path);
        std::filesystem::remove(path);
        const std::size_t at = text.find("$timescale ") + 11;
        return text.substr(at, text.find(" $end", at) - at);
    };
    EXPECT_EQ(unit_at("10"), "100 ns");
    EXPECT_EQ(unit_at("100"), "10 ns") << "an edge of a line each 15 ns";
    EXPECT_EQ(unit_at("1000"), "1 ns");
}

TEST(Waves, RejectsAnUnknownSignalWithAMessage) {
    Rack rack(*read_rack_text(*rack_template("single")).config);
    const std::string path = (std::filesystem::temp_directory_path() / "motionrack_no_signal.vcd").string();
    RecorderSettings waves;
    waves.sink = wave_sink({path});
    waves.signals = {"Q.*"};
    const auto recorder = Recorder::create(rack, waves);
    ASSERT_FALSE(recorder);
    EXPECT_NE(recorder.error().message.find("Q.*"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path)) << "nothing was recorded";
}

}  // namespace
}  // namespace motionrack::rack
