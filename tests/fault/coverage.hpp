// Possible faults of a machine and their tests, read from coverage.toml for a test and for the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <motionrack/base/result.hpp>
#include <set>
#include <string>
#include <tests/fault/catalogue.hpp>
#include <vector>

namespace motionrack::faults {

/// An operating point that a test of another place tries.
struct TestedPoint {
    std::string name, test;
};

/// Reasons why something is not tried: sentences that the page shows.
struct Reasons {
    std::string run;    ///< by a run, or another command
    std::string serve;  ///< in a served machine
};

/// A possible fault, whether or not the rack can simulate it.
struct CoveredFault {
    std::string id;  ///< "E01"
    std::string about;
    std::vector<std::string> rows;               ///< rows of the catalogue: "group: fault"
    std::vector<std::string> tests;              ///< other tests: "Suite.Name", "hmi: title"
    std::vector<TestedPoint> run_at, served_at;  ///< points of tests, by a run and in a served machine
    std::string reason;                          ///< reason why it cannot occur or is only partly simulated
    Reasons not_tried;                           ///< those of the section where the fault has none
    std::string missing;                         ///< the part that is not tested yet
};

struct CoverageSection {
    std::string name;
    Reasons not_tried;
    std::vector<CoveredFault> faults;
};

enum class Tried : std::uint8_t { alone, served };
/// Returns the points at which rows and tests try the fault, each once.
std::set<std::string> points_of(const CoveredFault& fault, const std::vector<Group>& catalogue, Tried how);

/// Errors: invalid_input with line and column of the first error; io.
Result<std::vector<CoverageSection>> read_coverage(const std::filesystem::path& file);

/// Returns the reference page, with the operating points from `catalogue`.
std::string coverage_page(const std::vector<CoverageSection>& sections, const std::vector<Group>& catalogue);

}  // namespace motionrack::faults
