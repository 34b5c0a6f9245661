// Possible faults of a machine and their tests, read from coverage.toml for a test and for the page.
#pragma once

#include <filesystem>
#include <motionrack/base/result.hpp>
#include <string>
#include <tests/fault/catalogue.hpp>
#include <vector>

namespace motionrack::faults {

/// A possible fault, whether or not the rack can simulate it.
struct CoveredFault {
    std::string id;  ///< "E01"
    std::string about;
    std::vector<std::string> rows;   ///< rows of the catalogue: "group: fault"
    std::vector<std::string> tests;  ///< other tests: "Suite.Name", "hmi: title"
    std::string reason;              ///< reason why it cannot occur or is only partly simulated
    std::string missing;             ///< the part that is not tested yet
};

struct CoverageSection {
    std::string name;
    std::vector<CoveredFault> faults;
};

/// Errors: invalid_input with line and column of the first error; io.
Result<std::vector<CoverageSection>> read_coverage(const std::filesystem::path& file);

/// Returns the reference page, with the operating points from `catalogue`.
std::string coverage_page(const std::vector<CoverageSection>& sections, const std::vector<Group>& catalogue);

}  // namespace motionrack::faults
