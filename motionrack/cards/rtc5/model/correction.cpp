// Reads, checks and writes .ct5 files, and makes tables from lens data.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/cards/rtc5/model/ct5_checksum.hpp>
#include <string_view>
#include <utility>

namespace motionrack::rtc5 {

namespace {

constexpr std::size_t planes_at = 64, plane_bytes = std::size_t{grid_nodes} * 4;
constexpr std::int32_t max_node = 1048575;
constexpr std::int32_t max_gap = 65536;  // between neighbours: 16 grid steps

std::int32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 4; i-- > 0;) out = out << 8 | bytes[at + i];
    return static_cast<std::int32_t>(out);
}

void append(std::vector<std::uint8_t>& out, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(word >> 8 * i));
}

std::vector<std::int32_t> plane(std::span<const std::uint8_t> bytes, std::size_t number) {
    std::vector<std::int32_t> out(grid_nodes);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = word_at(bytes, planes_at + number * plane_bytes + 4 * i);
    return out;
}

/// Returns the index of the first node that is out of range or far from the previous one; -1: none.
int strange_node(const std::vector<std::int32_t>& nodes) {
    for (int i = 0; i < grid_nodes; ++i) {
        const std::int32_t node = nodes[static_cast<std::size_t>(i)];
        if (node < 0 || node > max_node) return i;
        if (i % grid_side > 0 && std::abs(node - nodes[static_cast<std::size_t>(i - 1)]) > max_gap) return i;
        if (i >= grid_side && std::abs(node - nodes[static_cast<std::size_t>(i - grid_side)]) > max_gap) return i;
    }
    return -1;
}

tl::unexpected<Error> refusal(const std::string& name, std::string_view why) {
    return fail(ErrorKind::invalid_input, fmt::format("{}: {}. The file was not loaded", name, why));
}

bool is_one_to_one(const CorrectionFile& file) {
    for (std::size_t i = 0; i < grid_nodes; ++i) {
        const auto column = static_cast<std::int32_t>(i % grid_side), row = static_cast<std::int32_t>(i / grid_side);
        if (file.x[i] != std::min(column * 4096, max_node) || file.y[i] != std::min(row * 4096, max_node)) return false;
    }
    return true;
}

