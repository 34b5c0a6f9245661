// Serves a virtual card to another program through files, and runs that program:
//
//   live_server memory|port8|port|databoard4002 [--real-time] PROGRAM [ARGUMENT]...
//
//   memory    an MCX314, whose registers are words of a file that PROGRAM maps (with a trap, see trap.hpp)
//   port      an MCX314, whose registers are bytes of a file that PROGRAM reads and writes two by two (FUSE);
//             port8: one by one
//   databoard4002   a DataBoard 4002, whose ports are bytes of such a file
//
// PROGRAM finds the address of its card in MOTIONRACK_LIVE_PORT, and the doorbell for simulated time in
// MOTIONRACK_LIVE_DOORBELL. Returns the exit code of PROGRAM; 77 if this computer cannot serve.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <tests/live/doorbell.hpp>
#include <tests/live/mapped_file.hpp>
#include <tests/live/served_files.hpp>
#include <tests/live/virtual_card.hpp>
#include <thread>
#include <vector>

using namespace motionrack;
using namespace motionrack::live_test;

namespace {

constexpr std::size_t page = 4096;
constexpr std::size_t first_register = page - 16;  // an access that is too wide leaves the page
constexpr int cannot_serve = 77;

/// Answers the requests of the doorbell until destruction.
class Attendant {
  public:
    Attendant(VirtualCard& card, Doorbell& bell, char* registers)
        : card_(card), bell_(bell), registers_(registers), thread_([this] { attend(); }) {}
    ~Attendant() {
        end_ = true;
        wake(bell_.asked);
        thread_.join();
    }

  private:
    void attend() {
        while (!end_) {
            const std::uint32_t asked = bell_.asked.load();
            if (asked == bell_.answered.load()) {
                sleep_while(bell_.asked, asked);
                continue;
            }
            answer();
            bell_.answered.store(asked);
            wake(bell_.answered);
        }
    }
    void answer() {
        auto& word = *reinterpret_cast<volatile std::uint16_t*>(registers_ + first_register + (bell_.offset & 14u));
        switch (bell_.what) {
            case Question::read:
                word = card_.read(bell_.offset & 14u, 16);
                break;
            case Question::write:
                card_.write(bell_.offset & 14u, 16, word);
                break;
            case Question::pass:
                card_.pass(Duration{bell_.value});
                break;
            case Question::interrupt:
                bell_.value = card_.run_to_interrupt(Duration{bell_.value}) ? 1 : 0;
                break;
        }
    }

    VirtualCard& card_;
    Doorbell& bell_;
    char* registers_;
    std::atomic<bool> end_{false};
    std::thread thread_;
};

pid_t child = 0;  // global for the signal handler

/// Forwards SIGTERM and SIGINT to the program.
void hand_on(int signal) {
    ::kill(child, signal);
}

int run_program(char** words) {
    child = ::fork();
    if (child == 0) {
        ::execv(words[0], words);
        std::perror(words[0]);
        ::_exit(1);
    }
    ::signal(SIGTERM, hand_on);
    ::signal(SIGINT, hand_on);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::unique_ptr<VirtualCard> make_card(const std::string& face, bool real_time, std::atomic<std::int64_t>& now) {
    if (face == "databoard4002") return std::make_unique<VirtualDataboard4002>(real_time, now);
    return std::make_unique<VirtualMcx314>(real_time, now);
}

int serve(const std::filesystem::path& folder, const std::string& face, bool real_time, char** words) {
    const std::string registers_path = folder / "registers", bell_path = folder / "doorbell", mount = folder / "files";
    std::filesystem::create_directory(mount);
    const MappedFile registers(registers_path, page, true), bell(bell_path, page, true);
    if (!registers || !bell) return std::perror("live_server"), 1;

    const std::unique_ptr<VirtualCard> card = make_card(face, real_time, bell.as<Doorbell>().now);
    std::string why;
    const auto files = ServedFiles::serve(*card, mount, why);
    std::string port = "memory:" + registers_path + ",offset=" + std::to_string(first_register);
    if (face != "memory") {
        if (!files) return std::printf("%s Nothing was tested.\n", why.c_str()), cannot_serve;
        port = "port:" + mount + "/port,offset=" + std::to_string(port_base);
        if (face == "port8") port += ",width=8";
    }
    if (files) port += ",interrupt=" + mount + "/uio0";
    ::setenv("MOTIONRACK_LIVE_PORT", port.c_str(), 1);
    if (!real_time) ::setenv("MOTIONRACK_LIVE_DOORBELL", bell_path.c_str(), 1);
    const Attendant attendant(*card, bell.as<Doorbell>(), &registers.as<char>());
    return run_program(words);
}

}  // namespace

int main(int argc, char** argv) {
    int next = 1;
    const std::string face = next < argc ? argv[next++] : "";
    const bool real_time = next < argc && std::string(argv[next]) == "--real-time";
    if (real_time) ++next;
    const std::array faces = {"memory", "port", "port8", "databoard4002"};
    if (next >= argc || std::find(faces.begin(), faces.end(), face) == faces.end() || (real_time && face == "memory")) {
        std::fprintf(stderr,
                     "live_server memory|port|port8|databoard4002 [--real-time] PROGRAM [ARGUMENT]... (no real time in "
                     "memory)\n");
        return 1;
    }
    std::string folder = (std::filesystem::temp_directory_path() / "motionrack-live-XXXXXX").string();
    if (!::mkdtemp(folder.data())) return std::perror("live_server"), 1;
    const int code = serve(folder, face, real_time, argv + next);
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    return code;
}
