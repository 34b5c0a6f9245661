// The kinds of card that a rack file can name: channels, pins, settings and default wires; one row a card type.
#pragma once

#include <motionrack/rack/config.hpp>
#include <motionrack/rack/stop_source.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

enum class PinDirection : std::uint8_t { input, output };

/// What the level of a pin means.
enum class PinKind : std::uint8_t {
    plain,
    contact  ///< an input that a closed contact holds low: high while its wire is low or broken
};

/// A pin of the card; a channel's pin is named with the channel's letter in front ("x" + "pp").
struct PinType {
    std::string_view name;
    PinDirection direction;
    std::string_view doc;
    double volts = 0;  ///< of an analog pin: V for one unit of its wire's level; 0: a digital pin
    PinKind kind = PinKind::plain;
    int bits = 1;                   ///< of a wire that carries a whole number
    std::string_view same_as = {};  ///< the pin whose wire this is under a second name
};

/// A wire that is there unless the rack file says otherwise: pin `pin` of the axis' channel, end `end` of the axis
/// (NAME.end).
struct DefaultWire {
    std::string_view pin;
    std::string_view end;
};

/// A signal of an axis that its card has at a pin of the axis' channel, for people to look at.
struct Lamp {
    std::string_view name;  ///< "alarm", "capture", "compare"
    std::string_view pin;
    int lit = 1;  ///< the level that means yes
};

/// A pin at which a card hears, or tells, that the machine must stop; of each channel, or of the card.
struct StopPin {
    std::string_view pin;
    StopSource source;
    int active = 0;     ///< the level that means stop
    int direction = 0;  ///< of a limit switch: +1, -1
};

/// What is wrong between the settings of a card and others: the key to blame and a sentence.
struct CardFlaw {
    std::string_view key;
    std::string text;
};

/// What the rack file may say about one kind of card.
struct CardType {
    std::string_view name;
    std::string_view doc;
    std::string_view channels;  ///< a letter for each axis channel; empty: one without a letter, or none if there are
                                ///< no channel pins
    std::span<const PinType> channel_pins;
    std::span<const PinType> chip_pins;
    std::span<const DefaultWire> default_wires;
    std::string_view estop_pin;                 ///< the chip pin that the emergency stop drives; empty: none
    std::span<const Field> settings;            ///< keys of [card.NAME] that only this type has
    void* (*settings_of)(RackCard& card);       ///< the object that `settings` are read into
    double (*max_pulse_hz)(const RackCard&);    ///< fastest pulse output
    double (*max_accel_hz_s)(const RackCard&);  ///< fastest change of the pulse rate
    double (*max_encoder_hz)(const RackCard&);  ///< most counts a second that an encoder input can follow
    std::int64_t max_position = 2'147'483'647;  ///< counts or pulses that its position counters hold
    std::span<const std::string_view> home_pins =
        {};  ///< a channel's inputs for a home switch; their places are its numbers
    std::span<const std::string_view> index_pins = {};  ///< and for an encoder's index
    bool position_loop = false;  ///< it positions an axis by itself with its encoder, which the axis needs then
    /// What no single key can tell; `before`: the cards before it in the file. May be nullptr.
    std::optional<CardFlaw> (*flaw)(const RackCard& card, std::span<const RackCard> before) = nullptr;
    /// Of cards whose settings say how many of the chip pins there are. May be nullptr: all of them.
    std::size_t (*chip_pin_count)(const RackCard& card) = nullptr;
    std::span<const Lamp> lamps = {};
    std::string_view probe_pin = {};  ///< a channel's input at whose edge the card can catch its position; empty: none
    std::span<const StopPin> stop_pins = {};
    bool measures_only = false;  ///< nothing moves by it: its bus may be used by hand while axes move

    int channel_count() const {
        return channels.empty() ? (channel_pins.empty() ? 0 : 1) : static_cast<int>(channels.size());
    }
    /// "x"; empty for the one channel without a letter.
    std::string_view channel_name(int channel) const {
        return channels.empty() ? "" : channels.substr(static_cast<std::size_t>(channel), 1);
    }
    /// The channel of that name, or -1.
    int channel_of(std::string_view channel_name) const;
};

/// All card types, in the order of the reference page.
std::span<const CardType> card_types();

/// The type of that name, or nullptr.
const CardType* find_card_type(std::string_view name);

/// The pins of a card type by their full names, channel by channel, then the chip's own.
struct Pin {
    std::string name;
    PinDirection direction;
    int channel;   ///< index into `channels`, -1 for the chip's own
    double volts;  ///< see PinType
    PinKind kind;
    int bits;
    std::string_view doc;
    std::string_view same_as;  ///< of the chip's own pins: see PinType
};
std::vector<Pin> pins_of(const CardType& type);
/// Those that this card has; none if its type is unknown.
std::vector<Pin> pins_of(const RackCard& card);

}  // namespace motionrack::rack
