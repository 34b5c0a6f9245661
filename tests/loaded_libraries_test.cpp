// Counts the shared libraries that a command loads: each one costs start-up time and adds foreign code.
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

class LoadedLibraries : public InFolder {
  protected:
    /// Returns those that the loader has initialised, at the start or later.
    std::set<std::string> libraries_of(const std::string& arguments) const {
        const Ran ran = shell("LD_DEBUG=libs " MOTIONRACK_PROGRAM " " + arguments);
        std::istringstream lines(ran.out);
        std::set<std::string> out;
        const std::string mark = "calling init: ";
        for (std::string line; std::getline(lines, line);)
            if (const std::size_t at = line.find(mark); at != std::string::npos)
                out.insert(line.substr(at + mark.size()));
        EXPECT_FALSE(out.empty()) << ran.out;
        return out;
    }
    static bool has(const std::set<std::string>& libraries, const std::string& part) {
        for (const std::string& one : libraries)
            if (one.find(part) != std::string::npos) return true;
        return false;
    }
};

TEST_F(LoadedLibraries, LoadsOnlyTheLibrariesThatItNeeds) {
    for (const char* arguments :
         {"check examples/02_part/part.ngc", "run examples/01_first_move/first_move.ngc --no-report"}) {
        const std::set<std::string> libraries = libraries_of(arguments);
        EXPECT_LE(libraries.size(), 14u) << arguments;
        for (const char* part :
             {"librsvg", "libcairo", "libpango", "libglib", "libhdf5", "libcurl", "libddsc", "libiceoryx", "libnats"})
            EXPECT_FALSE(has(libraries, part)) << part;
    }
}

TEST_F(LoadedLibraries, LoadsTheRecordingLibraryOnFirstUse) {
    EXPECT_TRUE(
        has(libraries_of("run examples/01_first_move/first_move.ngc --no-report --record first.h5"), "libhdf5"));
    EXPECT_TRUE(has(libraries_of("report first.h5"), "libhdf5"));
}

TEST_F(LoadedLibraries, LoadsTheImageLibraryOnFirstUse) {
    const std::string job = "mark examples/marking/square.toml --picture ";
    EXPECT_FALSE(has(libraries_of(job + "square.svg"), "librsvg"));
    EXPECT_TRUE(has(libraries_of(job + "square.png"), "librsvg"));
    EXPECT_TRUE(std::filesystem::file_size(folder / "square.png") > 1000);
}

}  // namespace
}  // namespace motionrack
