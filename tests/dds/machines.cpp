// Makes network namespaces, each held by a process, and joins them by virtual cables (veth).
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <tests/dds/machines.hpp>
#include <utility>

namespace motionrack::dds_test {

namespace {

constexpr int own_network = -1;

/// Makes the kernel kill this process when its parent ends for any reason.
void die_with_parent() {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

bool enter(pid_t holder, const char* space) {
    const int file = ::open(("/proc/" + std::to_string(holder) + "/ns/" + space).c_str(), O_RDONLY | O_CLOEXEC);
    const bool good = file >= 0 && ::setns(file, 0) == 0;
    if (file >= 0) ::close(file);
    return good;
}

[[noreturn]] void become(const Command& command) {
    std::vector<char*> arguments;
    for (const std::string& each : command) arguments.push_back(const_cast<char*>(each.c_str()));
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
}

/// Moves this process to a new network namespace: as root, or as root of a new user namespace if that is permitted.
bool leave_the_network() {
    if (::unshare(CLONE_NEWNET | CLONE_NEWUTS) == 0) return true;
    const std::string user = "0 " + std::to_string(::getuid()) + " 1", group = "0 " + std::to_string(::getgid()) + " 1";
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNET | CLONE_NEWUTS) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << user;
    std::ofstream("/proc/self/gid_map") << group;
    return true;
}

}  // namespace

Machines::Machines(int count) {
    if (!make(count)) why_not_ = "Nothing was tested: network namespaces cannot be created here (" + why_not_ + ")";
}

Machines::~Machines() {
    for (const pid_t holder : holders_) {
        ::kill(holder, SIGKILL);
        ::waitpid(holder, nullptr, 0);
    }
}

bool Machines::make(int count) {
    if (!leave_the_network()) {
        why_not_ = std::string("unshare: ") + std::strerror(errno);
        return false;
    }
    if (!run(own_network, {"ip", "link", "add", "br0", "type", "bridge", "mcast_snooping", "0"})) return false;
    if (!run(own_network, {"ip", "link", "set", "br0", "up"})) return false;
    for (int i = 0; i < count; ++i)
        if (!add_machine()) return false;
    return true;
}

bool Machines::add_machine() {
    std::array<int, 2> ready{};
    if (::pipe2(ready.data(), O_CLOEXEC) != 0) return false;
    const auto number = holders_.size();
    const std::string name = "machine" + std::to_string(number);
    const pid_t holder = ::fork();
    if (holder == 0) {
        die_with_parent();
        const bool good = ::unshare(CLONE_NEWNET | CLONE_NEWUTS) == 0 && ::sethostname(name.c_str(), name.size()) == 0;
        const char sign = good ? '1' : '0';
        if (::write(ready[1], &sign, 1) != 1) ::_exit(1);
        for (;;) ::pause();
    }
    if (holder > 0) holders_.push_back(holder);
    char sign = '0';
    ::close(ready[1]);
    const bool made = holder > 0 && ::read(ready[0], &sign, 1) == 1 && sign == '1';
    ::close(ready[0]);
    if (!made) {
        why_not_ = "a machine's namespaces";
        return false;
    }
    const std::string port = "p" + std::to_string(number), address = "10.77.0." + std::to_string(number + 1) + "/24";
    const int machine = static_cast<int>(number);
    return run(own_network,
               {"ip", "link", "add", port, "type", "veth", "peer", "name", "eth0", "netns", std::to_string(holder)}) &&
           run(own_network, {"ip", "link", "set", port, "master", "br0", "up"}) &&
           run(machine, {"ip", "link", "set", "lo", "up"}) &&
           run(machine, {"ip", "address", "add", address, "dev", "eth0"}) &&
           run(machine, {"ip", "link", "set", "eth0", "up"});
}

bool Machines::run(int machine, const Command& command) {
    const pid_t process = ::fork();
    if (process == 0) {
        die_with_parent();
        ::setenv("PATH", "/usr/sbin:/usr/bin:/sbin:/bin", 1);
        const int nowhere = ::open("/dev/null", O_RDWR);
        ::dup2(nowhere, 1);
        ::dup2(nowhere, 2);
        if (machine != own_network && !enter(holders_[static_cast<std::size_t>(machine)], "net")) ::_exit(126);
        become(command);
    }
    int status = 0;
    const bool good =
        process > 0 && ::waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!good) {
        why_not_ = "failed:";
        for (const std::string& word : command) why_not_ += " " + word;
    }
    return good;
}

