// Links of pulses and encoder tracks among the wires. They are not switched edge by edge but joined as position
// functions. So step and direction must be a pair, as must the two tracks of an encoder:
//
//   m.xpp -> X.step,  m.xpm -> X.dir      the pulses of channel x turn the motor of X
//   X.enc_a -> m.xeca, X.enc_b -> m.xecb  the encoder of X at channel x; crossed over: it counts backwards
//
// A card without channels has no pairs: its inputs are wires with every edge of the encoder.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/sim/position_function.hpp>
#include <tuple>

namespace motionrack::rack {
namespace {

/// Returns the pin of a card type that the default rule joins with that signal of an axis; empty if it has none.
std::string_view pin_for(const CardType& type, std::string_view end) {
    for (const DefaultWire& wire : type.default_wires)
        if (wire.end == end) return wire.pin;
    return {};
}

class LinkResolver {
  public:
    LinkResolver(RackConfig& config, const std::function<TextPosition(const std::string&)>& location_of,
                 Problems& problems)
        : config_(config), location_of_(location_of), problems_(problems) {}

    void run() {
        for (std::size_t i = 0; i < config_.axes.size(); ++i) pulses_of(static_cast<int>(i));
        for (RackWire& wire : config_.wires) {
            wire.link = is_pulse_input(wire.to) || (is_track(wire.from) && !takes_edges(wire.to));
            if (is_track(wire.from) && !takes_edges(wire.to)) encoder_at(wire);
        }
        std::sort(config_.encoder_links.begin(), config_.encoder_links.end(),
                  [](const EncoderLink& a, const EncoderLink& b) {
                      return std::tie(a.card, a.channel) < std::tie(b.card, b.channel);
                  });
        too_many_readers();
    }

  private:
    static bool is_pulse_input(const WireEnd& end) {
        return end.owner == EndOwner::axis && (end.pin == "step" || end.pin == "dir");
    }
    bool takes_edges(const WireEnd& end) const {
        return end.owner == EndOwner::card && type_of(end.index).channel_count() == 0;
    }
    static bool is_track(const WireEnd& end) {
        return end.owner == EndOwner::axis && (end.pin == "enc_a" || end.pin == "enc_b");
    }

    const RackWire* wire_to(const WireEnd& to) const {
        const auto found =
            std::find_if(config_.wires.begin(), config_.wires.end(), [&](const RackWire& w) { return w.to == to; });
        return found != config_.wires.end() ? &*found : nullptr;
    }

    const CardType& type_of(int card) const {
        return *find_card_type(config_.cards[static_cast<std::size_t>(card)].type);
    }

    /// Returns the pin of that channel which the default rule joins with `end`.
    WireEnd pin_of(int card, int channel, std::string_view end) const {
        const CardType& type = type_of(card);
        return {EndOwner::card, card, std::string(type.channel_name(channel)).append(pin_for(type, end))};
    }

    /// Returns the channel whose pin for `end` this is, or -1.
    int channel_with(const WireEnd& pin, std::string_view end) const {
        if (pin.owner != EndOwner::card || pin_for(type_of(pin.index), end).empty()) return -1;
        for (int channel = 0; channel < type_of(pin.index).channel_count(); ++channel)
            if (pin == pin_of(pin.index, channel, end)) return channel;
        return -1;
    }

    // ---- Step and direction

    void pulses_of(int axis) {
        const WireEnd step_end{EndOwner::axis, axis, "step"}, dir_end{EndOwner::axis, axis, "dir"};
        const RackWire* step = wire_to(step_end);
        if (step == nullptr) return;  // open: the motor does not turn
        const std::string step_name = name(step_end), dir_name = name(dir_end);
        const int channel = channel_with(step->from, "step");
        if (channel < 0) {
            error({step_name}, fmt::format("{} cannot be driven by {}: a motor follows the pulse output of a channel, "
                                           "such as {}. Write one of those, or \"open\".",
                                           step_name, name(step->from), own_pin(axis, "step")));
            return;
        }
        const PulseLink link{axis, step->from.index, channel};
        const WireEnd needed = pin_of(link.card, channel, "dir");
        const RackWire* dir = wire_to(dir_end);
        if (dir == nullptr || dir->from != needed) {
            error({dir_name, step_name},
                  fmt::format("{} is driven by {} and {} {}; pulses and their direction come from one channel: write "
                              "\"{}\" = \"{}\".",
                              step_name, name(step->from), dir_name,
                              dir == nullptr ? "is open" : "by " + name(dir->from), dir_name, name(needed)));
            return;
        }
        for (const PulseLink& other : config_.pulse_links) {
            if (other.card != link.card || other.channel != link.channel) continue;
            const std::string other_name = name({EndOwner::axis, other.axis, "step"});
            error({step_name, other_name},
                  fmt::format("{} drives {} and {}, but a channel's pulses turn one motor here; write \"open\" or "
                              "another channel for one of them.",
                              name(step->from), other_name, step_name));
            return;
        }
        config_.pulse_links.push_back(link);
    }

