// The states of the array by their table, and the image, byte by byte: header, payload, CRC-32.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/card.hpp>

namespace motionrack::ioflex02 {

namespace {

/// Reads the project and its modes from header and payload.
void take_project(Configuration& c) {
    c.known = c.header.named(position_project);
    if (!c.known) c.error = CfgError::unknown_project;
    for (std::size_t i = 0; i < axis_count; ++i)
        c.modes[i] = static_cast<std::uint16_t>(c.payload[2 * i] | c.payload[2 * i + 1] << 8) & mode::all;
}

// ---- the state table

void begin_image(State& state, const ArrayChange& change) {
    state.configuration = {};
    state.configuration.array = ArrayState::loading;
    begin_project(state, change.now, no_sample);  // discards the state of the previous project
}
void note_error(State& state, const ArrayChange& change) {
    state.configuration.error = change.error;
}
void begin_start(State& state, const ArrayChange& change) {
    take_project(state.configuration);
    state.configuration.starts_at = change.now + change.configuration_time;
}
bool is_configured(const State& state, const ArrayChange& change) {
    return state.configuration.starts_at <= change.now;
}
void begin_running(State& state, const ArrayChange&) {
    const Instant at = state.configuration.starts_at;
    state.reported_no_project = 0;
    begin_project(state, at, sample_from(at) - 1);
}

struct ArraySteps {
    using enum ArrayState;
    static constexpr StateRow<State, ArrayState, ArrayEvent, const ArrayChange&> rows[] = {
        {empty, ArrayEvent::configure, loading, nullptr, begin_image},
        {loading, ArrayEvent::configure, loading, nullptr, begin_image},
        {loading, ArrayEvent::refused, failed, nullptr, note_error},
        {loading, ArrayEvent::complete, starting, nullptr, begin_start},
        {starting, ArrayEvent::configure, loading, nullptr, begin_image},
        {starting, ArrayEvent::time, running, is_configured, begin_running},
        {running, ArrayEvent::configure, loading, nullptr, begin_image},
        {failed, ArrayEvent::configure, loading, nullptr, begin_image},
    };
    static_assert(declared<rows_flaw(machine_named(map::machines, "array"), rows)>());
};

}  // namespace

bool step_array(State& state, ArrayEvent event, const ArrayChange& change) {
    return step(ArraySteps::rows, state.configuration.array, event, state, change);
}

// ---- commands and bytes

void Card::control(std::uint16_t word) {
    if (field("CONTROL", "CONFIGURE").test(word)) {
        step_array(state_, ArrayEvent::configure, {.now = kernel_.now()});
        put_out(0);
    }
    if (field("CONTROL", "END").test(word)) refuse(CfgError::cut_short);
    if (!has_project()) return;
    if (field("CONTROL", "RESET").test(word)) {
        begin_project(state_, kernel_.now(), kernel_.now() / sample_time);
        put_out(0);
    }
    if (!field("CONTROL", "CLEAR_ERRORS").test(word)) return;
    for (EncoderAxisState& axis : state_.axes) {
        axis.illegal = 0;
        axis.reported = 0;
    }
}

void Card::refuse(CfgError error) {
    if (!step_array(state_, ArrayEvent::refused, {.now = kernel_.now(), .error = error})) return;
    report(CardCondition::image_refused, static_cast<std::int64_t>(error), state_.configuration.received);
}

void Card::take_word(std::uint16_t word) {
    // If the number of bytes is odd, the high byte of the last word is ignored.
    for (int i = 0; i < 2 && state_.configuration.array == ArrayState::loading; ++i)
        take_byte(static_cast<std::uint8_t>(word >> (8 * i)));
}

void Card::take_byte(std::uint8_t byte) {
    Configuration& c = state_.configuration;
    const std::uint32_t at = c.received++;
    if (at < image_header) {
        c.header.bytes[at] = byte;
        if (at < image_header - 4) c.crc = crc32_of(c.crc, &byte, 1);
        if (at + 1 == image_magic.size() && !c.header.ours()) return refuse(CfgError::foreign);
        if (at + 1 == image_header && (c.header.length() < min_payload || c.header.length() > max_payload))
            refuse(CfgError::length);
        return;
    }
    const auto payload = static_cast<std::uint32_t>(at - image_header);
    if (payload < c.payload.size()) c.payload[payload] = byte;
    c.crc = crc32_of(c.crc, &byte, 1);
    if (payload + 1 < c.header.length()) return;
    if (c.crc != c.header.crc()) return refuse(CfgError::crc);
    accept();
}

/// Loads the array before the kernel starts: the card powers up as starting, and the project begins at instant 0.
void Card::preload(std::span<const std::uint8_t> image) {
    Configuration& c = state_.configuration;
    std::copy_n(image.begin(), image_header, c.header.bytes.begin());
    std::copy_n(image.begin() + image_header, min_payload, c.payload.begin());
    take_project(c);
    c.array = ArrayState::starting;
    c.starts_at = Instant{0};
}

void Card::accept() {
    const Configuration& c = state_.configuration;
    step_array(state_, ArrayEvent::complete,
               {.now = kernel_.now(), .configuration_time = settings_.configuration_time});
    if (!c.known) report(CardCondition::unknown_project, c.header.ident());
    catch_up(kernel_.now(), false);
}

}  // namespace motionrack::ioflex02
