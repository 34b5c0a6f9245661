// Test cases: every fault of the catalogue at each of its operating points.
#pragma once

#include <cctype>
#include <ostream>
#include <stdexcept>
#include <string>
#include <tests/fault/catalogue.hpp>
#include <tests/source_root.hpp>
#include <vector>

namespace motionrack::faults {

inline const std::vector<Group>& catalogue() {
    static const std::vector<Group> groups = [] {
        auto read = read_catalogue(source_dir() + "/tests/fault/catalogue.toml");
        if (!read) throw std::runtime_error(read.error().text());
        return *read;
    }();
    return groups;
}

struct Case {
    std::string group;
    Fault fault;
    Point point;
    std::string text(const std::string& pattern) const { return Fault::at_point(pattern, point); }
    /// Test name, "motor_stall_slow": letters, digits and single underscores.
    std::string name() const {
        std::string out;
        for (const char c : group + "_" + fault.name + "_" + point.name) {
            if (std::isalnum(static_cast<unsigned char>(c)))
                out += c;
            else if (!out.empty() && out.back() != '_')
                out += '_';
        }
        return out;
    }
};

inline std::ostream& operator<<(std::ostream& out, const Case& one) {
    return out << one.name();
}

inline std::vector<Case> all_cases() {
    std::vector<Case> out;
    for (const Group& group : catalogue())
        for (const Fault& fault : group.faults)
            for (const Point& point : fault.setup.points) out.push_back({group.name, fault, point});
    return out;
}

}  // namespace motionrack::faults
