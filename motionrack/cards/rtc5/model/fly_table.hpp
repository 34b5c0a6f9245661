// The 2D compensation of encoder positions: what to add to both counts, from a text file.
//
//     [Fly2DTable1]          section by its number; only the first of a number counts
//     ; Enc0  Enc1  dEnc0  dEnc1
//     0       0     0      0
//     1000    0     12     -3
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rtc5 {

class FlyTable {
  public:
    /// Reads section `number`. Refused with line and reason: no such section, a line over 255 characters or without
    /// four whole numbers, points that are no full grid, fewer than 2 by 2 of them. A point given twice has the last
    /// values.
    static Result<FlyTable> read(std::string_view text, unsigned number, const std::string& file);

    struct Shift {
        double x = 0, y = 0;
    };
    /// Bilinear; beyond the grid as at its edge.
    Shift at(double encoder0, double encoder1) const;

  private:
    std::vector<double> columns_, rows_;
    std::vector<Shift> shifts_;  // row by row
};

}  // namespace motionrack::rtc5