/// Checks the header. K = 0 bits/mm is valid only in the maker's 1:1 table, which is older than the known checksum.
Result<void> check_header(const CorrectionFile& file, const std::string& name) {
    if (file.header[1] < 0 || file.header[1] > 1'000'000)
        return refusal(name, fmt::format("{} bits/mm in its header; it must be 1 to 1000000", file.header[1]));
    if (file.header[1] == 0 && (file.checksum_known || !is_one_to_one(file)))
        return refusal(name, "0 bits/mm in its header, so the size of the field is unknown; it must be 1 to 1000000");
    if (file.header[12] < 0 || file.header[12] > 90'000)
        return refusal(name,
                       fmt::format("an angle calibration of {} 1/1000 degrees in its header; it must be 0 to 90000",
                                   file.header[12]));
    return {};
}

/// Verifies the checksum. Refuses a wrong one; adds a note to a file of an older program, whose checksum is unknown.
Result<void> check_sum(CorrectionFile& file, std::span<const std::uint8_t> bytes, const std::string& name) {
    const std::uint32_t sum = ct5_checksum(bytes.first(ct5_bytes - 4)),
                        said = static_cast<std::uint32_t>(word_at(bytes, ct5_bytes - 4));
    file.checksum_known = sum == said;
    if (file.checksum_known) return {};
    if (file.header[program_word] % 1000 >= first_summed)
        return refusal(name,
                       fmt::format("its checksum is {:08X}h, its contents give {:08X}h: it is damaged", said, sum));
    if (const std::string damage = damage_of_summed_file(bytes); !damage.empty())
        return refusal(name, damage + ": it is damaged");
    file.note = fmt::format("{} is from an older program, whose checksum is unknown; it was not checked.", name);
    return {};
}

/// Returns the orientation of the cell's image, equal at all its corners: 1 or -1; 0: the image is flat or folded.
int sense_of_cell(const CorrectionFile& file, std::size_t corner) {
    const auto edge = [&](std::size_t from, std::size_t to) {
        return std::pair(std::int64_t{file.x[to]} - file.x[from], std::int64_t{file.y[to]} - file.y[from]);
    };
    const std::size_t right = corner + 1, above = corner + grid_side, far = above + 1;
    const std::pair low = edge(corner, right), high = edge(above, far);
    int left_turns = 0, right_turns = 0;
    for (const auto& along : {low, high})
        for (const auto& across : {edge(corner, above), edge(right, far)}) {
            const std::int64_t turn = along.first * across.second - along.second * across.first;
            left_turns += turn > 0, right_turns += turn < 0;
        }
    return left_turns == 4 ? 1 : right_turns == 4 ? -1 : 0;
}

/// Returns the corner of the first cell whose orientation differs from the cells before it, or -1. Skips cells that
/// the table puts at the edge, because the mirrors do not reach them; returns 0 if all cells are there.
int folded_cell(const CorrectionFile& file) {
    const auto at_edge = [&](std::size_t node) {
        const auto is_end = [](std::int32_t v) { return v <= 0 || v >= max_node; };
        return is_end(file.x[node]) || is_end(file.y[node]);
    };
    int sense = 0;
    for (std::size_t i = 0; i + grid_side + 1 < grid_nodes; ++i) {
        if (i % grid_side == grid_side - 1 || at_edge(i) || at_edge(i + 1) || at_edge(i + grid_side) ||
            at_edge(i + grid_side + 1))
            continue;
        const int here = sense_of_cell(file, i);
        if (here == 0 || (sense != 0 && here != sense)) return static_cast<int>(i);
        sense = here;
    }
    return sense == 0 ? 0 : -1;
}

std::int32_t binary(double bits) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(bits + grid_zero + 0.5), 0.0, static_cast<double>(max_node)));
}

/// Interpolates a plane of the table bilinearly at (x, y) bits.
double between(const std::vector<std::int32_t>& nodes, double x, double y) {
    const double u = std::clamp((x + grid_zero) / grid_step, 0.0, 255.999999),
                 v = std::clamp((y + grid_zero) / grid_step, 0.0, 255.999999);
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const auto at = [&](int c, int r) {
        return static_cast<double>(nodes[static_cast<std::size_t>(r) * grid_side + static_cast<std::size_t>(c)]);
    };
    const double fx = u - column, fy = v - row;
    const double low = at(column, row) + (at(column + 1, row) - at(column, row)) * fx;
    const double high = at(column, row + 1) + (at(column + 1, row + 1) - at(column, row + 1)) * fx;
    return low + (high - low) * fy;
}

CorrectionFile empty_file() {
    CorrectionFile out;
    for (auto* nodes : {&out.x, &out.y, &out.inverse_x, &out.inverse_y}) nodes->resize(grid_nodes);
    return out;
}

}  // namespace

Result<CorrectionFile> read_ct5(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (bytes.size() != ct5_bytes)
        return refusal(name,
                       fmt::format("it has {} bytes; a correction file of an RTC5 has {}", bytes.size(), ct5_bytes));
    CorrectionFile out;
    for (std::size_t i = 0; i < 16; ++i) out.header[i] = word_at(bytes, 4 * i);
    out.x = plane(bytes, 0), out.y = plane(bytes, 1), out.inverse_x = plane(bytes, 2), out.inverse_y = plane(bytes, 3);
    for (const auto& [nodes, which] : {std::pair{&out.x, "X"}, std::pair{&out.y, "Y"}})
        if (const int node = strange_node(*nodes); node >= 0)
            return refusal(
                name,
                fmt::format(
                    "its {} value at column {}, row {} is {}, out of 0 to {} or further than {} from its neighbour",
                    which, node % grid_side, node / grid_side, (*nodes)[static_cast<std::size_t>(node)], max_node,
                    max_gap));
    MOTIONRACK_CHECK(check_sum(out, bytes, name));
    MOTIONRACK_CHECK(check_header(out, name));
    if (const int cell = folded_cell(out); cell >= 0)
        return refusal(
            name,
            fmt::format("its table cannot be inverted: between columns {} and {}, rows {} and {} it is flat or folded",
                        cell % grid_side, cell % grid_side + 1, cell / grid_side, cell / grid_side + 1));
    return out;
}

