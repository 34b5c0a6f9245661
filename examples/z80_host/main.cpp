// The assembler listing of the DataBoard 4002's demonstration, assembled and run on a Z80.
//
//   demo4002.asm, os8.asm ──asmz──► bytes ──► Computer (libz80ex) ──► Machine (libmotionrack), Terminal
#include <cstdio>
#include <filesystem>

#include "asmz.hpp"
#include "computer.hpp"
#include "terminal.hpp"

namespace {

constexpr std::uint16_t origin = 0x4000;

const char* const usage =
    "Usage: example_z80_host run LISTING.ASM [ROUNDS [WIRE FROM UNTIL]]   runs it; os8.asm stands beside it\n"
    "       example_z80_host zilog LISTING.ASM                            prints it in Zilog's words\n"
    "       example_z80_host bytes LISTING.ASM                            writes its bytes to the standard output";

asmz::Program program_of(const std::string& listing) {
    const std::string names = std::filesystem::path(listing).replace_filename("os8.asm").string();
    return asmz::assemble({{names, old_host::file_text(names)}, {listing, old_host::file_text(listing)}}, origin);
}

int run(const old_host::Request& request) {
    const asmz::Program program = program_of(request.program);
    old_host::Machine machine(old_host::Computer::t_state_ns, request.press);
    old_host::Terminal terminal(machine, request.rounds);
    if (old_host::Computer(program, machine, terminal).run()) return 0;
    std::printf("The program has ended itself.\n");
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> words(argv + 1, argv + argc);
        const std::string what = words.empty() ? "" : words[0];
        if (what == "run") return run(old_host::request_of({words.begin() + 1, words.end()}, usage));
        if ((what != "zilog" && what != "bytes") || words.size() != 2) throw old_host::Failure(usage);
        const asmz::Program program = program_of(words[1]);
        const std::string text =
            what == "zilog" ? program.zilog : std::string(program.bytes.begin(), program.bytes.end());
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 5;
    } catch (const std::exception& failure) {
        std::fflush(stdout);  // the screen until then comes before the reason, in a pipe too
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
