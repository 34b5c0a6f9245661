// frames feed: a local rack whose remote cards receive the frames of a bus on another computer, in real time.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/remote_feed.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/frames.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>

namespace motionrack::cli {

namespace {

struct FeedOptions {
    BusOptions bus;
    std::string rack;
    double seconds = 0, every = 0.5;
    bool json = false, quiet = false;
};

std::vector<grating_bus::Card*> remote_cards(rack::Rack& rack) {
    std::vector<grating_bus::Card*> out;
    if (grating_bus::Bus* bus = rack::grating_bus_of(rack))
        for (grating_bus::Card* card : bus->cards())
            if (card->is_remote()) out.push_back(card);
    return out;
}

void run_to(sim::Kernel& kernel, Instant at) {
    while (kernel.run_until(at) == sim::RunEnd::broken) {
    }
}

void show(const FeedOptions& options, const rack::FrameMonitor& watch, Instant now) {
    if (options.quiet) return;
    fmt::print("{}", options.json ? frames_json(watch, now) + "\n" : frames_table(watch, now));
    std::fflush(stdout);
}

/// Runs the rack in real time and passes received frames to its remote cards. Returns the number of frames delivered.
std::uint64_t run_feed(const FeedOptions& options, rack::Rack& rack, const rack::FrameMonitor& watch,
                       dds::RemoteFeed& feed) {
    const std::vector<grating_bus::Card*> cards = remote_cards(rack);
    sim::Kernel& kernel = rack.kernel();
    const Instant begin = dds::monotonic_now(), end = options.seconds > 0 ? from_seconds(options.seconds) : never;
    const Duration every = from_seconds(options.every);
    std::uint64_t given = 0;
    Instant now{}, next = every;
    while (!stop_asked.load() && now < end) {
        feed.subscriber().wait(std::min({end - now, next - now, milliseconds(2)}));
        now = std::max(now, dds::monotonic_now() - begin);
        run_to(kernel, now);
        given += static_cast<std::uint64_t>(feed.give(now, [&cards](const grating_bus::Frame& frame, Instant at) {
            for (grating_bus::Card* card : cards) card->take(frame, at);
        }));
        for (dds::BusEvent event; feed.subscriber().judge().next_event(event);)
            if (!options.json && !options.quiet) fmt::print(stderr, "{}\n", dds::sentence(event));
        if (now < next) continue;
        show(options, watch, now);
        next = std::max(next + every, now);
    }
    show(options, watch, now);
    return given;
}

int feed_rack(const FeedOptions& options) {
    if (!(options.seconds >= 0 && options.seconds <= 1e8) || !(options.every > 0 && options.every <= 1e6)) {
        print_error(
            fmt::format("--duration is {:g} s and --interval {:g} s; they must be 0 to 1e8, and more than 0 up to 1e6. "
                        "Nothing was opened.",
                        options.seconds, options.every));
        return exit_usage;
    }
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    rack::Rack rack(*config);
    if (remote_cards(rack).empty()) {
        print_error(
            "The rack has no remote card; give it a section [card.NAME] with type = \"grating_bus\" and role = "
            "\"remote\". Nothing was opened.");
        return exit_usage;
    }
    if (const Result<void> done = use_config(options.bus); !done) return report(done.error());
    dds::SubscriberSettings settings;
    settings.bus = options.bus.name;
    settings.domain = options.bus.domain;
    settings.judge.words = remote_cards(rack).front()->settings().scales;
    auto subscriber = dds::Subscriber::open(settings);
    if (!subscriber) return report(subscriber.error());
    dds::RemoteFeed feed(std::move(*subscriber));
    const rack::FrameMonitor watch(rack);
    rack.start();
    stop_on_signals();
    const std::uint64_t given = run_feed(options, rack, watch, feed);
    if (stop_asked.load()) return exit_stopped;
    if (given != 0) return exit_done;
    print_error(
        fmt::format("No frame came on bus '{}' that the rack's cards could take. Check whether a publisher runs under "
                    "this bus name, and whether it has {} scales.",
                    options.bus.name, settings.judge.words));
    return exit_machine;
}

}  // namespace

void add_frames_feed(CLI::App& frames, Action& chosen) {
    auto options = std::make_shared<FeedOptions>();
    CLI::App* command = frames.add_subcommand(
        "feed", "Run a rack whose remote cards hold the frames that another computer publishes, in real time");
    command->add_option("RACK", options->rack, "rack file with a card whose role is \"remote\"")->required();
    add_bus_options(*command, options->bus);
    command->add_option("--duration", options->seconds, "end after this time, s");
    command->add_option("--interval", options->every, "seconds between two tables")->capture_default_str();
    command->add_flag("--json", options->json, "print the tables as lines of JSON");
    command->add_flag("-q,--quiet", options->quiet, "print no tables");
    command->footer(
        "Example: motionrack frames feed listeners.toml --bus stage\nCtrl-C ends it. Exit code 4: no frame came that "
        "the cards could take.");
    command->callback([options, &chosen] { chosen = [options] { return feed_rack(*options); }; });
}

}  // namespace motionrack::cli
