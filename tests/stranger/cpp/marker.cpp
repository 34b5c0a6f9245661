// A program that runs a marking job; built against the installed package.
#include <cstdio>
#include <motionrack/mark/render.hpp>

int main() {
    using namespace motionrack::mark;
    const JobRead read =
        read_job("[drawing]\ntext = 'A1'\n[belt]\nvelocity_mm_s = 100\n[fly]\nmode = 'encoder'\n", "mine");
    const Load none = [](const std::string&) -> motionrack::Result<std::string> {
        return motionrack::fail(motionrack::ErrorKind::io, "no files");
    };
    if (!read.job) return 1;
    const auto prepared = prepare(*read.job, none);
    if (!prepared) return 2;
    const auto outcome = run_job(*read.job, *prepared);
    if (!outcome) return 3;
    std::printf("%s within 5 um, %zu pictures\n", outcome->on.deviation.max_mm < 0.005 ? "marked" : "not",
                pictures_of(*prepared, *outcome).size());
}
