// The motionrack program: command line only.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/live/last_stop.hpp>
#include <new>
#include <string_view>
#include <utility>

namespace {

constexpr const char* footer = R"(Examples:
  motionrack run part.ngc --rack router.toml     run a program, write report.html
  motionrack check part.ngc --rack router.toml   list all errors, move nothing
  motionrack home XY --rack router.toml          home the axes, report the switches found
  motionrack run part.ngc --record part.h5       record all data of a run
  motionrack diff a.h5 b.h5                      the first difference of two recordings
  motionrack sweep feeds.toml -o feeds.csv       a program with many parameter values
  motionrack new router > router.toml            a commented rack file to start from
  motionrack serve router.toml                   operate a rack in a browser
  motionrack decode run.vcd                      count the encoders in a logic capture
  motionrack describe mcx314                     the card's registers, commands and states
  motionrack docs                                the documentation in a browser

Exit codes: 0 done, 1 wrong command line, 2 wrong input (nothing moved), 3 refused (nothing moved),
4 the machine stopped the job, 5 a file could not be read or written, 6 the two differ (diff, replay),
130 stopped by Ctrl-C.
motionrack COMMAND --help describes a command.)";

/// Flushes standard output; reports a write error.
int flushed(int code) {
    using namespace motionrack::cli;
    errno = 0;
    const bool lost = std::ferror(stdout) != 0, out = std::fflush(stdout) == 0;
    if (out && !lost) return code;
    print_error(fmt::format("Standard output could not be written: {}. Files that were written are complete.",
                            std::strerror(errno != 0 ? errno : EIO)));
    return code == exit_done ? static_cast<int>(exit_io) : code;
}

/// Reports a failed allocation; allocates no memory itself.
int say_out_of_memory() {
    static constexpr char sentence[] =
        "error: Not enough memory. The command was aborted: files written before are complete, all others unchanged. "
        "Close other programs, or reduce the job.\n";
    static_cast<void>(!::write(STDERR_FILENO, sentence, sizeof sentence - 1));
    return motionrack::cli::exit_io;
}

const std::terminate_handler terminate_before = std::get_terminate();

/// On failed allocation in a thread or a noexcept function, ends the program with the same sentence. Real cards were
/// stopped before.
[[noreturn]] void end_now() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        std::_Exit(say_out_of_memory());
    } catch (...) {
    }
    terminate_before();
    std::abort();
}

/// Prints the present names of renamed options on a rejected command line. Returns false if it has none.
bool name_renamed_options(int argc, char** argv) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 8> renamed = {
        {{"--speed", "--time-scale"},
         {"--speeds", "--velocities"},
         {"--free", "--unthrottled"},
         {"--no-pairing", "--no-auth"},
         {"--for", "--duration"},
         {"--every", "--interval"},
         {"--fresh", "--restart"},
         {"--type", "--method"}}};
    bool any = false;
    for (int i = 1; i < argc; ++i) {
        const std::string_view given = argv[i], name = given.substr(0, given.find('='));
        for (const auto& [old, now] : renamed) {
            if (name != old) continue;
            motionrack::cli::print_error(fmt::format("'{}' is now '{}'.", old, now));
            any = true;
        }
    }
    return any;
}

int run_command(int argc, char** argv) {
    using namespace motionrack::cli;
    CLI::App app{"Motionrack: a rack of motion-control cards, in software.", "motionrack"};
    app.footer(footer);
    app.set_version_flag("--version", "motionrack " MOTIONRACK_VERSION);
    app.require_subcommand(1);
    Action chosen;
    add_run(app, chosen);
    add_home(app, chosen);
    add_check(app, chosen);
    add_new(app, chosen);
    add_describe(app, chosen);
    add_registers(app, chosen);
    add_trace(app, chosen);
    add_report(app, chosen);
    add_diff(app, chosen);
    add_replay(app, chosen);
    add_canon(app, chosen);
    add_plan(app, chosen);
    add_sweep(app, chosen);
    add_sweep_worker(app, chosen);
    add_decode(app, chosen);
    add_frames(app, chosen);
    add_mark(app, chosen);
    add_calibrate(app, chosen);
    add_image(app, chosen);
    add_serve(app, chosen);
    add_docs(app, chosen);
    add_bench(app, chosen);
    add_completion(app, chosen);
    add_manual(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ExtrasError& e) {
        if (!name_renamed_options(argc, argv)) app.exit(e);
        return exit_usage;
    } catch (const CLI::ParseError& e) {
        // Help and version are not errors; all others are usage errors.
        return app.exit(e) == 0 ? exit_done : exit_usage;
    }
    return chosen ? flushed(chosen()) : exit_usage;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace motionrack::cli;
    motionrack::live::stop_live_cards_at_terminate(end_now);
    try {
        return run_command(argc, argv);
    } catch (const std::bad_alloc&) {
        return say_out_of_memory();
    } catch (const std::exception& e) {
        print_error(fmt::format("{}. The command was aborted; files written before are complete.", e.what()));
        return exit_io;
    }
}
