// The BASIC II listing of the DataBoard 4002's demonstration, run statement by statement.
//
//   demo4002.bas ──read──► Program ──► Interpreter ──► Machine (libmotionrack), Terminal
#include <cstdio>

#include "../z80_host/terminal.hpp"
#include "interpreter.hpp"
#include "program.hpp"

namespace {

constexpr std::uint64_t bus_access_ns = 1000;

int run(const old_host::Request& request) {
    const basic::Program program = basic::read(request.program, old_host::file_text(request.program));
    old_host::Machine machine(bus_access_ns, request.press);
    old_host::Terminal terminal(machine, request.rounds);
    return basic::Interpreter(program, machine, terminal).run() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(old_host::request_of({argv + 1, argv + argc},
                                        "Usage: example_basic_host LISTING.BAS [ROUNDS [WIRE FROM UNTIL]]"));
    } catch (const std::exception& failure) {
        std::fflush(stdout);  // the screen until then comes before the reason, in a pipe too
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
