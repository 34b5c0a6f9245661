// Samples for tests: the positions of a sample follow from its number.
#pragma once

#include <motionrack/dds/frame_validator.hpp>

namespace motionrack::dds {

inline constexpr Duration period = microseconds(200);

inline PublisherIdentity source_named(std::uint8_t id, std::string_view host = "wafer1") {
    PublisherIdentity out;
    out.id.fill(id);
    for (std::size_t i = 0; i < host.size(); ++i) out.host[i] = host[i];
    out.process = 100U + id;
    return out;
}

inline void seal(Sample& sample) {
    if (sample.frame.words <= grating_bus::max_scales) sample.frame.crc = crc_of(sample.frame);
    sample.check = check_of(sample);
}

/// Makes the sample of frame `number`; the time of frame 0 is 1 ms.
inline Sample sample_of(const PublisherIdentity& source, std::uint32_t number, std::uint32_t words = 6) {
    Sample out;
    out.source = source;
    out.period = out.pace = period.count();
    out.frame.sequence = number;
    out.frame.time = (milliseconds(1) + std::int64_t{number} * period).count();
    out.frame.words = words;
    for (std::uint32_t i = 0; i < words; ++i) {
        out.frame.counts[i] = number * 1000 + i;
        out.frame.addresses[i] = static_cast<std::uint8_t>(i);
    }
    seal(out);
    return out;
}

}  // namespace motionrack::dds
