// What the commands of `frames` share: the options of a bus on the network, and frames and counts as people and
// programs read them.
#pragma once

#include <motionrack/dds/subscriber.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <string>

namespace motionrack::cli {

/// Which bus on which network.
struct BusOptions {
    std::string name = "grating", config;
    int domain = 0;
};
void add_bus_options(CLI::App& command, BusOptions& options);
/// Lets the network engine read `config`, if one is named, instead of what CYCLONEDDS_URI has. Errors: io.
Result<void> use_config(const BusOptions& options);

/// What a subscriber knows at `now`, as one line of JSON.
std::string status_json(const dds::Subscriber& subscriber, const std::string& bus, Instant now);
/// An event as one line of JSON; its time counts from `start`.
std::string event_json(const dds::Event& event, Instant start);
/// The same as a table of several lines, each ended.
std::string status_table(const dds::Subscriber& subscriber, const std::string& bus, Instant now);
/// In one line without its end.
std::string status_line(const dds::Subscriber& subscriber, Instant now);

// ---- a rack's own frames

/// What every card of the rack's bus holds, as a table of several lines, each ended.
std::string frames_table(const rack::FrameMonitor& watch, Instant now);
/// The same as one line of JSON.
std::string frames_json(const rack::FrameMonitor& watch, Instant now);
/// The oldest `most` conflicts that are remembered, each with time, line and drivers; empty if there were none.
std::string conflicts_text(const grating_bus::Bus& bus, std::size_t most);
/// No conflicts, no bad frames, nothing stale, and all frames true and the same.
bool frames_agree(const rack::FrameMonitor& watch);

void add_frames_show(CLI::App& frames, Action& chosen);
void add_frames_publish(CLI::App& frames, Action& chosen);
void add_frames_feed(CLI::App& frames, Action& chosen);
void add_frames_subscribe(CLI::App& frames, Action& chosen);

}  // namespace motionrack::cli
