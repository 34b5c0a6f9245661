// libFuzzer: any bytes as a rack file give a configuration or errors, never a crash, a hang or a partly checked
// configuration.
//
// Build with clang++ -fsanitize=fuzzer,address,undefined; run with the folder corpus/rack.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/rack/config.hpp>
#include <set>
#include <string_view>

using namespace motionrack;
using namespace motionrack::rack;

namespace {

bool sorted(const std::vector<Error>& list) {
    for (std::size_t i = 1; i < list.size(); ++i) {
        const TextPosition &a = list[i - 1].location, &b = list[i].location;
        if (a.line > b.line || (a.line == b.line && a.column > b.column)) return false;
    }
    return true;
}

void check_config(const RackConfig& config) {
    MOTIONRACK_ASSERT(!config.cards.empty());
    std::set<int> slots;
    for (const RackCard& card : config.cards) MOTIONRACK_ASSERT(card.slot && slots.insert(*card.slot).second);
    for (const RackAxis& axis : config.axes) {
        MOTIONRACK_ASSERT(config.card(axis.card) != nullptr);
        MOTIONRACK_ASSERT(std::isfinite(axis.pulses_per_unit()) && axis.pulses_per_unit() > 0);
        MOTIONRACK_ASSERT(std::isfinite(axis.counts_per_unit()) && axis.max_pulse_hz() >= 1);
        MOTIONRACK_ASSERT(axis.min_limit < axis.max_limit);
        MOTIONRACK_ASSERT(axis.initial_position >= axis.min_limit && axis.initial_position <= axis.max_limit);
    }
    for (const RackConveyor& track : config.tracks) MOTIONRACK_ASSERT(parts::Conveyor::make(track.settings()));
    for (const RackScanner& scanner : config.scanners) {
        MOTIONRACK_ASSERT(config.card(scanner.card) != nullptr &&
                          (!scanner.conveyor || config.track(*scanner.conveyor) != nullptr));
        MOTIONRACK_ASSERT(parts::MarkingStation::make(scanner.settings()));
    }
    std::set<std::string> driven;
    for (const RackWire& wire : config.wires) {
        MOTIONRACK_ASSERT(driven.insert(config.end_name(wire.to)).second);
        MOTIONRACK_ASSERT(!config.end_name(wire.from).empty());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const RackReading reading = read_rack_text({reinterpret_cast<const char*>(data), size}, "fuzz");
    MOTIONRACK_ASSERT(reading.config.has_value() == reading.errors.empty());
    MOTIONRACK_ASSERT(sorted(reading.errors) && sorted(reading.warnings));
    for (const Error& error : reading.errors) MOTIONRACK_ASSERT(!error.message.empty());
    if (reading.config) check_config(*reading.config);
    return 0;
}
