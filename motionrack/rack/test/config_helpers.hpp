// Shared helpers of the rack file reader's tests.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/config.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

inline std::string all_texts(const std::vector<Error>& errors) {
    std::string out;
    for (const Error& error : errors) out += error.text() + '\n';
    return out;
}

/// Returns a rack file with a card "m" and an axis on its first channel, then `more`.
inline std::string rack_with(const std::string& more, char axis = 'X') {
    return fmt::format("[card.m]\ntype = \"mcx314\"\n[axis.{}]\ncard = \"m\"\nchannel = \"x\"\n{}", axis, more);
}

inline RackConfig good(const std::string& text) {
    RackReading reading = read_rack_text(text);
    EXPECT_THAT(reading.errors, ::testing::IsEmpty()) << all_texts(reading.errors) << text;
    return reading.config.value_or(RackConfig{});
}

/// The rack of a valid file, started.
struct StartedRack : Rack {
    explicit StartedRack(const std::string& text) : Rack(good(text)) { start(); }
};

}  // namespace motionrack::rack
