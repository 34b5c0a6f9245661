// Waveforms of digital lines over a short time, in data sheet style.
//
//   clk    ___/~~~~~~~~~~~~~~~~         one bit: a line
//  state  <S0><S1><S2><S3 ><S4         several bits: one band per value, labelled if space permits
//              :       :                marks: dotted, named above
#pragma once

#include <cstdint>
#include <motionrack/trace/svg.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::trace {

struct SvgWave {
    std::string name;
    bool band = false;  ///< several bits: bands with values
    std::vector<std::pair<double, std::uint32_t>>
        changes;  ///< seconds in order, with the value from then on; the first at or before the start
    std::string (*text)(std::uint32_t value) = nullptr;  ///< band labels; nullptr: hexadecimal
    std::uint32_t rest = 0;                              ///< value of a band that is drawn pale: undriven
};

struct SvgMark {
    double at_s = 0;
    std::string name;
};

/// Requires `from_s` < `to_s`. The number of waves determines the height; style.height is not used.
std::string svg_waves(const std::string& title, const std::vector<SvgWave>& waves, const std::vector<SvgMark>& marks,
                      double from_s, double to_s, const SvgStyle& style = {});

}  // namespace motionrack::trace
