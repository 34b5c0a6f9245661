// Waves of digital lines over a short time as a picture, as data sheets draw them.
//
//   clk    ___/~~~~~~~~~~~~~~~~         one bit: a line
//   state  <S0><S1><S2><S3 ><S4         several: a band a value, with its name where there is room
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
        changes;  ///< seconds, in order, and the value from then on; the first at or before the begin
    std::string (*text)(std::uint32_t value) = nullptr;  ///< of a band; nullptr: hexadecimal
    std::uint32_t rest = 0;                              ///< the value of a band that is drawn pale: nobody drives it
};

struct SvgMark {
    double at_s = 0;
    std::string name;
};

/// `from_s` < `to_s`. The height of the picture follows from the number of waves; look.height is not used.
std::string svg_waves(const std::string& title, const std::vector<SvgWave>& waves, const std::vector<SvgMark>& marks,
                      double from_s, double to_s, const SvgLook& look = {});

}  // namespace motionrack::trace