    /// Returns an example: the pin of the axis' own channel, or of the first channel if the file names no existing one.
    std::string own_pin(int axis, std::string_view end) const {
        const RackAxis& own = config_.axes[static_cast<std::size_t>(axis)];
        for (std::size_t i = 0; i < config_.cards.size(); ++i)
            if (config_.cards[i].name == own.card)
                return name(pin_of(static_cast<int>(i), std::max(0, channel_index(config_, own)), end));
        return "CARD.PIN";
    }

    // ---- Encoder tracks

    /// Checks a `wire` that begins at an encoder track: it must end at an encoder input, and the other input must have
    /// the other track.
    void encoder_at(const RackWire& wire) {
        int channel = channel_with(wire.to, "enc_a");
        const bool at_a = channel >= 0;
        if (!at_a) channel = channel_with(wire.to, "enc_b");
        if (channel < 0) {
            error({name(wire.to)}, fmt::format("{} cannot be driven by {}: the tracks of an encoder lead to the "
                                               "encoder inputs of a channel, such as {} and {}.",
                                               name(wire.to), name(wire.from), own_pin(wire.from.index, "enc_a"),
                                               own_pin(wire.from.index, "enc_b")));
            return;
        }
        const WireEnd other = pin_of(wire.to.index, channel, at_a ? "enc_b" : "enc_a");
        const WireEnd track{EndOwner::axis, wire.from.index, wire.from.pin == "enc_a" ? "enc_b" : "enc_a"};
        const RackWire* partner = wire_to(other);
        if (partner == nullptr || partner->from != track) {
            if (!at_a && partner != nullptr && is_track(partner->from)) return;  // reported at input A
            const std::string there = partner == nullptr ? "is open" : "is driven by " + name(partner->from);
            error({name(other), name(wire.to)},
                  fmt::format("{} is driven by {} but {} {}; an encoder is wired with both tracks or not at all: write "
                              "\"{}\" = \"{}\", or \"open\" for both.",
                              name(wire.to), name(wire.from), name(other), there, name(other), name(track)));
            return;
        }
        if (at_a) config_.encoder_links.push_back({wire.from.index, wire.to.index, channel, wire.from.pin == "enc_b"});
    }

    void too_many_readers() {
        for (std::size_t axis = 0; axis < config_.axes.size(); ++axis) {
            const bool lines = std::any_of(config_.wires.begin(), config_.wires.end(), [&](const RackWire& wire) {
                return wire.from.index == static_cast<int>(axis) && is_track(wire.from) && !wire.link;
            });
            int readers = lines;  // the edges as wires take one listener
            for (const EncoderLink& link : config_.encoder_links) {
                if (link.axis != static_cast<int>(axis) || ++readers != sim::PositionFunction::max_listeners + 1)
                    continue;
                const std::string input = name(pin_of(link.card, link.channel, "enc_a"));
                error({input},
                      fmt::format("{} would be input number {} of the encoder of axis {}; one encoder leads "
                                  "to {} channels at most.",
                                  input, readers, config_.axes[axis].letter, sim::PositionFunction::max_listeners));
            }
        }
    }

    // ---- Reporting

    std::string name(const WireEnd& end) const { return config_.end_name(end); }

    /// Reports an error at the first of these inputs that the file names.
    void error(std::initializer_list<std::string> inputs, std::string message) {
        for (const std::string& input : inputs) {
            const TextPosition location = location_of_(input);
            if (location != TextPosition{}) return problems_.error(location, std::move(message));
        }
        // The file names none of these inputs, so the default rule wired two axes to one channel: already reported.
        if (!problems_.any_errors()) problems_.error({}, std::move(message));
    }

    RackConfig& config_;
    const std::function<TextPosition(const std::string&)>& location_of_;
    Problems& problems_;
};

}  // namespace

void resolve_links(RackConfig& config, const std::function<TextPosition(const std::string& input)>& location_of,
                   Problems& problems) {
    LinkResolver(config, location_of, problems).run();
}

}  // namespace motionrack::rack
