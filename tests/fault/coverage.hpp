// What can go wrong with a machine, and what tries each of it: coverage.toml, read for its test and for its page.
#pragma once

#include <filesystem>
#include <motionrack/base/result.hpp>
#include <string>
#include <tests/fault/catalogue.hpp>
#include <vector>

namespace motionrack::faults {

/// A fault that can happen, whether anything of a rack can have it or not.
struct CoveredFault {
    std::string id;  ///< "E01"
    std::string about;
    std::vector<std::string> rows;   ///< of the catalogue: "group: fault"
    std::vector<std::string> tests;  ///< others: "Suite.Name", "hmi: title"
    std::string reason;              ///< why it cannot happen, or is less than the fault
    std::string missing;             ///< what nothing tries yet
};

struct CoverageSection {
    std::string name;
    std::vector<CoveredFault> faults;
};

/// Errors: invalid_input with line and column, of the first thing that is wrong; io.
Result<std::vector<CoverageSection>> read_coverage(const std::filesystem::path& file);

/// The page of reference, with the operating points of the rows of `catalogue`.
std::string coverage_page(const std::vector<CoverageSection>& sections, const std::vector<Group>& catalogue);

}  // namespace motionrack::faults
