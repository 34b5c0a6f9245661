// The image, byte by byte: header, payload, CRC-32.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/card.hpp>

namespace motionrack::ioflex02 {

void Card::control(std::uint16_t word) {
    Configuration& c = state_.configuration;
    if (field("CONTROL", "CONFIGURE").test(word)) {
        c = {};
        begin_project(state_, kernel_.now(), no_sample);  // discards the state of the previous project
        c.array = ArrayState::loading;
        put_out(0);
    }
    if (field("CONTROL", "END").test(word) && c.array == ArrayState::loading) refuse(CfgError::cut_short);
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
    state_.configuration.array = ArrayState::failed;
    state_.configuration.error = error;
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

/// Reads the project and its modes from header and payload.
void Card::take_project() {
    Configuration& c = state_.configuration;
    c.known = c.header.named(position_project);
    if (!c.known) c.error = CfgError::unknown_project;
    for (std::size_t i = 0; i < axis_count; ++i)
        c.modes[i] = static_cast<std::uint16_t>(c.payload[2 * i] | c.payload[2 * i + 1] << 8) & mode::all;
    c.array = ArrayState::starting;
}

/// Loads the array before the kernel starts; the project begins at instant 0.
void Card::preload(std::span<const std::uint8_t> image) {
    Configuration& c = state_.configuration;
    std::copy_n(image.begin(), image_header, c.header.bytes.begin());
    std::copy_n(image.begin() + image_header, min_payload, c.payload.begin());
    take_project();
    c.starts_at = Instant{0};
}

void Card::accept() {
    Configuration& c = state_.configuration;
    take_project();
    if (!c.known) report(CardCondition::unknown_project, c.header.ident());
    c.starts_at = kernel_.now() + settings_.configuration_time;
    catch_up(kernel_.now(), false);
}

}  // namespace motionrack::ioflex02
