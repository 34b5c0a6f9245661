// Floods by clients without a token: their resource use, and the delay of STOP under load.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <motionrack/journal/journal.hpp>
#include <random>
#include <tests/answer_delay.hpp>
#include <tests/environment.hpp>
#include <tests/ran.hpp>
#include <tests/served_program.hpp>
#include <thread>

namespace motionrack {
namespace {

using Clock = std::chrono::steady_clock;

/// One connection from an address of loopback.
class Stranger {
  public:
    Stranger(int port, std::uint32_t address) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in from{}, to{};
        from.sin_family = to.sin_family = AF_INET;
        from.sin_addr.s_addr = htonl(INADDR_LOOPBACK + address);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        to.sin_port = htons(static_cast<std::uint16_t>(port));
        const int on = 1;
        ::setsockopt(socket_, SOL_IP, IP_BIND_ADDRESS_NO_PORT, &on, sizeof on);
        const linger at_once{1, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
        const timeval some_seconds{10, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &some_seconds, sizeof some_seconds);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &some_seconds, sizeof some_seconds);
        ::bind(socket_, reinterpret_cast<const sockaddr*>(&from), sizeof from);
        there_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
    }
    ~Stranger() { ::close(socket_); }
    Stranger(const Stranger&) = delete;
    Stranger& operator=(const Stranger&) = delete;

    bool send(const std::string& text) const {
        return there_ && ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    }
    /// Returns the first received bytes; empty if the connection was closed.
    std::string hear() const {
        std::string text(4096, '\0');
        const ssize_t got = ::recv(socket_, text.data(), text.size(), 0);
        text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
        return text;
    }

  private:
    int socket_;
    bool there_ = false;
};

std::string request(const std::string& method, const std::string& target, const std::string& body,
                    const std::string& fields = "") {
    return method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + fields +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

class RequestFlood : public InFolder {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("one.toml", "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n");
    }

    struct Seen {
        std::size_t lost = 0;
        std::int64_t asked = 0, memory = 0, disk = 0;
    };
    std::int64_t disk() const {
        std::int64_t bytes = 0;
        for (const char* end : {"", "-wal", "-shm"}) {
            std::error_code none;
            const auto size = std::filesystem::file_size((folder / "one.journal").string() + end, none);
            if (!none) bytes += static_cast<std::int64_t>(size);
        }
        return bytes;
    }
    static std::int64_t memory_of(pid_t process) {
        std::ifstream file("/proc/" + std::to_string(process) + "/statm");
        std::int64_t all = 0, resident = 0;
        file >> all >> resident;
        return resident * ::sysconf(_SC_PAGESIZE);
    }

    /// Floods with pairing by long names, invented tokens, STOPs, incomplete requests, WebSockets that send invalid
    /// data and read nothing, and short-lived connections: each from many addresses.
    static void flood(int port, unsigned kind, const std::atomic<bool>& quit, std::atomic<std::int64_t>& asked) {
        // The flood represents other computers, so it must not use the CPU time of the server.
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 19);
        std::mt19937 random(kind);
        std::vector<std::unique_ptr<Stranger>> held;
        const std::string name(900, 'x');
        while (!quit) {
            held.push_back(std::make_unique<Stranger>(port, random() % 8 == 0 ? 0 : 1 + random() % 2000));
            const Stranger& one = *held.back();
            bool open = true;
            for (int i = 0; i < 50 && open && !quit; ++i, ++asked) {
                if (kind == 0)
                    open =
                        one.send(request("POST", "/api/pair",
                                         "{\"code\":\"" + std::to_string(random()) + "\",\"name\":\"" + name + "\"}"));
                if (kind == 1)
                    open = one.send(request("POST", "/api/enable", "{}",
                                            "Authorization: Bearer " + std::to_string(random()) + "\r\n"));
                if (kind == 2) open = one.send(request("POST", "/api/stop", ""));
                if (kind == 3)
                    open = one.send(i == 0 ? "GET /api/stream HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n"
                                             "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                             "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
                                           : std::string("\x81\x82\0\0\0\0{}", 8));
                if (kind == 4 && i == 0) open = one.send("POST /api/pair HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Len");
            }
            while (held.size() > (kind >= 3 ? 300 : 10)) held.erase(held.begin());
        }
    }

    /// Runs a flood for `time` and sends this number of STOPs meanwhile. Nine of ten are answered in time.
    Seen flood_beside(std::size_t stops, std::chrono::seconds time) {
        Seen seen;
        Served served({(folder / "one.toml").string(), "--port", "0", "--journal", (folder / "one.journal").string(),
                       "--users", (folder / "users.json").string()});
        EXPECT_TRUE(served.post("stop").contains("done"));
        const std::int64_t memory = memory_of(served.process()), before = disk();
        std::atomic<bool> quit{false};
        std::atomic<std::int64_t> asked{0};
        std::vector<std::thread> threads;
        for (unsigned kind = 0; kind < 5; ++kind)
            threads.emplace_back(flood, served.port(), kind, std::cref(quit), std::ref(asked));
        test::AnswerDelays delays(served.process());
        for (const auto end = Clock::now() + time; delays.count() < stops || Clock::now() < end;) {
            delays.measure([&] {
                const Stranger one(served.port(), 0);
                const bool heard = one.send(request("POST", "/api/stop", "")) && one.hear().find("200 OK") == 9;
                seen.lost += !heard;
            });
            if (time.count() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        quit = true;
        for (std::thread& one : threads) one.join();
        seen.asked = asked;
        seen.memory = memory_of(served.process()) - memory;
        seen.disk = disk() - before;
        EXPECT_EQ(served.end(SIGTERM), 0);
        for (const double part : {0.5, 0.9}) delays.expect_in_time(part, "a flood of strangers");
        return seen;
    }
    static void tell(const Seen& seen) {
        std::printf("%lld requests of strangers: disk %+.2f MB, memory %+.1f MB; %zu STOPs not heard\n",
                    static_cast<long long>(seen.asked), static_cast<double>(seen.disk) / 1e6,
                    static_cast<double>(seen.memory) / 1e6, seen.lost);
    }
};

TEST_F(RequestFlood, BesideAHundredStopsFillsNeitherDiskNorMemoryAndStopIsExecuted) {
    const Seen seen = flood_beside(100, std::chrono::seconds(0));
    tell(seen);
    EXPECT_EQ(seen.lost, 0u);
    EXPECT_LT(seen.disk, 5'000'000);
    EXPECT_LT(seen.memory, 64'000'000);
    auto book = journal::Journal::open((folder / "one.journal").string());
    ASSERT_TRUE(book) << book.error().message;
    const auto audit = (*book)->read({0, "audit", 10000});
    EXPECT_GT(audit->size(), 0u);
    EXPECT_LT(audit->size(), 200u);
    for (const journal::Entry& entry : *audit) EXPECT_LE(entry.text.size(), 200u) << entry.text;
    EXPECT_LT((*book)->read({0, "", 10000})->size(), 400u);
}

/// The duration is MOTIONRACK_FLOOD_SECONDS if set.
TEST_F(RequestFlood, OfAMinuteFillsNeitherDiskNorMemoryAndStopIsExecuted) {
    const Seen seen = flood_beside(0, std::chrono::seconds(from_environment("MOTIONRACK_FLOOD_SECONDS", 60)));
    tell(seen);
    EXPECT_EQ(seen.lost, 0u);
    EXPECT_LT(seen.disk, 10'000'000);
    EXPECT_LT(seen.memory, 64'000'000);
}

}  // namespace
}  // namespace motionrack
