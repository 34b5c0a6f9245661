// Signals of parts: the ends of wires in [wires], and the wires of a running rack that are read and forced by name.
//
//   table of a kind, a row per signal ──┬──► PartSignal "X.limit_plus" of a rack file: default rule, [wires]
//                                       ├──► PartWire of a running rack: WireAccess
//                                       └──► reference page
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/sim/kernel.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace motionrack::rack {

class Rack;

/// Row of the table of signals of a kind of part. `Config`: its struct in the rack file.
template <class Config>
struct SignalRow {
    std::string_view name;  ///< "limit_plus" of "X.limit_plus"; empty: the wire is called as the part
    PinDirection direction;
    std::string_view doc;
    bool (*present)(const Config& config) = nullptr;  ///< nullptr: always
    std::string_view needs = {};                      ///< rack file entry that the signal requires; with "{u}"
    double volts = 0;                                 ///< volts per level unit (analog signals): see PinType
    int bits = 1;                                     ///< see PinType
    bool fixed = false;                               ///< connected by the rack itself; not available in [wires]

    bool has(const Config& config) const { return present == nullptr || present(config); }
};

/// A signal of a part of a rack file, as an end of a wire.
struct PartSignal {
    std::string name;  ///< "X.limit_plus", "probe"
    WireEnd end;
    PinDirection direction = PinDirection::output;
    double volts = 0;
    int bits = 1;
    bool fixed = false;
    std::string missing = {};  ///< reason why the rack lacks the signal's source; empty: it has it
};

/// A signal of a kind of part, whether or not a rack has such a part.
struct DeclaredSignal {
    std::string name;  ///< "X.limit_plus", "NAME.enc_a", "probe"
    PinDirection direction;
    std::string doc;
    std::string_view needs;  ///< empty: every part of the kind has the signal
};

/// A wire of a part in a running rack.
struct PartWire {
    std::string name;                    ///< "X.limit_plus"
    sim::WireId id = sim::WireId::none;  ///< none: the kernel has no such wire
    double unit = 1;                     ///< volts per level unit
    int bits = 1;
    std::string refused = {};                    ///< reason why it cannot be forced; empty: it can
    bool from_edges = false;                     ///< recorded from the edges of a position function
    std::function<int(Instant now)> level = {};  ///< replaces the level of `id`; may be empty
};

/// Called with the names of a card's pin and of a part's signal.
using JoinPins = std::function<void(const std::string& pin, const std::string& signal)>;

/// The signals of a kind of part.
struct PartSignals {
    EndOwner owner;
    std::vector<DeclaredSignal> (*declared)();
    std::vector<PartSignal> (*of)(const RackConfig& config);
    std::string (*part_name)(const RackConfig& config, std::size_t index);
    /// Wires of all parts of the kind in a rack.
    std::vector<PartWire> (*wires)(Rack& rack);
    /// Joins the pins and signals that the default rule connects and the rack has. nullptr: the rule connects none.
    void (*join_by_default)(const RackConfig& config, const JoinPins& join) = nullptr;
    /// Returns the wire of an end in a rack that is being built; it may add the wire. nullptr: the kernel wire of the
    /// same name.
    sim::WireId (*wire_of)(Rack& rack, const WireEnd& end) = nullptr;
};

/// Part whose signals are listed.
struct SignalOwner {
    EndOwner kind;
    std::size_t index;
    std::string name;     ///< "X"
    std::string subject;  ///< in sentences: "axis X"
    std::string_view unit;
};

/// Returns "X.limit_plus"; the part's name for a signal without one.
std::string signal_name(std::string_view part, std::string_view signal);
/// Returns why the owner lacks a signal: "axis X needs a servo to have it".
std::string missing_signal(const SignalOwner& owner, std::string_view needs);

/// Appends the signals of a part in the order of their table.
template <class Config>
void append_signals(std::span<const SignalRow<std::type_identity_t<Config>>> rows, const Config& config,
                    const SignalOwner& owner, std::vector<PartSignal>& out) {
    for (const SignalRow<Config>& row : rows) {
        PartSignal& one = out.emplace_back();
        one.name = signal_name(owner.name, row.name);
        one.end = {owner.kind, static_cast<int>(owner.index), std::string(row.name)};
        one.direction = row.direction;
        one.volts = row.volts;
        one.bits = row.bits;
        one.fixed = row.fixed;
        if (!row.has(config)) one.missing = missing_signal(owner, row.needs);
    }
}

/// Lists a table of signals. `part`: "NAME"; `of`: beginning of each description.
template <class Config>
std::vector<DeclaredSignal> declared_signals(std::span<const SignalRow<Config>> rows, std::string_view part,
                                             std::string_view of = {}) {
    std::vector<DeclaredSignal> out;
    for (const SignalRow<Config>& row : rows)
        if (!row.fixed)
            out.push_back({signal_name(part, row.name), row.direction, std::string(of).append(row.doc), row.needs});
    return out;
}

/// Signals of all parts of a rack file, kind by kind in the order of the catalogue.
std::vector<PartSignal> part_signals(const RackConfig& config);
/// Returns the signals of the kind whose parts own such ends of wires.
const PartSignals& signals_of(EndOwner owner);

}  // namespace motionrack::rack
