// The VCD files that commands write are read by every reader, as those of a recording in progress.
#include <gtest/gtest.h>

#include <string>
#include <tests/ran.hpp>
#include <tests/wave_readers.hpp>

namespace motionrack {
namespace {

class WaveCommands : public InFolder {
  protected:
    /// Expects that the command writes w.vcd, which every reader reads.
    void expect_read(const std::string& arguments) const {
        SCOPED_TRACE(arguments);
        const Ran ran = motionrack(arguments);
        ASSERT_EQ(ran.code, 0) << ran.out;
        const std::string path = (folder / "w.vcd").string();
        EXPECT_GT(test::expect_every_reader_reads(path, test::StrictVcd(text_of(path))), 0) << "nothing moved";
        std::filesystem::remove(path);
    }
};

TEST_F(WaveCommands, WriteFilesThatEveryReaderReadsCompletely) {
    write("part.ngc", "G21 G90\nG1 X0.5 F600\nG1 X0.25\nM2\n");
    expect_read("frames examples/grating_bus/crate.toml --duration 0.0005 -q --vcd w.vcd");
    expect_read("run part.ngc --no-report -q --vcd w.vcd --signals 'X.*'");
    expect_read("trace part.ngc w.vcd -q --signals 'X.*'");
}

}  // namespace
}  // namespace motionrack
