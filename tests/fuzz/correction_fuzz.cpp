// libFuzzer: any bytes patched over a complete correction file of an RTC5. It is rejected with a sentence or accepted.
// Accepted numbers are in range and are written back with the same bytes. At a node, a card outputs the value in the
// file.
//
//  input: choice (1 byte), then patches: index of a word (3 bytes), its value (4 bytes); remaining bytes are appended
//  choice 1: over the file of a lens   2: with a correct checksum   4: words of the planes only   8: truncated there
//  16: written back, which is slow: a file has a megabyte
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::rtc5;
using fuzz::require;

using Bytes = std::vector<std::uint8_t>;
constexpr std::size_t header_words = 16, words = (ct5_bytes - 4) / 4;
constexpr std::int32_t max_node = 1048575, max_gap = 65536;

const Bytes& whole_file(bool of_lens) {
    static const Bytes plain = [] {
        CorrectionFile file = one_to_one();
        file.header[1] = 5184;
        return written_ct5(file);
    }();
    static const Bytes lens = written_ct5(*correction_of({{255.059, -1.365, 1.493, -18.087}, 11.7, 5184}, 721));
    return of_lens ? lens : plain;
}

std::uint32_t word_of(std::span<const std::uint8_t> bytes, std::size_t size) {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < size; ++i) out |= std::uint32_t{bytes[i]} << (8 * i);
    return out;
}

/// Returns the same words with a correct checksum.
Bytes with_sum(std::span<const std::uint8_t> bytes) {
    const auto word = [&](std::size_t i) { return static_cast<std::int32_t>(word_of(bytes.subspan(4 * i), 4)); };
    CorrectionFile file;
    for (std::size_t i = 0; i < header_words; ++i) file.header[i] = word(i);
    std::size_t next = header_words;
    for (auto* nodes : {&file.x, &file.y, &file.inverse_x, &file.inverse_y})
        for (std::size_t i = 0; i < grid_nodes; ++i) nodes->push_back(word(next++));
    return written_ct5(file);
}

Bytes file_of(std::span<const std::uint8_t> input) {
    const std::uint8_t choice = input.empty() ? 0 : input[0];
    Bytes out = whole_file((choice & 1) != 0);
    std::size_t last = 0;
    for (input = input.subspan(input.empty() ? 0 : 1); input.size() >= 7; input = input.subspan(7)) {
        const std::size_t first = (choice & 4) != 0 ? header_words : 0;
        last = 4 * (first + word_of(input, 3) % (words - first));
        std::copy_n(input.begin() + 3, 4, out.begin() + static_cast<std::ptrdiff_t>(last));
    }
    if ((choice & 2) != 0) out = with_sum(out);
    if ((choice & 8) != 0) out.resize(last);
    out.insert(out.end(), input.begin(), input.end());
    return out;
}

void check_plane(const std::vector<std::int32_t>& nodes) {
    require(nodes.size() == grid_nodes, "a plane has all its nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        require(nodes[i] >= 0 && nodes[i] <= max_node, "a node is in the field", std::to_string(nodes[i]));
        require(i % grid_side == 0 || std::abs(nodes[i] - nodes[i - 1]) <= max_gap, "neighbours are near");
        require(i < grid_side || std::abs(nodes[i] - nodes[i - grid_side]) <= max_gap, "rows are near");
    }
}

void check_written(const CorrectionFile& file, const Bytes& bytes) {
    const Bytes written = written_ct5(file);
    require(written.size() == bytes.size(), "a file that is written is as long as it was");
    require(std::equal(written.begin(), written.end() - 4, bytes.begin()), "a file is written as the same bytes");
    const bool has_sum = std::equal(written.end() - 4, written.end(), bytes.end() - 4);
    require(has_sum == file.checksum_known, "the sum of a file is known where it is right");
    require(has_sum || file.header[10] % 1000 < 400, "a wrong sum is one of an older program's");
}

/// Checks nodes selected by the last bytes of the input.
void check_card(const CorrectionFile& file, std::span<const std::uint8_t> input) {
    static const Settings settings{16, 4, 4};
    Engine card(settings);
    require(card.parts().heads.load_table(table_of(file), 1).has_value() &&
                card.parts().heads.select_tables(1, 0).has_value(),
            "a card takes a file that was read");
    card.parts().path.set_jump_speed(800'000);
    for (std::size_t i = 0; i < 4 && input.size() >= 2; ++i, input = input.first(input.size() - 2)) {
        const std::size_t column = input[input.size() - 1], row = input[input.size() - 2];
        const std::size_t node = row * grid_side + column;
        const double x = static_cast<double>(column) * grid_step - grid_zero,
                     y = static_cast<double>(row) * grid_step - grid_zero;
        require(card.goto_xy(x, y).has_value() && card.run_to_rest(1'000'000), "a card goes to a node");
        require(card.output().a[0] == file.x[node] - 524288 && card.output().a[1] == file.y[node] - 524288,
                "at a node a card puts out what the file says",
                fmt::format("column {}, row {}: {}, {} instead of {}, {}", column, row, card.output().a[0],
                            card.output().a[1], file.x[node] - 524288, file.y[node] - 524288));
        const sim::Spot spot = uncorrected(file, {x, y});
        require(spot.x == x + (file.inverse_x[node] - grid_zero) && spot.y == y + (file.inverse_y[node] - grid_zero),
                "at a node the spot is where the inverse planes say");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes = file_of({data, size});
    const auto file = read_ct5(bytes, "fuzz.ct5");
    if (!file) {
        require(file.error().message.find("fuzz.ct5") == 0 &&
                    file.error().message.find("The file was not loaded") != std::string::npos,
                "a refusal names the file and says what was not done", file.error().text());
        return 0;
    }
    require(file->header[1] >= 0 && file->header[1] <= 1'000'000, "bits/mm are in their range");
    require(file->header[12] >= 0 && file->header[12] <= 90'000, "the calibration is in its range");
    check_plane(file->x);
    check_plane(file->y);
    if (size > 0 && (data[0] & 16) != 0) check_written(*file, bytes);
    check_card(*file, {data, size});
    return 0;
}
