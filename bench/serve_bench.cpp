// Server under load: many WebSocket clients observe a job of four axes in real time.
//
//   this process: motion thread (main), network thread ◄──200 sockets──► child process: reads and counts
//
//   bench_serve [CLIENTS=200] [RATE_HZ=20] [SECONDS=20]
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <motionrack/frontends/server/served_rack.hpp>
#include <motionrack/frontends/server/test/web_client.hpp>
#include <motionrack/rack/config.hpp>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace motionrack;
using Clock = std::chrono::steady_clock;

constexpr const char* rack_text = R"(
[card.m]
type = "mcx314"
[axis.X]
card = "m"
channel = "x"
[axis.Y]
card = "m"
channel = "y"
[axis.Z]
card = "m"
channel = "z"
[axis.A]
card = "m"
channel = "u"
)";

std::string job() {
    std::string out = "G21 G90 G64\n";
    for (int i = 0; i < 2000; ++i) out += "G1 X20 Y10 Z5 A30 F3000\nG1 X20 Y0 Z0 A0\nG3 X0 Y0 R30\nG1 X5 Y5 Z1 A10\n";
    return out + "M2\n";
}

struct Load {
    int clients = 200;
    double rate_hz = 20, seconds = 20;
};

struct Counted {
    std::int64_t pictures = 0, lost = 0, bytes = 0, gone = 0;
    double seconds = 0;
};

std::int64_t number_behind(const std::string& text, const char* key) {
    const std::size_t at = text.find(key);
    return at == std::string::npos ? 0 : std::atoll(text.c_str() + at + std::char_traits<char>::length(key));
}

/// Runs the child process: connects, subscribes and reads for the given time.
Counted read_pictures(std::uint16_t port, const Load& load) {
    std::vector<server::WebClient> clients;
    for (int i = 0; i < load.clients; ++i) {
        server::WebClient& client = clients.emplace_back(port);
        if (client.upgrade().status != 101) {
            fmt::print(stderr, "client {} was not let in\n", i);
            std::exit(1);
        }
        client.say({{"id", 1},
                    {"subscribe",
                     {{"channels", {"X.commanded", "Y.commanded", "Z.commanded", "A.commanded", "X.velocity"}},
                      {"rate_hz", load.rate_hz}}}});
    }
    std::vector<pollfd> ready;
    for (const server::WebClient& client : clients) ready.push_back({client.descriptor(), POLLIN, 0});
    Counted out;
    const auto begin = Clock::now();
    while ((out.seconds = std::chrono::duration<double>(Clock::now() - begin).count()) < load.seconds) {
        ::poll(ready.data(), ready.size(), 100);
        for (std::size_t i = 0; i < clients.size(); ++i) {
            if (ready[i].revents == 0) continue;
            while (clients[i].has_frame()) {
                const server::WebFrame frame = clients[i].receive();
                out.bytes += static_cast<std::int64_t>(frame.text.size());
                if (frame.kind != 1) {
                    ++out.gone;
                    ready[i].fd = -1;
                    break;
                }
                if (frame.text.rfind("{\"seq\":", 0) != 0) continue;
                ++out.pictures;
                out.lost += number_behind(frame.text, "\"lost\":");
            }
        }
    }
    return out;
}

/// Runs the parent process: serves until the child has finished counting.
std::unique_ptr<server::ServedRack> serve() {
    server::ServedSettings settings;
    settings.server.port = 0;
    settings.server.limits.requests_at_once = 1e6;
    auto served = server::ServedRack::open(*rack::read_rack_text(rack_text).config, std::move(settings));
    if (served) (void)(*served)->machine().enable(true);
    const Result<void> begun =
        served ? (*served)->machine().begin_program(job(), "load") : tl::unexpected<Error>(served.error());
    if (begun) return std::move(*served);
    fmt::print(stderr, "{}\n", begun.error().text());
    std::exit(1);
}

void tell(const operate::ClockPacer& pacer) {
    const operate::Lateness& late = pacer.lateness();
    const auto ms = [](Duration duration) { return to_seconds(duration) * 1000; };
    fmt::print(
        "slices          {}\nlateness p50    {:.3f} ms\nlateness p99    {:.3f} ms\nlateness p99.9  {:.3f} ms\nlateness "
        "max    {:.3f} ms\nlost            {:.3f} ms\n",
        late.count(), ms(late.within(0.5)), ms(late.within(0.99)), ms(late.within(0.999)), ms(late.max()),
        ms(pacer.lost()));
}

double processor_seconds(int who) {
    rusage usage = {};
    ::getrusage(who, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_megabytes() {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

int main(int argc, char** argv) {
    Load load;
    if (argc > 1) load.clients = std::atoi(argv[1]);
    if (argc > 2) load.rate_hz = std::atof(argv[2]);
    if (argc > 3) load.seconds = std::atof(argv[3]);
    int to_child[2], from_child[2];
    if (::pipe(to_child) != 0 || ::pipe(from_child) != 0) return 1;
    // Before any thread exists.
    const pid_t child = ::fork();
    if (child == 0) {
        std::uint16_t port = 0;
        if (::read(to_child[0], &port, sizeof port) != sizeof port) std::exit(1);
        const Counted counted = read_pictures(port, load);
        std::exit(::write(from_child[1], &counted, sizeof counted) == sizeof counted ? 0 : 1);
    }
    ::close(from_child[1]);
    const auto served = serve();
    const std::uint16_t port = served->server().port();
    Counted counted;
    std::int32_t line = 0;
    std::thread waiter([&] {
        if (::write(to_child[1], &port, sizeof port) != sizeof port ||
            ::read(from_child[0], &counted, sizeof counted) != sizeof counted)
            counted = {};
        line = served->panel().picture()->status().line;
        served->machine().quit();
    });
    served->run();
    served->stop();
    waiter.join();
    ::waitpid(child, nullptr, 0);
    fmt::print("clients         {} at {:g} Hz, {:.1f} s\n", load.clients, load.rate_hz, counted.seconds);
    fmt::print("pictures        {:.0f} a second, {} of {} lost, {:.1f} MB/s, {} clients gone\n",
               static_cast<double>(counted.pictures) / counted.seconds, counted.lost, counted.pictures + counted.lost,
               static_cast<double>(counted.bytes) / counted.seconds * 1e-6, counted.gone);
    tell(served->pacer());
    fmt::print("driven          {} lines\n", line);
    fmt::print("processor       {:.0f} % of one core served, {:.0f} % read\n",
               100 * processor_seconds(RUSAGE_SELF) / counted.seconds,
               100 * processor_seconds(RUSAGE_CHILDREN) / counted.seconds);
    fmt::print("memory          {:.1f} MB at most served\n", peak_megabytes());
    return 0;
}
