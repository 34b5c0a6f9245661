// A sample: one frame of a grating bus as a publisher sends it, with who sent it and how fast frames follow each other.
//
//   format | source id, host, process | period, pace | the frame: time, sequence, N, counts, addresses, CRC-32 | check
//
// The frame's CRC is the card's; `check` is the CRC-32 of all that stands before it but the counts and addresses, which
// the frame's CRC covers.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <string>
#include <string_view>

namespace motionrack::dds {

using grating_bus::Frame;

/// Who publishes. The id is drawn when the publisher starts and tells it from every other; host and process are for
/// people.
struct Source {
    std::array<std::uint8_t, 16> id{};
    std::array<char, 64> host{};  ///< printable, the rest 0
    std::uint32_t process = 0;

    std::string_view host_name() const;
    /// "host, process 123, id 0a1b2c3d4e5f6071..." with the whole id.
    std::string text() const;
    /// The id as 32 hexadecimal digits.
    std::string id_text() const;
    friend bool operator==(const Source& a, const Source& b) { return a.id == b.id; }
};

/// A source of its own: a random id, this computer's name and this process.
Source new_source();

inline constexpr std::uint32_t wire_format = 0x4D524702;  ///< "MRG" and the version of sample.idl

/// Trivially copyable; counts and addresses beyond the frame's `words` mean nothing.
struct Sample {
    std::uint32_t format = wire_format;
    Source source;
    std::int64_t period = 0;  ///< time of the bus between two frames, ticks of 0.1 ns
    std::int64_t pace = 0;    ///< real time between two frames, ticks of 0.1 ns
    Frame frame;
    std::uint32_t check = 0;
};

inline constexpr Duration shortest_period = microseconds(1);
inline constexpr Duration max_period = whole_seconds(60);  ///< of the bus and in real time

std::uint32_t check_of(const Sample& sample);

/// Bus names: letters, digits, '_' and '-', 1 to 64 of them. Errors: invalid_input.
Result<void> check_bus_name(std::string_view name);
/// DDS domains are 0 to 232. Errors: invalid_input.
Result<void> check_domain(int domain);

}  // namespace motionrack::dds
