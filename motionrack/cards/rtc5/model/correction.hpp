// Correction of the field: .ct5 files (read, checked, written), what the card interpolates from them, and tables made
// from a lens.
//
//     0    16 x int32   header: [1] bits/mm, [8] number of the file, [11] inverse planes valid, [12] calibration in
//     1/1000 degree ..
//    64    257 x 257 x int32   X out, offset binary; row = Y of the grid, column = X, step 4096 bits from -524288
//    +264196   Y out
//    +528392   inverse X, as difference to the grid, + 524288
//    +792588   inverse Y
//   last 4     CRC-32 without the last inversion; files of older programs have another sum, which is not known
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

/// What a .ct5 file says.
struct CorrectionFile {
    std::array<std::int32_t, 16> header{};
    std::vector<std::int32_t> x, y;                  ///< grid_nodes each, offset binary
    std::vector<std::int32_t> inverse_x, inverse_y;  ///< differences, offset binary
    bool checksum_known = true;                      ///< false: an older program's file, whose sum cannot be checked
    std::string note;                                ///< what its user should know of it, in a sentence; "": nothing

    double bits_per_mm() const { return header[1]; }
};

/// Refuses (the sentence says what was found and what is needed) another length, a node outside 0 .. 1048575 or far off
/// its neighbours, a table that cannot be inverted, an unreasonable header (K of 0 too, but in the maker's 1:1 table),
/// and a sum that does not fit. Files of programs before version 4.0 have a sum that is not known: their note says that
/// it was not checked, but where a single damage makes a file look so old, it is refused.
Result<CorrectionFile> read_ct5(std::span<const std::uint8_t> bytes, const std::string& name);
std::vector<std::uint8_t> written_ct5(const CorrectionFile& file);

/// The table of a lens: X and Y out put the spot at grid / K mm, the inverse planes tell where the spot is. Places that
/// the mirrors cannot reach are at the edge. Refused if check(lens) is not content.
Result<CorrectionFile> correction_of(const sim::ScanLens& lens, std::int32_t number = 0);
/// Output = input, in the last cell too: its end is a bit above what a file can hold, where it is cut.
CorrectionFile one_to_one();

/// What the card looks up: both coordinates of a node side by side, signed.
struct Table {
    struct Node {
        float x, y;  ///< 20-bit whole numbers, which a float holds exactly
    };
    std::array<Node, grid_nodes> nodes;
    std::array<std::int32_t, 16> header{};  ///< of the file
    std::string note;                       ///< of the file
};
std::shared_ptr<const Table> table_of(const CorrectionFile& file);
/// Where the inverse planes put an output, bilinear; for showing where the spot is.
sim::Spot uncorrected(const CorrectionFile& file, sim::Spot bits);

}  // namespace motionrack::rtc5
