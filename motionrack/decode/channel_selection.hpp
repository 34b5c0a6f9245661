// Selection of the lines of a capture that are the encoders' A, B and Z.
#pragma once

#include <motionrack/decode/capture.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::decode {

/// An encoder: numbers of signals in the capture's list.
struct ChannelSelection {
    std::string name;
    std::size_t a = 0;
    std::size_t b = 0;
    std::optional<std::size_t> z;
};

/// `texts`: "X=a,b" or "X=a,b,z", each line by its name, by the end of its name ("enc_a" for "top.X.enc_a"), or by its
/// number in the list of signals (for raw files the bit). Without texts: signals named X.enc_a, X.enc_b (X_enc_a ..),
/// or else X.a, X.b, with their z. Errors: invalid_input, with the available names.
Result<std::vector<ChannelSelection>> choose_channels(const std::vector<std::string>& signals,
                                                      const std::vector<std::string>& texts);

}  // namespace motionrack::decode
