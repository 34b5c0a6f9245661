// The 2D compensation of encoder counts: offsets of both counts, read from a text file.
//
//     [Fly2DTable1]          section by its number; only the first section of a number is read
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
    /// Reads section `number`. Errors: refused with line and reason for a missing section, a line over 255 characters
    /// or without four whole numbers, points that do not form a full grid, or fewer than 2 by 2 points. For a repeated
    /// point the last values apply.
    static Result<FlyTable> read(std::string_view text, unsigned number, const std::string& file);

    struct Shift {
        double x = 0, y = 0;
    };
    /// Returns the offsets in counts at these encoder counts: bilinear in the grid, constant beyond its edge.
    Shift at(double encoder0, double encoder1) const;

  private:
    std::vector<double> columns_, rows_;
    std::vector<Shift> shifts_;  // row by row
};

}  // namespace motionrack::rtc5
