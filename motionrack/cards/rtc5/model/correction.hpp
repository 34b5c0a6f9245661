// Correction of the field: .ct5 files (read, checked, written), the card's interpolation table, and tables made from a
// lens.
//
//     0    16 x int32   header: [1] bits/mm, [8] number of the file, [11] inverse planes valid, [12] calibration in
//     1/1000 degree ..
//    64    257 x 257 x int32   X out, offset binary; row = Y of the grid, column = X, step 4096 bits from -524288
//    +264196   Y out
//    +528392   inverse X, as difference to the grid, + 524288
//    +792588   inverse Y
//   last 4     CRC-32 without the final inversion; files of older programs have another, unknown checksum
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>
#include <span>
#include <string>
#include <vector>

namespace motionrack::rtc5 {

inline constexpr int grid_side = 257, grid_nodes = grid_side * grid_side;
inline constexpr double grid_step = 4096, grid_zero = 524288;
inline constexpr std::size_t ct5_bytes = 64 + std::size_t{4} * grid_nodes * 4 + 4;

/// Content of a .ct5 file.
struct CorrectionFile {
    std::array<std::int32_t, 16> header{};
    std::vector<std::int32_t> x, y;                  ///< grid_nodes each, offset binary
    std::vector<std::int32_t> inverse_x, inverse_y;  ///< differences, offset binary
    bool checksum_known = true;  ///< false: written by an older program, whose checksum cannot be verified
    std::string note;            ///< note for the user, one sentence; "": none

    double bits_per_mm() const { return header[1]; }
};

/// Reads a .ct5 file. Errors: refused (the sentence has the found and the required value) for a wrong length, a node
/// outside 0 .. 1048575 or far from its neighbours, a table that cannot be inverted, an implausible header (also K = 0,
/// except in the maker's 1:1 table), and a wrong checksum. Programs before version 4.0 wrote an unknown checksum: the
/// note of such a file says that it was not verified. Refuses a file that looks that old only because of a single
/// damage.
Result<CorrectionFile> read_ct5(std::span<const std::uint8_t> bytes, const std::string& name);
std::vector<std::uint8_t> written_ct5(const CorrectionFile& file);

/// Makes the table of a lens: output X and Y put the spot at grid / K mm (K: bits per mm); the inverse planes map an
/// output to the spot's position. Positions that the mirrors cannot reach are set to the edge of the field.
/// Errors: refused if check(lens) fails.
Result<CorrectionFile> correction_of(const sim::ScanLens& lens, std::int32_t number = 0);
/// Makes the 1:1 table: output = input, also in the last cell. The end of that cell is slightly above the maximum of
/// a file, which clips it.
CorrectionFile one_to_one();

/// Interpolation table of the card: both coordinates of a node side by side, signed.
struct Table {
    struct GridNode {
        float x, y;  ///< 20-bit whole numbers, exact in a float
    };
    std::array<GridNode, grid_nodes> nodes;
    std::array<std::int32_t, 16> header{};  ///< header words of the .ct5 file
    std::string note;                       ///< CorrectionFile::note of the .ct5 file
};
std::shared_ptr<const Table> table_of(const CorrectionFile& file);
/// Returns the spot position of an output (bits), interpolated bilinearly in the inverse planes; for display.
sim::Spot uncorrected(const CorrectionFile& file, sim::Spot bits);

}  // namespace motionrack::rtc5
