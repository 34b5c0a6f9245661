// Description of a card type for the rack file reader: channels, pins, settings and default wires. The plug-in of each
// type has one; see catalogue.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/stop_source.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::sim {
class Kernel;
class PositionFunction;
}  // namespace motionrack::sim

namespace motionrack::rack {

class Card;
class CardProcessor;

/// Meaning of a pin's level.
enum class PinKind : std::uint8_t {
    plain,
    contact  ///< an input held low by a closed contact: high while its wire is low or broken
};

/// A pin of the card; the name of a channel's pin begins with the channel's letter ("x" + "pp").
struct PinType {
    std::string_view name;
    PinDirection direction;
    std::string_view doc;
    double volts = 0;  ///< volts per level unit (analog pins); 0: a digital pin
    PinKind kind = PinKind::plain;
    int bits = 1;                   ///< width of a wire that carries a whole number
    std::string_view same_as = {};  ///< the pin whose wire this pin shares under a second name
};

/// A wire that exists unless the rack file overrides it. It joins pin `pin` of the axis' channel and signal `end` of
/// the axis (NAME.end).
struct DefaultWire {
    std::string_view pin;
    std::string_view end;
};

/// A signal of an axis that the card shows at a pin of the axis' channel, as an indicator.
struct Lamp {
    std::string_view name;  ///< "alarm", "capture", "compare"
    std::string_view pin;
    int lit = 1;  ///< level at which the indicator is on
};

/// A pin that reports or receives a stop of the machine; one per channel, or one per card.
struct StopPin {
    std::string_view pin;
    StopSource source;
    int active = 0;     ///< level that means stop
    int direction = 0;  ///< direction of a limit switch: +1, -1
};

/// A conflict between the settings of a card and others: the key to report and a sentence.
struct CardFlaw {
    std::string_view key;
    std::string text;
};

/// Properties of a card type that drives stages.
struct StageDrive {
    int outputs = 0;  ///< analog outputs, numbered from 0; 0: the type drives no stage
    /// Addresses of the scales that the card reads, in order; empty if its list is invalid.
    std::vector<int> (*scales)(const RackCard& card) = nullptr;
    double (*period_us)(const RackCard& card) = nullptr;                                     ///< frame period
    std::unique_ptr<CardProcessor> (*processor)(sim::Kernel& kernel, Card& card) = nullptr;  ///< closes the loops
    /// Connects a stage's scale to an input of the decoder that the card reads.
    void (*connect_scale)(Card& card, int input, sim::PositionFunction& scale) = nullptr;
};

/// Returns 0, every rate limit of a card that moves no axis.
inline double no_rate(const RackCard&) {
    return 0;
}

/// Rack file schema of one card type.
struct CardType {
    std::string_view name;
    std::string_view doc;
    std::string_view channels = {};  ///< one letter per axis channel; empty: one channel without a letter, or none if
                                     ///< the type has no channel pins
    std::span<const PinType> channel_pins = {};
    std::span<const PinType> chip_pins = {};
    std::span<const DefaultWire> default_wires = {};
    std::string_view estop_pin = {};                      ///< the chip pin that the emergency stop drives; empty: none
    std::span<const Field> settings = {};                 ///< keys of [card.NAME] specific to this type
    void* (*settings_of)(RackCard& card) = nullptr;       ///< returns the object that `settings` are read into
    double (*max_pulse_hz)(const RackCard&) = no_rate;    ///< highest pulse rate
    double (*max_accel_hz_s)(const RackCard&) = no_rate;  ///< highest change of the pulse rate
    double (*max_encoder_hz)(const RackCard&) = no_rate;  ///< highest count rate of an encoder input, counts/s
    std::int64_t max_position = 2'147'483'647;            ///< limit of the position counters, counts or pulses
    std::span<const std::string_view> home_pins = {};     ///< inputs of a channel for a home switch, by input number
    std::span<const std::string_view> index_pins = {};    ///< inputs of a channel for an encoder's index
    std::uint8_t (*select)(const RackCard&) = nullptr;    ///< see CardBus; nullptr: no number selects a card
    bool position_loop = false;  ///< the card positions an axis by itself; the axis needs an encoder
    /// Checks that involve several keys; `before`: the preceding cards in the file. May be nullptr.
    std::optional<CardFlaw> (*flaw)(const RackCard& card, std::span<const RackCard> before) = nullptr;
    /// Number of chip pins, for cards whose settings determine it. nullptr: all of them.
    std::size_t (*chip_pin_count)(const RackCard& card) = nullptr;
    std::span<const Lamp> lamps = {};
    std::span<const std::string_view> template_wires = {};  ///< lines of a template's [wires], with the card "motion"
    std::string_view probe_pin = {};                  ///< channel input whose edge can latch the position; empty: none
    bool (*latches)(const RackCard& card) = nullptr;  ///< true: the card latches; nullptr: the type cannot
    std::string_view latches_with = {};               ///< rack file settings with which a card of the type latches
    std::span<const StopPin> stop_pins = {};
    StageDrive stage_drive = {};
    bool marks = false;  ///< the card drives the mirrors and the laser of a scan head
    /// Number of scales that the card counts for the cards that read them; nullptr: not a decoder.
    std::int64_t (*decoded_scales)(const RackCard& card) = nullptr;
    bool measures_only = false;  ///< the card moves nothing: its bus may be accessed manually while axes move

    int channel_count() const {
        return channels.empty() ? (channel_pins.empty() ? 0 : 1) : static_cast<int>(channels.size());
    }
    /// Returns "x"; empty for a single channel without a letter.
    std::string_view channel_name(int channel) const {
        return channels.empty() ? "" : channels.substr(static_cast<std::size_t>(channel), 1);
    }
    /// Returns the index of the channel with that name, or -1.
    int channel_of(std::string_view channel_name) const;
};

/// Names of all types, in the order of the reference page.
std::span<const std::string_view> card_type_names();

/// Returns the names of the types for which `holds` is true, in that order; card_types_text() joins them with "or".
std::vector<std::string_view> card_types_that(bool (*holds)(const CardType& type));
std::string card_types_text(bool (*holds)(const CardType& type));

// Conditions for card_types_that() and card_types_text().
inline bool drives_stages(const CardType& type) {
    return type.stage_drive.outputs > 0;
}
inline bool has_channels(const CardType& type) {
    return !type.channels.empty();
}
inline bool positions_by_itself(const CardType& type) {
    return type.position_loop;
}
inline bool can_latch(const CardType& type) {
    return type.latches != nullptr;
}
inline bool drives_scan_heads(const CardType& type) {
    return type.marks;
}

/// Returns the type with that name, or nullptr.
const CardType* find_card_type(std::string_view name);

/// Pin of a card type under its full name. pins_of() lists those of each channel, then the chip's own pins.
struct CardPin {
    std::string name;
    PinDirection direction;
    int channel;   ///< index into `channels`, -1 for the chip's own
    double volts;  ///< see PinType
    PinKind kind;
    int bits;
    std::string_view doc;
    std::string_view same_as;  ///< see PinType (chip pins only)
};
std::vector<CardPin> pins_of(const CardType& type);
/// Returns the pins of this card; empty if its type is unknown.
std::vector<CardPin> pins_of(const RackCard& card);

}  // namespace motionrack::rack
