// Wire changes reported by a card and its twin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <tuple>
#include <utility>
#include <vector>

namespace motionrack::oracle {

struct Change {
    std::int64_t at = 0;
    int wire = 0;
    std::int64_t level = 0;
    friend bool operator==(const Change&, const Change&) = default;
    friend void PrintTo(const Change& change, std::ostream* out) {
        *out << "wire " << change.wire << " = " << change.level << " at " << change.at;
    }
};

/// Returns the last level of each wire at each instant if it differs from the previous level, ordered by instant, then
/// wire. `raw`: in order of time for each wire; `levels`: initial levels of all wires.
inline std::vector<Change> settled(std::vector<Change> raw, std::vector<std::int64_t> levels) {
    const auto place = [](const Change& change) { return std::tie(change.at, change.wire); };
    std::stable_sort(raw.begin(), raw.end(), [&](const Change& a, const Change& b) { return place(a) < place(b); });
    std::vector<Change> out;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (i + 1 < raw.size() && place(raw[i + 1]) == place(raw[i])) continue;
        std::int64_t& level = levels[static_cast<std::size_t>(raw[i].wire)];
        if (std::exchange(level, raw[i].level) != raw[i].level) out.push_back(raw[i]);
    }
    return out;
}

}  // namespace motionrack::oracle
