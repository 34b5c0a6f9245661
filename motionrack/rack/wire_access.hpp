// Access to the wires of a running rack by name. Every pin can be read. Inputs and switches can be forced, which
// disconnects their source until they are released.
//
//   part ──X.limit_plus──► connection ──c1.xlmtp──► chip      force("X.limit_plus", 0): the switch is stuck
//                                         ▲                  force("c1.xlmtp", 0): this pin alone
//   encoder ══counts══► channel ◄── c1.xeca, c1.xecb          force("c1.xeca", 1): encoder cut off, the pins count
#pragma once

#include <map>
#include <motionrack/rack/part_signals.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class WireAccess {
  public:
    /// May be created at any time; the rack must outlive the object. One per rack.
    explicit WireAccess(Rack& rack);

    /// Returns the level of CARD.PIN, NAME.END or estop: 0 or 1, or V for analog pins. Errors: invalid_input for an
    /// unknown wire.
    Result<double> get(std::string_view name) const;
    /// Forces a wire from this instant: 0 or 1; NaN releases it. The two inputs of an encoder are taken over together:
    /// the other one holds its level, and the encoder is reconnected when both are released. In a started rack, call
    /// between runs. Errors: invalid_input (unknown wire), refused (an output, another value).
    Result<void> force(std::string_view name, double value);
    /// Returns the result of force() without forcing.
    Result<void> check(std::string_view name, double value) const;
    bool knows(std::string_view name) const { return wires_.find(name) != wires_.end(); }
    struct Named {
        std::string_view name;
        bool volts = false;     ///< a voltage, else a level
        bool drivable = false;  ///< force() accepts it
        bool recorded = false;  ///< a recording has its changes under this name
        int bits = 1;
    };
    /// All wires, sorted by name.
    std::vector<Named> names() const;

    /// Takes over the forced wires of `other`, whose rack has the same wiring and whose kernel state was copied.
    void copy_from(const WireAccess& other) { encoders_ = other.encoders_; }

  private:
    struct AccessibleWire {
        PartWire wire;
        int encoder = -1;  ///< index in encoders_, if an encoder is connected to this channel input as a unit
        int which = 0;     ///< 0: A, 1: B
    };
    static constexpr int no_axis = -1;  ///< ideal motor of a card
    /// An encoder connected to a channel.
    struct EncoderInput {
        EncoderLink link;
        unsigned driven = 0;  ///< bit 0: A, bit 1: B
    };

    void add_cards();
    void add_parts();
    void add(PartWire wire);
    void add_encoders();
    void add_ideal_encoders();
    void add_rest();
    const AccessibleWire* find(std::string_view name) const;
    tl::unexpected<Error> unknown(std::string_view name) const;
    unsigned lines_at(const EncoderInput& input) const;
    void drive(const AccessibleWire& known, int level);
    void release(const AccessibleWire& known);

    Rack& rack_;
    std::map<std::string, AccessibleWire, std::less<>> wires_;
    std::vector<EncoderInput> encoders_;
};

/// Volts per level unit of the wires that carry a voltage, by wire name.
std::map<std::string, double> volts_of_wires(const RackConfig& config);

}  // namespace motionrack::rack
