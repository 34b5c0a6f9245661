// Reads VCD files with sigrok-cli, vcd2fst and the strict reader, and compares the edges they find.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <tests/strict_vcd.hpp>

namespace motionrack::test {

/// Returns the last number that a sigrok decoder reports; -1: none.
inline int last_number(const std::string& path, const std::string& decoder, const std::string& row) {
    const std::string command = "sigrok-cli -I vcd -i " + path + " -P " + decoder + " -A " + row + " 2>/dev/null";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return -1;
    int last = -1;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe)) {
        const std::string text = line.data();
        const std::size_t colon = text.find(": ");
        if (colon != std::string::npos) last = std::atoi(text.c_str() + colon + 2);
    }
    ::pclose(pipe);
    return last;
}

/// Returns the edges that sigrok's counter finds on a line; -1: it does not read the file.
inline int edges_by_sigrok(const std::string& path, const std::string& line) {
    return last_number(path, "counter:data=" + line + ":data_edge=rising", "counter=edge_count");
}

/// Expects that every reader reads the whole file and finds the same edges after its first instant. Returns the number
/// of lines that have some.
inline int expect_every_reader_reads(const std::string& path, const StrictVcd& vcd) {
    EXPECT_EQ(vcd.wrong, "");
    int compared = 0;
    for (const auto& [code, variable] : vcd.variables) {
        if (variable.is_real || variable.rises < 2) continue;
        EXPECT_EQ(edges_by_sigrok(path, variable.name.substr(variable.name.find('.') + 1)),
                  variable.rises - variable.rises_at_start)
            << variable.name;
        ++compared;
    }
    EXPECT_EQ(std::system(("vcd2fst " + path + " " + path + ".fst >/dev/null 2>&1").c_str()), 0);
    std::filesystem::remove(path + ".fst");
    return compared;
}

}  // namespace motionrack::test
