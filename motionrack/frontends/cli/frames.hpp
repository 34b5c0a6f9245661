// Shared parts of the `frames` commands: options of a bus on the network, and frames and counts as text and JSON.
#pragma once

#include <motionrack/dds/subscriber.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <string>

namespace motionrack::cli {

/// Selects a bus and its network.
struct BusOptions {
    std::string name = "grating", config;
    int domain = 0;
};
void add_bus_options(CLI::App& command, BusOptions& options);
/// Makes the network engine read `config`, if given, instead of CYCLONEDDS_URI. Errors: io.
Result<void> use_config(const BusOptions& options);

/// Returns the state of a subscriber at `now` as one line of JSON.
std::string status_json(const dds::Subscriber& subscriber, const std::string& bus, Instant now);
/// Returns an event as one line of JSON, with its time relative to `start`.
std::string event_json(const dds::BusEvent& event, Instant start);
/// Returns the state of a subscriber as a table of several lines, each with a line end.
std::string status_table(const dds::Subscriber& subscriber, const std::string& bus, Instant now);
/// Returns the state of a subscriber as one line without a line end.
std::string status_line(const dds::Subscriber& subscriber, Instant now);

// ---- the frames of a rack

/// Returns the frames of every card on the rack's bus as a table of several lines, each with a line end.
std::string frames_table(const rack::FrameMonitor& watch, Instant now);
/// Returns the frames of every card as one line of JSON.
std::string frames_json(const rack::FrameMonitor& watch, Instant now);
/// Returns up to `max_conflicts` of the oldest stored conflicts, each with time, line and drivers; empty if none
/// occurred.
std::string conflicts_text(const grating_bus::Bus& bus, std::size_t max_conflicts);
/// Returns true if no bus conflict occurred, no card's frame is stale, and all frames so far were undamaged, correct
/// and equal.
bool frames_agree(const rack::FrameMonitor& watch);

void add_frames_show(CLI::App& frames, Action& chosen);
void add_frames_publish(CLI::App& frames, Action& chosen);
void add_frames_feed(CLI::App& frames, Action& chosen);
void add_frames_subscribe(CLI::App& frames, Action& chosen);

}  // namespace motionrack::cli
