// Validates samples.
#include <algorithm>
#include <motionrack/dds/frame_validator.hpp>

namespace motionrack::dds {

namespace {

/// A sequence number less than this distance ahead is newer; all others are older.
constexpr std::uint32_t half = 0x8000'0000U;

/// Returns the event of a validation result; malformed for a result without an event of its own.
EventKind kind_of(Validation verdict) {
    switch (verdict) {
        case Validation::duplicate:
            return EventKind::duplicate;
        case Validation::late:
            return EventKind::late;
        case Validation::jump:
            return EventKind::jump;
        case Validation::wrong_crc:
            return EventKind::wrong_crc;
        case Validation::foreign:
            return EventKind::foreign;
        case Validation::wrong_words:
            return EventKind::wrong_words;
        case Validation::used:
        case Validation::other_source:
        case Validation::malformed:
            break;
    }
    return EventKind::malformed;
}

bool good_name(const PublisherIdentity& source) {
    const std::string_view name = source.host_name();
    return !name.empty() && name.size() < source.host.size() &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

bool in_range(std::int64_t ticks) {
    return ticks >= shortest_period.count() && ticks <= max_period.count();
}

}  // namespace

const char* name_of(Validation verdict) {
    static constexpr const char* names[] = {"used",    "duplicate", "late",        "jump",        "wrong crc",
                                            "foreign", "malformed", "wrong words", "other source"};
    return names[static_cast<std::size_t>(verdict)];
}

std::uint64_t& FrameValidator::count_of(Validation verdict) {
    switch (verdict) {
        case Validation::used:
            return counts_.used;
        case Validation::duplicate:
            return counts_.duplicates;
        case Validation::late:
            return counts_.late;
        case Validation::jump:
            return counts_.jumps;
        case Validation::wrong_crc:
            return counts_.wrong_crc;
        case Validation::foreign:
            return counts_.foreign;
        case Validation::malformed:
            return counts_.malformed;
        case Validation::wrong_words:
            return counts_.wrong_words;
        case Validation::other_source:
            return counts_.other_source;
    }
    return counts_.malformed;
}

Duration FrameValidator::release() const {
    return std::max(settings_.release, Duration{2 * pace_});
}

bool FrameValidator::in_conflict() const {
    return std::any_of(others_.begin(), others_.begin() + static_cast<std::ptrdiff_t>(other_count_),
                       [](const OtherSource& other) { return other.in_conflict; });
}

/// Checks the content of a sample, independent of earlier samples.
Validation FrameValidator::check(const Sample& sample) const {
    if (sample.format != wire_format) return Validation::foreign;
    if (sample.frame.words < 1 || sample.frame.words > grating_bus::max_scales) return Validation::malformed;
    if (sample.check != check_of(sample) || !sound(sample.frame)) return Validation::wrong_crc;
    if (!in_range(sample.period) || !in_range(sample.pace) || sample.frame.time < 0 || !good_name(sample.source))
        return Validation::malformed;
    return Validation::used;
}

/// Returns true if `after` continues `before`: its time is later by as many periods as its sequence number, plus or
/// minus one.
bool FrameValidator::fits(const Frame& before, const Frame& after) const {
    __extension__ using Wide = __int128;
    const std::uint32_t ahead = after.sequence - before.sequence;
    if (ahead == 0 || ahead >= half || after.time <= before.time) return false;
    const Wide off = Wide{after.time - before.time} - Wide{ahead} * period_;
    return off <= period_ && off >= -period_;
}

Validation FrameValidator::take(const Sample& sample, Instant now) {
    ++counts_.received;
    if (joined_ && !stale_ && now - used_at_ > Duration{2 * pace_}) {
        stale_ = true;
        ++counts_.stale;
    }
    forget_silent(now);
    if (const Validation verdict = check(sample); verdict != Validation::used) return bad(verdict, sample, now);
    const bool own = joined_ && sample.source == source_;
    const bool silent = !joined_ || now - heard_at_ > release();
    if (!own && !silent) {
        note_other(sample.source, now);
        ++counts_.other_source;
        return Validation::other_source;
    }
    if (settings_.words != 0 && sample.frame.words != static_cast<std::uint32_t>(settings_.words))
        return bad(Validation::wrong_words, sample, now);
    if (!own) {
        hand_bus_to(sample, now);
        return use(sample.frame, now);
    }
    heard_at_ = now;
    find_conflicts(now);
    return follow(sample, now);
}

/// Validates a frame of the source that owns the bus.
Validation FrameValidator::follow(const Sample& sample, Instant now) {
    const Frame& frame = sample.frame;
    if (frame.words != frame_.words) return bad(Validation::wrong_words, sample, now);
    if (sample.period != period_ || sample.pace != pace_) return bad(Validation::malformed, sample, now);
    if (fits(frame_, frame)) {
        const std::uint32_t ahead = frame.sequence - frame_.sequence;
        if (ahead > 1) {
            counts_.lost += ahead - 1;
            if (events_.open(EventKind::lost, now))
                events_.put({EventKind::lost, now, source_, {}, ahead - 1, frame_.sequence, counts_.lost});
        }
        window_.advance(ahead);
        return use(frame, now);
    }
    if ((frame.sequence == frame_.sequence && frame.time == frame_.time) || fits(frame, frame_)) {
        const std::uint32_t behind = frame_.sequence - frame.sequence;
        const bool missing = window_.fill(behind);
        if (missing) --counts_.lost;
        return bad(missing || !window_.knows(behind) ? Validation::late : Validation::duplicate, sample, now);
    }
    if (doubtful_ && fits(doubt_, frame)) {
        ++counts_.anew;
        if (events_.open(EventKind::anew, now))
            events_.put({EventKind::anew, now, source_, {}, frame.sequence, frame_.sequence, counts_.anew});
        window_.begin(frame.sequence);
        return use(frame, now);
    }
    doubt_ = frame;
    doubtful_ = true;
    return bad(Validation::jump, sample, now);
}

Validation FrameValidator::use(const Frame& frame, Instant now) {
    frame_ = frame;
    used_at_ = now;
    doubtful_ = false;
    stale_ = false;
    if (stale_reported_) events_.put({EventKind::fresh, now, source_, {}, frame.sequence, 0, counts_.stale});
    stale_reported_ = false;
    ++counts_.used;
    return Validation::used;
}

Validation FrameValidator::bad(Validation verdict, const Sample& sample, Instant now) {
    const std::uint64_t total = ++count_of(verdict);
    const EventKind kind = kind_of(verdict);
    if (!events_.open(kind, now)) return verdict;
    const bool words = verdict == Validation::wrong_words;
    const std::uint64_t expected = settings_.words != 0 ? static_cast<std::uint64_t>(settings_.words) : frame_.words;
    events_.put({kind,
                 now,
                 sample.source,
                 {},
                 words ? sample.frame.words : sample.frame.sequence,
                 words ? expected : frame_.sequence,
                 total});
    return verdict;
}

void FrameValidator::hand_bus_to(const Sample& sample, Instant now) {
    BusEvent event{
        EventKind::joined, now, sample.source, source_, sample.frame.words, static_cast<std::uint64_t>(sample.pace), 1};
    if (joined_) {
        const bool same_host = sample.source.host == source_.host;
        event.kind = same_host ? EventKind::restart : EventKind::takeover;
        event.total = ++(same_host ? counts_.restarts : counts_.takeovers);
    }
    events_.put(event);
    joined_ = true;
    source_ = sample.source;
    period_ = sample.period;
    pace_ = sample.pace;
    heard_at_ = now;
    window_.begin(sample.frame.sequence);
    for (std::size_t i = 0; i < other_count_; ++i)
        if (others_[i].source == source_) {
            others_[i] = others_[--other_count_];
            break;
        }
}

void FrameValidator::note_other(const PublisherIdentity& source, Instant now) {
    const auto end = others_.begin() + static_cast<std::ptrdiff_t>(other_count_);
    auto at = std::find_if(others_.begin(), end, [&](const OtherSource& other) { return other.source == source; });
    if (at == end) {
        if (other_count_ == max_others) return;
        ++other_count_;
        *at = OtherSource{source, 0, now, false};
    }
    ++at->frames;
    at->last_received = now;
}

/// Reports a conflict with each other source in the list: the owner has published after it, so both publish. A source
/// that takes over from a silent one is removed from the list first and causes no conflict.
void FrameValidator::find_conflicts(Instant now) {
    for (std::size_t i = 0; i < other_count_; ++i) {
        OtherSource& other = others_[i];
        if (other.in_conflict) continue;
        other.in_conflict = true;
        ++counts_.conflicts;
        events_.put({EventKind::conflict, now, source_, other.source, other.frames, 0, counts_.conflicts});
    }
}

void FrameValidator::forget_silent(Instant now) {
    for (std::size_t i = 0; i < other_count_;) {
        if (now - others_[i].last_received <= release()) {
            ++i;
            continue;
        }
        if (others_[i].in_conflict)
            events_.put(
                {EventKind::conflict_over, now, source_, others_[i].source, others_[i].frames, 0, counts_.conflicts});
        others_[i] = others_[--other_count_];
    }
}

void FrameValidator::poll(Instant now) {
    forget_silent(now);
    if (!joined_ || now - used_at_ <= Duration{2 * pace_}) return;
    if (!stale_) {
        stale_ = true;
        ++counts_.stale;
    }
    if (stale_reported_ || !events_.open(EventKind::stale, now)) return;
    stale_reported_ = true;
    events_.put({EventKind::stale,
                 now,
                 source_,
                 {},
                 static_cast<std::uint64_t>((now - used_at_).count()),
                 frame_.sequence,
                 counts_.stale});
}

}  // namespace motionrack::dds