Child Machines::start(int machine, const Command& command) {
    std::array<int, 2> output{};
    if (::pipe2(output.data(), O_CLOEXEC) != 0) return {-1, -1};
    const pid_t process = ::fork();
    if (process == 0) {
        die_with_parent();
        ::dup2(output[1], 1);
        const pid_t holder = holders_[static_cast<std::size_t>(machine)];
        if (!enter(holder, "net") || !enter(holder, "uts")) ::_exit(126);
        ::unsetenv("CYCLONEDDS_URI");
        become(command);
    }
    ::close(output[1]);
    return {process, output[0]};
}

void Machines::set_link(int machine, bool up) {
    run(own_network, {"ip", "link", "set", "p" + std::to_string(machine), up ? "up" : "down"});
}

bool Machines::begin_loss(int machine) {
    const std::string port = "p" + std::to_string(machine);
    // Loses a quarter of the packets; if the kernel has no netem, limits the rate, so that the excess is lost.
    return run(own_network, {"tc", "qdisc", "add", "dev", port, "root", "netem", "loss", "25%"}) ||
           run(own_network,
               {"tc", "qdisc", "add", "dev", port, "root", "tbf", "rate", "300kbit", "burst", "3000", "limit", "3000"});
}

void Machines::end_loss(int machine) {
    run(own_network, {"tc", "qdisc", "del", "dev", "p" + std::to_string(machine), "root"});
}

Child::Condition is_event(const std::string& kind) {
    return [kind](const nlohmann::json& line) { return line.value("event", "") == kind; };
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      output_(std::exchange(other.output_, -1)),
      rest_(std::move(other.rest_)),
      said_(std::move(other.said_)),
      last_(std::move(other.last_)),
      events_(std::move(other.events_)) {}

Child::~Child() {
    if (output_ >= 0) ::close(output_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

void Child::send(int signal) {
    if (process_ > 0) ::kill(process_, signal);
}

std::string Child::said() const {
    return said_.size() > 2000 ? "..." + said_.substr(said_.size() - 2000) : said_;
}

/// Reads the next line. Returns false at the end of the output, or after a minute without a line.
bool Child::read_line() {
    static constexpr int a_minute = 60'000;
    for (;;) {
        if (const std::size_t end = rest_.find('\n'); end != std::string::npos) {
            const std::string line = rest_.substr(0, end);
            rest_.erase(0, end + 1);
            said_ += line + "\n";
            last_ = nlohmann::json::parse(line, nullptr, false);
            if (last_.is_object() && last_.contains("event")) events_[last_["event"].get<std::string>()] = last_;
            return true;
        }
        pollfd waiting{output_, POLLIN, 0};
        std::array<char, 4096> piece;
        if (output_ < 0 || ::poll(&waiting, 1, a_minute) <= 0) return false;
        const ssize_t got = ::read(output_, piece.data(), piece.size());
        if (got <= 0) return false;
        rest_.append(piece.data(), static_cast<std::size_t>(got));
    }
}

bool Child::wait_for(const Condition& condition) {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < limit && read_line())
        if (last_.is_object() && condition(last_)) return true;
    return false;
}

bool Child::wait_for_event(const std::string& kind) {
    if (reported(kind)) {
        last_ = events_[kind];
        return true;
    }
    return wait_for(is_event(kind));
}

int Child::finish() {
    while (read_line()) {
    }
    int status = 0;
    if (process_ <= 0 || ::waitpid(process_, &status, 0) != process_) return -1;
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace motionrack::dds_test
