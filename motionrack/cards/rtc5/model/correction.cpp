// .ct5 files: reading with all checks, writing, and tables from lens data.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/correction.hpp>

namespace motionrack::rtc5 {

namespace {

constexpr std::size_t planes_at = 64, plane_bytes = std::size_t{grid_nodes} * 4;
constexpr std::int32_t greatest_node = 1048575;
constexpr std::int32_t greatest_gap = 65536;  // between neighbours: 16 steps of the grid

std::int32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 4; i-- > 0;) out = out << 8 | bytes[at + i];
    return static_cast<std::int32_t>(out);
}

void append(std::vector<std::uint8_t>& out, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(word >> 8 * i));
}

/// CRC-32 as zlib has it, but without the inversion at its end.
std::uint32_t sum_of(std::span<const std::uint8_t> bytes) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> out{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t c = i;
            for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ c >> 1 : c >> 1;
            out[i] = c;
        }
        return out;
    }();
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) crc = table[(crc ^ byte) & 0xFF] ^ crc >> 8;
    return crc;
}

std::vector<std::int32_t> plane(std::span<const std::uint8_t> bytes, std::size_t number) {
    std::vector<std::int32_t> out(grid_nodes);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = word_at(bytes, planes_at + number * plane_bytes + 4 * i);
    return out;
}

/// The first node that is out of range or far off the one before it, -1 if none is.
int strange_node(const std::vector<std::int32_t>& nodes) {
    for (int i = 0; i < grid_nodes; ++i) {
        const std::int32_t node = nodes[static_cast<std::size_t>(i)];
        if (node < 0 || node > greatest_node) return i;
        if (i % grid_side > 0 && std::abs(node - nodes[static_cast<std::size_t>(i - 1)]) > greatest_gap) return i;
        if (i >= grid_side && std::abs(node - nodes[static_cast<std::size_t>(i - grid_side)]) > greatest_gap) return i;
    }
    return -1;
}

Result<void> check_header(const CorrectionFile& file, const std::string& name) {
    if (file.header[1] < 0 || file.header[1] > 1'000'000)
        return fail(Trouble::bad_input,
                    fmt::format("{}: {} bits/mm in its header; 0 to 1000000 are possible. The file was not loaded",
                                name, file.header[1]));
    if (file.header[12] < 0 || file.header[12] > 90'000)
        return fail(Trouble::bad_input, fmt::format("{}: an angle calibration of {} 1/1000 degrees in its header; 0 to "
                                                    "90000 are possible. The file was not loaded",
                                                    name, file.header[12]));
    return {};
}

std::int32_t binary(double bits) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(bits + grid_zero + 0.5), 0.0, static_cast<double>(greatest_node)));
}

/// The value of a plane at (x, y) bits inside the field.
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
    const auto refuse = [&](const std::string& why) {
        return fail(Trouble::bad_input, fmt::format("{}: {}. The file was not loaded", name, why));
    };
    if (bytes.size() != ct5_bytes)
        return refuse(fmt::format("it has {} bytes; a correction file of an RTC5 has {}", bytes.size(), ct5_bytes));
    CorrectionFile out;
    for (std::size_t i = 0; i < 16; ++i) out.header[i] = word_at(bytes, 4 * i);
    MOTIONRACK_CHECK(check_header(out, name));
    out.x = plane(bytes, 0), out.y = plane(bytes, 1), out.inverse_x = plane(bytes, 2), out.inverse_y = plane(bytes, 3);
    for (const auto& [nodes, which] : {std::pair{&out.x, "X"}, std::pair{&out.y, "Y"}})
        if (const int node = strange_node(*nodes); node >= 0)
            return refuse(fmt::format(
                "its {} value at column {}, row {} is {}, out of 0 to {} or further than {} from its neighbour", which,
                node % grid_side, node / grid_side, (*nodes)[static_cast<std::size_t>(node)], greatest_node,
                greatest_gap));
    const std::uint32_t sum = sum_of(bytes.first(ct5_bytes - 4)),
                        said = static_cast<std::uint32_t>(word_at(bytes, ct5_bytes - 4));
    out.checksum_known = sum == said;
    if (!out.checksum_known && out.header[10] % 1000 >= 400)
        return refuse(fmt::format("its checksum is {:08X}h, its contents give {:08X}h: it is damaged", said, sum));
    return out;
}

std::vector<std::uint8_t> written_ct5(const CorrectionFile& file) {
    std::vector<std::uint8_t> out;
    out.reserve(ct5_bytes);
    for (const std::int32_t word : file.header) append(out, static_cast<std::uint32_t>(word));
    for (const auto* nodes : {&file.x, &file.y, &file.inverse_x, &file.inverse_y})
        for (const std::int32_t node : *nodes) append(out, static_cast<std::uint32_t>(node));
    append(out, sum_of(out));
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
        out.x[i] = std::min<std::int32_t>(static_cast<std::int32_t>(i % grid_side) * 4096, greatest_node);
        out.y[i] = std::min<std::int32_t>(static_cast<std::int32_t>(i / grid_side) * 4096, greatest_node);
        out.inverse_x[i] = out.inverse_y[i] = static_cast<std::int32_t>(grid_zero);
    }
    return out;
}

std::shared_ptr<const Table> table_of(const CorrectionFile& file) {
    auto out = std::make_shared<Table>();
    for (std::size_t i = 0; i < grid_nodes; ++i)
        out->nodes[i] = {static_cast<float>(file.x[i] - 524288), static_cast<float>(file.y[i] - 524288)};
    out->bits_per_mm = file.bits_per_mm();
    return out;
}

sim::Spot uncorrected(const CorrectionFile& file, sim::Spot bits) {
    return {bits.x + (between(file.inverse_x, bits.x, bits.y) - grid_zero),
            bits.y + (between(file.inverse_y, bits.x, bits.y) - grid_zero)};
}

}  // namespace motionrack::rtc5
