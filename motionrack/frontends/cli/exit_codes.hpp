// Exit codes of the program, each with one meaning.
#pragma once

#include <motionrack/base/result.hpp>

namespace motionrack::cli {

enum ExitCode : int {
    exit_done = 0,
    exit_usage = 1,          ///< the command line is wrong
    exit_invalid_input = 2,  ///< a program or rack file is wrong; nothing moved
    exit_refused = 3,        ///< a request exceeds a limit; nothing moved
    exit_machine = 4,        ///< the machine stopped the job: limit switch, alarm, lost steps
    exit_io = 5,             ///< a file could not be read or written
    exit_differ = 6,         ///< diff and replay: the two differ
    exit_stopped = 130       ///< Ctrl-C; the recording so far is kept
};

constexpr int exit_code(ErrorKind trouble) {
    switch (trouble) {
        case ErrorKind::invalid_input:
            return exit_invalid_input;
        case ErrorKind::refused:
            return exit_refused;
        case ErrorKind::machine:
            return exit_machine;
        case ErrorKind::io:
            return exit_io;
        case ErrorKind::stopped:
            return exit_stopped;
    }
    return exit_usage;
}

}  // namespace motionrack::cli