std::vector<std::uint8_t> written_ct5(const CorrectionFile& file) {
    std::vector<std::uint8_t> out;
    out.reserve(ct5_bytes);
    for (const std::int32_t word : file.header) append(out, static_cast<std::uint32_t>(word));
    for (const auto* nodes : {&file.x, &file.y})
        for (const std::int32_t node : *nodes) append(out, static_cast<std::uint32_t>(std::min(node, max_node)));
    for (const auto* nodes : {&file.inverse_x, &file.inverse_y})
        for (const std::int32_t node : *nodes) append(out, static_cast<std::uint32_t>(node));
    append(out, ct5_checksum(out));
    return out;
}

Result<CorrectionFile> correction_of(const sim::ScanLens& lens, std::int32_t number) {
    MOTIONRACK_CHECK(sim::check(lens));
    CorrectionFile out = empty_file();
    out.header[1] = static_cast<std::int32_t>(lens.bits_per_mm);
    out.header[2] = static_cast<std::int32_t>(20 * lens.f_mm[0]);
    out.header[8] = number;
    out.header[9] = 10;
    out.header[10] = 403;
    out.header[11] = 1;
    out.header[12] = static_cast<std::int32_t>(lens.calibration_deg * 1000 + 0.5);
    for (std::size_t i = 0; i < grid_nodes; ++i) {
        const std::size_t column = i % grid_side, row = i / grid_side;
        const double x = static_cast<double>(column) * grid_step - grid_zero,
                     y = static_cast<double>(row) * grid_step - grid_zero;
        const sim::Spot bits = sim::bits_for(lens, {x / lens.bits_per_mm, y / lens.bits_per_mm});
        out.x[i] = binary(bits.x), out.y[i] = binary(bits.y);
        const sim::Spot spot = sim::spot_of(lens, {x, y});
        out.inverse_x[i] = static_cast<std::int32_t>(std::floor(spot.x * lens.bits_per_mm - x + grid_zero + 0.5));
        out.inverse_y[i] = static_cast<std::int32_t>(std::floor(spot.y * lens.bits_per_mm - y + grid_zero + 0.5));
    }
    return out;
}

CorrectionFile one_to_one() {
    CorrectionFile out = empty_file();
    out.header[10] = 403;
    for (std::size_t i = 0; i < grid_nodes; ++i) {
        out.x[i] = static_cast<std::int32_t>(i % grid_side) * 4096;
        out.y[i] = static_cast<std::int32_t>(i / grid_side) * 4096;
        out.inverse_x[i] = out.inverse_y[i] = static_cast<std::int32_t>(grid_zero);
    }
    return out;
}

std::shared_ptr<const Table> table_of(const CorrectionFile& file) {
    auto out = std::make_shared<Table>();
    for (std::size_t i = 0; i < grid_nodes; ++i)
        out->nodes[i] = {static_cast<float>(file.x[i] - 524288), static_cast<float>(file.y[i] - 524288)};
    out->header = file.header;
    out->note = file.note;
    return out;
}

sim::Spot uncorrected(const CorrectionFile& file, sim::Spot bits) {
    return {bits.x + (between(file.inverse_x, bits.x, bits.y) - grid_zero),
            bits.y + (between(file.inverse_y, bits.x, bits.y) - grid_zero)};
}

}  // namespace motionrack::rtc5
