#include <fcntl.h>
#include <fmt/format.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <motionrack/frontends/server/pseudo_terminal.hpp>
#include <utility>

namespace motionrack::server {

namespace fs = std::filesystem;

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    if (this != &other) {
        if (file_ >= 0) ::close(file_);
        file_ = other.give();
    }
    return *this;
}

OpenFile::~OpenFile() {
    if (file_ >= 0) ::close(file_);
}

int OpenFile::give() {
    return std::exchange(file_, -1);
}

namespace {

tl::unexpected<Error> failed(const std::string& what) {
    return fail(ErrorKind::io, fmt::format("The pseudo-terminal was not created: {}: {}.", what, std::strerror(errno)));
}

/// Reserves a link for this process: binds an abstract socket name, which the kernel releases when the process ends.
Result<OpenFile> reserve(const std::string& link) {
    std::error_code trouble;
    const fs::path path =
        fs::weakly_canonical(fs::absolute(link, trouble).parent_path(), trouble) / fs::path(link).filename();
    const std::string name =
        fmt::format("motionrack-pty-{}-{:x}", ::geteuid(), std::hash<std::string>()(path.string()));
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
    OpenFile out(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    if (out.number() < 0) return failed("socket");
    if (::bind(out.number(), reinterpret_cast<const sockaddr*>(&address),
               static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size())) == 0)
        return out;
    if (errno != EADDRINUSE) return failed("bind");
    return fail(ErrorKind::io,
                fmt::format("The pseudo-terminal was not created: another running program has the link {}. "
                            "Give another path, or end that program.",
                            link));
}

/// Checks that the path is free, or a link to a pseudo-terminal that belongs to this user.
Result<void> check_place(const std::string& link) {
    struct stat about {};
    if (::lstat(link.c_str(), &about) != 0) return {};
    const auto refused = [&](const std::string& why) {
        return fail(
            ErrorKind::io,
            fmt::format(
                "The pseudo-terminal was not created: {} {}. It was not changed; give another path, or remove it.",
                link, why));
    };
    if (!S_ISLNK(about.st_mode)) return refused("is there and is not a symbolic link");
    std::error_code trouble;
    const std::string target = fs::read_symlink(link, trouble).string();
    if (target.compare(0, 9, "/dev/pts/") != 0)
        return refused(fmt::format("leads to {}, which is not a pseudo-terminal", target));
    if (about.st_uid != ::geteuid()) return refused("is the link of another user");
    return {};
}

/// Creates the link, or replaces it atomically.
Result<void> lead(const std::string& link, const std::string& target) {
    MOTIONRACK_CHECK(check_place(link));
    std::error_code trouble;
    const std::string beside = fmt::format("{}.{}", link, ::getpid());
    fs::remove(beside, trouble);
    fs::create_symlink(target, beside, trouble);
    if (!trouble) fs::rename(beside, link, trouble);
    if (!trouble) return {};
    std::error_code ignored;
    fs::remove(beside, ignored);
    return fail(ErrorKind::io, fmt::format("The pseudo-terminal was not created: the link {} to {}: {}.", link, target,
                                           trouble.message()));
}

}  // namespace

Result<PseudoTerminal> PseudoTerminal::open(const std::string& link) {
    PseudoTerminal out;
    MOTIONRACK_TRY(out.reserved_, reserve(link));
    out.master_ = OpenFile(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    if (out.master_.number() < 0 || ::grantpt(out.master_.number()) != 0 || ::unlockpt(out.master_.number()) != 0)
        return failed("posix_openpt");
    std::array<char, 128> name{};
    if (::ptsname_r(out.master_.number(), name.data(), name.size()) != 0) return failed("ptsname");
    out.name_ = name.data();
    out.slave_ = OpenFile(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    if (out.slave_.number() < 0) return failed(out.name_);
    if (::fchmod(out.slave_.number(), S_IRUSR | S_IWUSR) != 0) return failed(out.name_);
    termios line{};
    if (::tcgetattr(out.slave_.number(), &line) != 0) return failed(out.name_);
    ::cfmakeraw(&line);
    ::cfsetspeed(&line, B115200);
    if (::tcsetattr(out.slave_.number(), TCSANOW, &line) != 0) return failed(out.name_);
    out.watch_ = OpenFile(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
    if (out.watch_.number() < 0 || ::inotify_add_watch(out.watch_.number(), name.data(), IN_OPEN | IN_CLOSE) < 0)
        return failed("inotify");
    MOTIONRACK_CHECK(lead(link, out.name_));
    out.link_ = link;
    return out;
}

PseudoTerminal::~PseudoTerminal() {
    std::error_code trouble;
    if (slave_.number() >= 0 && !link_.empty() && fs::read_symlink(link_, trouble) == name_) fs::remove(link_, trouble);
}

void PseudoTerminal::forget_unread() {
    ::tcflush(slave_.number(), TCIFLUSH);
}

PseudoTerminal::ClientActivity PseudoTerminal::poll_client() {
    ClientActivity out;
    alignas(inotify_event) std::array<char, 4096> events{};
    for (ssize_t got = 0; (got = ::read(watch_.number(), events.data(), events.size())) > 0;) {
        for (ssize_t at = 0; at < got;) {
            inotify_event event{};
            std::memcpy(&event, events.data() + at, sizeof event);
            at += static_cast<ssize_t>(sizeof event + event.len);
            if ((event.mask & IN_OPEN) != 0)
                out.came = clients_++ == 0 || out.came;
            else if ((event.mask & IN_CLOSE) != 0 && clients_ > 0)
                out.left = --clients_ == 0 || out.left;
        }
    }
    return out;
}

}  // namespace motionrack::server
