// A scan head as a part: its quantities. It has no faults.
#include <array>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<QuantityRow<RunningScanner>, 7> scanner_quantities = {{
    {"spot_x_mm", "position of the spot in the field, X",
     [](RunningScanner& scanner, Instant) { return scanner.station().spot().x; }, ValueKind::measures},
    {"spot_y_mm", "the same, Y", [](RunningScanner& scanner, Instant) { return scanner.station().spot().y; },
     ValueKind::measures},
    {"light", "1 while the laser is on, else 0",
     [](RunningScanner& scanner, Instant) { return scanner.station().gate().on() ? 1.0 : 0.0; }, ValueKind::yes_no},
    {"marked_mm", "length of all marks on the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().length_mm(); }, ValueKind::measures},
    {"energy_j", "laser energy on the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().energy_j(); }, ValueKind::measures},
    {"points", "stored points of the marks",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().points().size()); },
     ValueKind::amount},
    {"lost_points", "points beyond max_points",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().lost_points()); },
     ValueKind::amount},
}};

class ScannerPart final : public TablePart<RunningScanner> {
  public:
    explicit ScannerPart(RunningScanner& scanner)
        : TablePart(scanner.config.name, {}, scanner, scanner_quantities, {}) {}
};

void add_scanner_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningScanner& scanner : rack.scanners()) parts.push_back(std::make_unique<ScannerPart>(scanner));
}

}  // namespace

constexpr PartKind scanner_part_kind = {"scanner", add_scanner_parts, declared<scanner_quantities>,
                                        nullptr,   &scanner_sections, nullptr};

}  // namespace motionrack::rack
