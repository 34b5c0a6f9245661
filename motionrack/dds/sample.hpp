// A sample: one frame of a grating bus as sent by a publisher, with its source and the interval of frames.
//
//   format | source id, host, process | period, pace | the frame: time, sequence, N, counts, addresses, CRC-32 | check
//
// The frame's CRC is that of the card. `check` is the CRC-32 of everything before it except the counts and addresses,
// which the frame's CRC covers.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <string>
#include <string_view>

namespace motionrack::dds {

using grating_bus::Frame;

/// A publisher. The random id is drawn when the publisher starts and identifies it; host and process are for readers.
struct PublisherIdentity {
    std::array<std::uint8_t, 16> id{};
    std::array<char, 64> host{};  ///< printable, padded with 0
    std::uint32_t process = 0;

    std::string_view host_name() const;
    /// Returns "host, process 123, id 0a1b2c3d4e5f6071..." with the complete id.
    std::string text() const;
    /// Returns the id as 32 hexadecimal digits.
    std::string id_text() const;
    friend bool operator==(const PublisherIdentity& a, const PublisherIdentity& b) { return a.id == b.id; }
};

/// Makes the identity of a new source: a random id, this computer's name and this process.
PublisherIdentity new_source();

inline constexpr std::uint32_t wire_format = 0x4D524702;  ///< "MRG" and the version of sample.idl

/// One frame with its source. Trivially copyable; counts and addresses beyond the frame's `words` are undefined.
struct Sample {
    std::uint32_t format = wire_format;
    PublisherIdentity source;
    std::int64_t period = 0;  ///< bus time between two frames, ticks of 0.1 ns
    std::int64_t pace = 0;    ///< real time between two frames, ticks of 0.1 ns
    Frame frame;
    std::uint32_t check = 0;
};

inline constexpr Duration shortest_period = microseconds(1);
inline constexpr Duration max_period = whole_seconds(60);  ///< limit of period and pace

std::uint32_t check_of(const Sample& sample);

/// Checks a bus name: letters, digits, '_' and '-', 1 to 64 of them. Errors: invalid_input.
Result<void> check_bus_name(std::string_view name);
/// Checks a DDS domain: 0 to 232. Errors: invalid_input.
Result<void> check_domain(int domain);

}  // namespace motionrack::dds
