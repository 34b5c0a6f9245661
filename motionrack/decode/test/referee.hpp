// Reference implementation of the decoder: a loop over samples with a table of 16 transitions; and random streams of
// lines.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/decode/channel.hpp>
#include <random>
#include <vector>

namespace motionrack::decode {

struct Referee {
    std::int64_t count = 0;
    std::uint64_t up = 0, down = 0, samples = 0;
    std::vector<std::uint64_t> illegal;
    std::vector<IndexEvent> indexes;

    /// Decodes one sample; bit numbers as in LineBits.
    void sample(std::uint8_t byte, const LineBits& lines) {
        // Rows: lines before; columns: lines (B A) now; 2 is illegal.
        static constexpr std::array<int, 16> table = {0, 1, -1, 2, -1, 0, 2, 1, 1, 2, 0, -1, 2, -1, 1, 0};
        const int now = (byte >> lines.a & 1) | (byte >> lines.b & 1) << 1, z = lines.z < 0 ? 0 : byte >> lines.z & 1;
        if (samples == 0) before_ = now, before_z_ = z;
        const int step = table[static_cast<std::size_t>(before_ << 2 | now)];
        if (step == 2)
            illegal.push_back(samples);
        else
            count += step, up += step == 1, down += step == -1;
        if (z > before_z_) indexes.push_back({samples, count});
        before_ = now, before_z_ = z;
        ++samples;
    }

  private:
    int before_ = 0, before_z_ = 0;
};

/// Returns `size` bytes of encoder lines that reverse, stop and jump, each channel independently.
inline std::vector<std::uint8_t> random_lines(std::uint64_t seed, std::size_t size) {
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> out(size);
    const unsigned kind = random() % 4;
    std::array<unsigned, 4> phase{};
    for (std::uint8_t& byte : out) {
        if (kind == 0) {
            byte = static_cast<std::uint8_t>(random());
            continue;
        }
        byte = 0;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto luck = random() % 64;
            if (luck < 20 * kind) phase[channel] += luck % 8 == 0 ? 3 : 1;
            if (luck == 63) phase[channel] += 2;  // a fault: both lines change at once
            const unsigned turn = phase[channel] & 3U, gray = turn ^ turn >> 1;
            byte = static_cast<std::uint8_t>(byte | gray << (2 * channel));
        }
    }
    return out;
}

}  // namespace motionrack::decode
