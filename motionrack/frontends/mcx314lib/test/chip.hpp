// An open chip over the C library, with test observations.
#pragma once

#include <gtest/gtest.h>
#include <mcx314lib.h>

#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <tests/source_root.hpp>

namespace motionrack::mcx314lib_test {

inline constexpr int x = 1, y = 2, z = 4, u = 8, all = 15;
inline constexpr const char* one_card = "card.c1 = \"mcx314\"";

inline std::int64_t peek(const std::string& name) {
    std::int64_t value = 0;
    EXPECT_EQ(mcx314_peek(name.c_str(), &value), 0) << mcx314_last_error();
    return value;
}

class Open {
  public:
    explicit Open(const char* rack = one_card, const char* card = nullptr) : handle(mcx314_open(rack, card)) {
        EXPECT_GT(handle, 0) << mcx314_last_error();
        mcx314_clear_error();
    }
    ~Open() { mcx314_close(handle); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

    int handle;
};

/// Names of the functions declared in mcx314lib.h.
inline std::set<std::string> declared_functions() {
    std::ifstream file(source_dir() + "/motionrack/frontends/mcx314lib/mcx314lib.h");
    std::set<std::string> declared;
    const std::regex function(R"(^MCX314_API [^(]*\b(\w+)\()");
    std::smatch match;
    for (std::string line; std::getline(file, line);)
        if (std::regex_search(line, match, function)) declared.insert(match[1]);
    return declared;
}

inline LINEDATA line_of(int px, int py, int pz) {
    return {100, 4000, 400, 0, 500, {px, py, pz, 0}};
}
/// A quarter circle from (0, 0) around (1000, 0).
inline CIRCLEDATA quarter(bool clockwise) {
    return {100, 1000, 400, 0, {1000, clockwise ? 1000 : -1000, 0, 0}, {1000, 0, 0, 0}};
}

/// Sets speeds, in units of 10 pulses per second.
inline void set_up() {
    SetRange(800'000);
    SetSV(all, 100);
    SetV(all, 4000);
    SetA(all, 400);
}

}  // namespace motionrack::mcx314lib_test
