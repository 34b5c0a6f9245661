// Formats the messages of events, and queues events.
#include <fmt/format.h>

#include <motionrack/dds/event_queue.hpp>

namespace motionrack::dds {

namespace {

constexpr const char* names[event_kinds] = {
    "joined",    "stale",   "fresh",     "lost",        "late",     "duplicate",     "jump",    "anew",
    "wrong_crc", "foreign", "malformed", "wrong_words", "conflict", "conflict_over", "restart", "takeover"};

/// Makes a source's text printable: it may contain arbitrary bytes from the network.
std::string printable(const PublisherIdentity& source) {
    std::string out = source.text();
    for (char& c : out)
        if (c < ' ' || c > '~') c = '?';
    return out;
}

std::string milliseconds_of(std::uint64_t ticks) {
    return fmt::format("{:g} ms", static_cast<double>(ticks) * 1e-7);
}

}  // namespace

const char* name_of(EventKind kind) {
    return names[static_cast<std::size_t>(kind)];
}

std::string sentence(const BusEvent& e) {
    const std::string who = printable(e.source);
    switch (e.kind) {
        case EventKind::joined:
            return fmt::format("{} publishes {} positions every {}.", who, e.number, milliseconds_of(e.limit));
        case EventKind::stale:
            return fmt::format(
                "No frame since {}: the positions of frame {} are stale and marked so. Check whether {} runs and the "
                "network works.",
                milliseconds_of(e.number), e.limit, who);
        case EventKind::fresh:
            return fmt::format("Frames are received again, from number {} on.", e.number);
        case EventKind::lost:
            return fmt::format(
                "{} frames after number {} did not come, {} so far. The next one is used; the lost ones are not "
                "replaced.",
                e.number, e.limit, e.total);
        case EventKind::late:
            return fmt::format(
                "Frame {} came after frame {}, {} so far. It is older than the current frame and was not used.",
                e.number, e.limit, e.total);
        case EventKind::duplicate:
            return fmt::format("Frame {} came twice, {} so far. The second was not used.", e.number, e.total);
        case EventKind::jump:
            return fmt::format(
                "Frame {} does not follow frame {}: its time does not fit its number; {} so far. It was not "
                "used.",
                e.number, e.limit, e.total);
        case EventKind::anew:
            return fmt::format(
                "The sequence of {} restarted: frame {} follows frame {}. Its card was reset; its frames are used.",
                who, e.number, e.limit);
        case EventKind::wrong_crc:
            return fmt::format("A frame of {} was damaged: its CRC is wrong; {} so far. It was not used.", who,
                               e.total);
        case EventKind::foreign:
            return fmt::format(
                "A sample of another format was received, {} so far. It was not used; check for another publisher of "
                "this bus name.",
                e.total);
        case EventKind::malformed:
            return fmt::format("A sample of {} has values that no publisher sends, {} so far. It was not used.", who,
                               e.total);
        case EventKind::wrong_words:
            return fmt::format("A frame of {} has {} positions, but {} are expected; {} so far. It was not used.", who,
                               e.number, e.limit, e.total);
        case EventKind::conflict:
            return fmt::format(
                "Two publishers on this bus: [{}] has it, and [{}] publishes too. Frames of the second are not used; "
                "stop it or give it "
                "another bus name.",
                who, printable(e.other));
        case EventKind::conflict_over:
            return fmt::format("[{}] is silent: [{}] is alone on the bus again.", printable(e.other), who);
        case EventKind::restart:
            return fmt::format("The publisher was restarted: [{}] follows [{}].", who, printable(e.other));
        case EventKind::takeover:
            return fmt::format("Another computer has the bus: [{}] follows [{}], which is silent.", who,
                               printable(e.other));
    }
    return {};
}

bool EventQueue::open(EventKind kind, Instant now) const {
    const auto at = static_cast<std::size_t>(kind);
    return !reported_[at] || now - last_[at] >= min_distance;
}

void EventQueue::put(const BusEvent& event) {
    const auto kind = static_cast<std::size_t>(event.kind);
    reported_[kind] = true;
    last_[kind] = event.when;
    if (count_ == ring_.size()) return;
    ring_[(first_ + count_++) % ring_.size()] = event;
}

bool EventQueue::take(BusEvent& event) {
    if (count_ == 0) return false;
    event = ring_[first_];
    first_ = (first_ + 1) % ring_.size();
    --count_;
    return true;
}

}  // namespace motionrack::dds
