// An open rack over the C interface, with short names for frequent test operations.
#pragma once

#include <gtest/gtest.h>
#include <motionrack/c.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace motionrack::c_test {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
inline constexpr const char* one_card = "card.c1 = \"mcx314\"";
inline constexpr const char* with_switches = R"(
[card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
initial_position_mm = 10
max_jerk_mm_s3 = 0
[axis.X.switches]
limit_minus_mm = -1
limit_plus_mm = 30
[axis.A]
card = "c1"
channel = "u"
encoder_counts_per_rev = 0
)";
inline constexpr const char* homing_rack = R"(
[card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
initial_position_mm = 5
max_limit_mm = 300
[axis.X.switches]
home_mm = 1
limit_minus_mm = -1
limit_plus_mm = 301
[axis.Y]
card = "c1"
channel = "y"
max_limit_mm = 200
)";

class World {
  public:
    explicit World(const char* text = one_card) { EXPECT_EQ(mr_rack_open(text, &rack), MR_OK) << mr_last_error(); }
    explicit World(mr_rack* of) { EXPECT_EQ(mr_snapshot(of, &rack), MR_OK) << mr_last_error(); }
    ~World() { mr_rack_close(rack); }
    World(const World&) = delete;
    World& operator=(const World&) = delete;
    operator mr_rack*() const { return rack; }

    void write(std::uint32_t offset, unsigned value) {
        EXPECT_EQ(mr_write16(rack, "c1", offset, static_cast<std::uint16_t>(value)), MR_OK) << mr_last_error();
    }
    /// Sends command `code` with its data to the axes in `axes` (bit 0: X).
    void command(unsigned axes, unsigned code, std::uint32_t value = 0) {
        write(0x0E, value >> 16);
        write(0x0C, value & 0xFFFF);
        write(0x00, axes << 8 | code);
    }
    void set_up(unsigned axes, unsigned speed) {
        command(axes, 0x00, 800'000);
        command(axes, 0x02, 400);
        command(axes, 0x04, 10);
        command(axes, 0x05, speed);
    }
    void pass(std::uint64_t ns) { EXPECT_EQ(mr_advance_ns(rack, ns), MR_OK) << mr_last_error(); }
    double wire(const char* name) {
        double value = nan_value;
        EXPECT_EQ(mr_wire_get(rack, name, &value), MR_OK) << mr_last_error();
        return value;
    }
    void set(const char* name, double value) { EXPECT_EQ(mr_wire_set(rack, name, value), MR_OK) << mr_last_error(); }
    double part(const char* name) {
        double value = nan_value;
        EXPECT_EQ(mr_part_get(rack, name, &value), MR_OK) << mr_last_error();
        return value;
    }
    std::int64_t peek(const char* name) {
        std::uint64_t value = 0;
        EXPECT_EQ(mr_peek(rack, "c1", name, &value), MR_OK) << mr_last_error();
        return static_cast<std::int64_t>(value);
    }
    std::uint64_t hash() { return mr_state_hash(rack); }

    mr_rack* rack = nullptr;
};

/// Runs a program to its end and checks that the result is `expected`.
inline mr_run_result run(mr_rack* rack, const std::string& program, int expected = MR_OK,
                         const mr_run_options* options = nullptr) {
    mr_run_result result{-1, -1, -1, -1, -1, -1, nullptr};
    EXPECT_EQ(mr_run_program(rack, program.c_str(), options, &result), expected) << mr_last_error();
    return result;
}

// ---- files

inline std::string temporary(const std::string& name) {
    return (std::filesystem::temp_directory_path() / ("motionrack_c_" + std::to_string(::getpid()) + "_" + name))
        .string();
}

inline std::string text_of_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline int count_of(const std::string& text, const std::string& what) {
    int out = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
    return out;
}

}  // namespace motionrack::c_test
