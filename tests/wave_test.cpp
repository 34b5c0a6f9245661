// What a job records as waves, counted by a stranger: sigrok-cli reads the VCD file of a run.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <unistd.h>

namespace motionrack::rack {
namespace {

/// The last number that a sigrok decoder tells.
int last_number(const std::string& path, const std::string& decoder, const std::string& row) {
    const std::string command = "sigrok-cli -I vcd -i " + path + " -P " + decoder + " -A " + row + " 2>/dev/null";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return -1;
    int last = -1;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe)) {
        const std::string text = line.data();
        const std::size_t colon = text.find(": ");
        if (colon != std::string::npos) last = std::atoi(text.c_str() + colon + 2);
    }
    ::pclose(pipe);
    return last;
}

TEST(Waves, SigrokCountsThePulsesAndEncoderEdgesOfAJob) {
    if (std::system("sigrok-cli --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "sigrok-cli is not installed: apt-get install sigrok-cli";
    const std::string path = (std::filesystem::temp_directory_path() / ("motionrack_wave_" + std::to_string(::getpid()) + ".vcd")).string();
    const std::string program = "G21 G90\nG1 X2 Y1 F600\nG1 X0.5\nM2\n";
    JobOutcome outcome;
    {
        Rack rack(*read_rack_text(*rack_template("router")).config);
        WaveSettings waves;
        waves.path = path;
        waves.signals = {"X.*"};
        auto recorder = WaveRecorder::create(rack, waves);
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
    // 2 mm there and 1.5 mm back: 640 pulses and 800 encoder counts a millimetre.
    EXPECT_EQ(outcome.axes[0].pulses_sent, 2240);
    EXPECT_EQ(last_number(path, "counter:data=X_step:data_edge=rising", "counter=edge_count"), 2240);
    EXPECT_EQ(last_number(path, "stepper_motor:step=X_step:dir=X_dir", "stepper_motor=position"), 321) << "told when it is left";
    EXPECT_EQ(outcome.axes[0].counts_read, 400);
    EXPECT_EQ(last_number(path, "graycode:d0=X_enc_a:d1=X_enc_b", "graycode=count"), 401);
    std::filesystem::remove(path);
}

TEST(Waves, AnUnknownSignalIsRefusedWithASentence) {
    Rack rack(*read_rack_text(*rack_template("single")).config);
    WaveSettings waves;
    waves.path = (std::filesystem::temp_directory_path() / "motionrack_no_signal.vcd").string();
    waves.signals = {"Q.*"};
    const auto recorder = WaveRecorder::create(rack, waves);
    ASSERT_FALSE(recorder);
    EXPECT_NE(recorder.error().message.find("Q.*"), std::string::npos);
    std::filesystem::remove(waves.path);
}

}  // namespace
}  // namespace motionrack::rack
