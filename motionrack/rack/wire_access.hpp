// The wires of a running rack by their names, as a hand with a test lead has them: every pin can be looked at, inputs
// and switches can be driven, and then what drove them before is cut off until they are released.
//
//   part ──X.limit_plus──► junction ──c1.xlmtp──► chip        set("X.limit_plus", 0): the switch is stuck
//                                         ▲                  set("c1.xlmtp", 0): this pin alone
//   encoder ══counts══► channel ◄── c1.xeca, c1.xecb          set("c1.xeca", 1): the encoder is cut off, the pins count
#pragma once

#include <map>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class WireAccess {
  public:
    /// Any time; the rack must outlive it. One desk a rack.
    explicit WireAccess(Rack& rack);

    /// The level of CARD.PIN, NAME.END or estop: 0 or 1, of analog pins V. Errors: invalid_input if there is no such
    /// wire.
    Result<double> get(std::string_view name) const;
    /// Drives a wire from now on: 0 or 1; NaN releases it. The two inputs of an encoder are taken over together: the
    /// other one holds the level that it had, and the encoder is connected again when both are released. In a started
    /// rack, between runs. Errors: invalid_input (no such wire), refused (an output, another value).
    Result<void> force(std::string_view name, double value);
    /// What set would say.
    Result<void> check(std::string_view name, double value) const;
    bool knows(std::string_view name) const { return wires_.find(name) != wires_.end(); }
    struct Named {
        std::string_view name;
        bool volts = false;     ///< a voltage, else a level
        bool drivable = false;  ///< set takes it
        bool recorded = false;  ///< a recording has its changes, by this name
        int bits = 1;
    };
    /// All wires in the order of their names.
    std::vector<Named> names() const;

    /// The wires are driven as those of `other`, whose rack has the same wiring and whose kernel state was copied.
    void copy_from(const WireAccess& other) { encoders_ = other.encoders_; }

  private:
    enum class Kind : std::uint8_t {
        plain,    ///< a wire of the kernel
        counted,  ///< an input of a channel to which an encoder is connected as a whole
        track,    ///< an encoder's own end
        pulses    ///< a motor's own end
    };
    struct Wire {
        Kind kind = Kind::plain;
        sim::WireId id = sim::WireId::none;  ///< plain, counted; pulses: the pin that drives it, if any
        int index = -1;                      ///< counted: of encoders_; track: of the axis
        int which = 0;                       ///< 0: A, 1: B
        double unit = 1;                     ///< of an analog pin: V for one unit of the level
        int bits = 1;                        ///< of a wire that carries a whole number
        std::string refused;                 ///< why it cannot be driven; empty: it can
    };
    static constexpr int no_axis = -1;  ///< the ideal motor of a card
    /// An encoder at a channel.
    struct EncoderInput {
        EncoderLink link;
        unsigned driven = 0;  ///< bit 0: A, bit 1: B
    };

    void add_cards();
    void add_axes();
    void add_tracks();
    void add_encoders();
    void add_ideal_encoders();
    const Wire* find(std::string_view name) const;
    tl::unexpected<Error> unknown(std::string_view name) const;
    unsigned lines_at(const EncoderInput& input) const;
    void drive(const Wire& wire, int level);
    void release(const Wire& wire);

    Rack& rack_;
    std::map<std::string, Wire, std::less<>> wires_;
    std::vector<EncoderInput> encoders_;
};

/// Of wires that carry a voltage, by their names: the volts of one unit of the level.
std::map<std::string, double> volts_of_wires(const RackConfig& config);

}  // namespace motionrack::rack
