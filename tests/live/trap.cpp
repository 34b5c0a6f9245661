// Signal handlers of the trap.
#include <sys/mman.h>
#include <ucontext.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <tests/live/trap.hpp>

namespace motionrack::live_test {

namespace {

struct Trapped {
    char* page = nullptr;
    std::size_t length = 0;
    void (*before)(const Touch&) = nullptr;
    void (*after)(const Touch&) = nullptr;
    Touch access;
    struct sigaction old_segv, old_trap;
};

/// Global for the signal handlers.
Trapped trapped;

void close_page() {
    ::mprotect(trapped.page, trapped.length, PROT_NONE);
}
void open_page() {
    ::mprotect(trapped.page, trapped.length, PROT_READ | PROT_WRITE);
}

#if defined(__x86_64__)

constexpr greg_t single_step = 0x100, write_fault = 2;

greg_t& flags_of(void* context) {
    return static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL];
}

void on_segv(int, siginfo_t* info, void* context) {
    char* const place = static_cast<char*>(info->si_addr);
    if (place < trapped.page || place >= trapped.page + trapped.length) {
        // Not caused by the trap: the fault repeats with the previous handler.
        ::sigaction(SIGSEGV, &trapped.old_segv, nullptr);
        return;
    }
    const bool writes = (static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_ERR] & write_fault) != 0;
    trapped.access = {static_cast<std::size_t>(place - trapped.page), writes};
    trapped.before(trapped.access);
    open_page();
    flags_of(context) |= single_step;
}

void on_trap(int, siginfo_t*, void* context) {
    close_page();
    flags_of(context) &= ~single_step;
    trapped.after(trapped.access);
}

#else

void on_segv(int, siginfo_t*, void*) {
    std::abort();
}
void on_trap(int, siginfo_t*, void*) {
    std::abort();
}

#endif

void handle(int signal, void (*handler)(int, siginfo_t*, void*), struct sigaction& old) {
    struct sigaction action {};
    action.sa_sigaction = handler;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(signal, &action, &old);
}

}  // namespace

bool Trap::possible() {
#if defined(__x86_64__)
    return true;
#else
    return false;
#endif
}

void* Trap::mapping_of(const std::string& path) {
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        if (line.size() < path.size() || line.compare(line.size() - path.size(), path.size(), path) != 0) continue;
        std::uintptr_t start = 0;
        std::istringstream(line) >> std::hex >> start;
        return reinterpret_cast<void*>(start);
    }
    return nullptr;
}

Trap::Trap(void* page, std::size_t length, void (*before)(const Touch&), void (*after)(const Touch&)) {
    trapped.page = static_cast<char*>(page);
    trapped.length = length;
    trapped.before = before;
    trapped.after = after;
    handle(SIGSEGV, on_segv, trapped.old_segv);
    handle(SIGTRAP, on_trap, trapped.old_trap);
    close_page();
}

Trap::~Trap() {
    open_page();
    ::sigaction(SIGSEGV, &trapped.old_segv, nullptr);
    ::sigaction(SIGTRAP, &trapped.old_trap, nullptr);
}

}  // namespace motionrack::live_test
