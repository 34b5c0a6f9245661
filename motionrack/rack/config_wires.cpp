// Wires: the default rule of each card type, and the changes by the rack file. In the file, the input must be on the
// left and the output that drives it right, so that the grammar of TOML itself permits one driver per input:
//
//   [wires]
//   "motion.xlmtp" = "Y.limit_plus"    # replaces X.limit_plus
//   "motion.xin0" = "open"             # no wire
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <set>
#include <tuple>
#include <utility>

namespace motionrack::rack {
namespace {

constexpr std::string_view logic = "a logic level", voltage = "a voltage", number = "a number";

struct KnownEnd {
    WireEnd end;
    PinDirection direction = PinDirection::input;
    std::string_view carries = logic;
    std::string missing;  ///< not empty: the name is valid, but the rack lacks the part; the reason
};

class WireResolver {
  public:
    WireResolver(const RackConfig& config, Problems& problems) : config_(config), problems_(problems) {
        for (std::size_t i = 0; i < config.cards.size(); ++i) add_card(static_cast<int>(i));
        for (PartSignal& signal : part_signals(config)) add_signal(std::move(signal));
    }

    void default_rule() {
        for (const PartKind* kind : part_kinds())
            if (kind->signals != nullptr && kind->signals->join_by_default != nullptr)
                kind->signals->join_by_default(
                    config_, [this](const std::string& pin, const std::string& signal) { connect(pin, signal); });
    }

    void read(const TomlNode& wires) {
        for (const TomlNode& node : wires.children) {
            if (node.type != TomlType::table) {
                read_wire(node.key, node);
                continue;
            }
            for (const TomlNode& inner : node.children) read_wire(node.key + "." + inner.key, inner);
        }
        find_loops();
        too_many_inputs();
    }

    std::vector<RackWire> take() {
        std::vector<RackWire> out;
        for (auto& [to, wire] : wires_) out.push_back(std::move(wire));
        const auto order = [](const WireEnd& end) { return std::tie(end.owner, end.index, end.pin); };
        std::sort(out.begin(), out.end(),
                  [&](const RackWire& a, const RackWire& b) { return order(a.to) < order(b.to); });
        return out;
    }

    std::vector<WireEnd> take_open() { return std::move(open_); }

    /// Returns true if no error has been found.
    bool sound() const { return sound_; }

    /// Location at which the file names that input; an empty place if it does not.
    TextPosition location_of(const std::string& input) const {
        const auto found = named_.find(input);
        return found != named_.end() ? found->second->key_location : TextPosition{};
    }

  private:
    void add_card(int index) {
        const RackCard& card = config_.cards[static_cast<std::size_t>(index)];
        const CardType* type = find_card_type(card.type);
        if (type == nullptr) {
            unjudged_.push_back(card.name);
            return;
        }
        for (CardPin& pin : pins_of(card)) {
            const std::string wire = pin.same_as.empty() ? pin.name : std::string(pin.same_as);
            known_[card.name + "." + pin.name] = {{EndOwner::card, index, wire},
                                                  pin.direction,
                                                  pin.volts > 0  ? voltage
                                                  : pin.bits > 1 ? number
                                                                 : logic,
                                                  {}};
        }
    }

    void add_signal(PartSignal signal) {
        if (signal.fixed) return;
        known_[signal.name] = {std::move(signal.end), signal.direction,
                               signal.volts > 0  ? voltage
                               : signal.bits > 1 ? number
                                                 : logic,
                               std::move(signal.missing)};
    }

    /// Adds a wire of the default rule, from the output of the two to the input; none if a part is missing.
    void connect(const std::string& a, const std::string& b) {
        const auto first = known_.find(a);
        const auto second = known_.find(b);
        if (first == known_.end() || second == known_.end()) return;
        if (!first->second.missing.empty() || !second->second.missing.empty()) return;
        const bool second_drives = first->second.direction == PinDirection::input;
        const auto& [from, to] = second_drives ? std::tie(second, first) : std::tie(first, second);
        wires_.emplace(to->first, RackWire{from->second.end, to->second.end, true});
    }

    /// Returns the end of that name, or nullptr after an error (no error for cards whose own type is already in error).
    const KnownEnd* find_end(const std::string& name, TextPosition location) {
        const auto found = known_.find(name);
        if (found != known_.end()) {
            if (found->second.missing.empty()) return &found->second;
            error(location, fmt::format("The rack does not have {}: {}.", name, found->second.missing));
            return nullptr;
        }
        const std::string owner = name.substr(0, name.find('.'));
        if (std::find(unjudged_.begin(), unjudged_.end(), owner) != unjudged_.end()) return nullptr;
        std::string hint;
        if (problems_.wants_hints()) {
            std::vector<std::string_view> names;
            for (const auto& [known, end] : known_) names.push_back(known);
            hint = did_you_mean(name, names);
        }
        error(location, fmt::format("No card, axis or part of this rack has the pin {}{}", in_quotes(name),
                                    hint.empty() ? "." : hint));
        return nullptr;
    }

    /// Returns the first name of a pin that has two.
    std::string first_name(const std::string& name, const KnownEnd* end) const {
        return end != nullptr && end->end.owner == EndOwner::card ? config_.end_name(end->end) : name;
    }

    void read_wire(const std::string& given, const TomlNode& node) {
        if (node.type != TomlType::text) {
            error(node.value_location,
                  fmt::format("The wire {} is {}; write its source in quotes, such as \"X.home\", or \"open\".",
                              in_quotes(given), type_name(node.type)));
            return;
        }
        const KnownEnd* left = find_end(given, node.key_location);
        const std::string name = first_name(given, left);
        if (left != nullptr && !named_.emplace(name, &node).second) {
            const std::string same = given != name ? fmt::format(", which {} is too,", given) : "";
            error(node.key_location, fmt::format("{}{} is wired twice; an input has one wire.", name, same));
            return;
        }
        if (node.text == "open") {
            if (left != nullptr && left->direction == PinDirection::output) {
                error(node.key_location,
                      fmt::format("{} is an output; to leave it open, write \"open\" for each input that it drives.",
                                  name));
            } else {
                wires_.erase(name);
                if (left != nullptr && left->end.owner == EndOwner::card) open_.push_back(left->end);
            }
            return;
        }
        const KnownEnd* right = find_end(node.text, node.value_location);
        if (left != nullptr && right != nullptr) join(name, *left, *right, node);
    }

    void join(const std::string& name, const KnownEnd& left, const KnownEnd& right, const TomlNode& node) {
        using enum PinDirection;
        if (name == node.text) {
            error(node.key_location, fmt::format("{} is wired to itself.", name));
        } else if (left.direction == output && right.direction == output) {
            error(node.key_location,
                  fmt::format("{} and {} are both outputs and would drive against each other; write input = output.",
                              name, node.text));
        } else if (left.direction == output) {
            error(node.key_location,
                  fmt::format(
                      "{0} is an output and {1} an input; the input must be on the left: write \"{1}\" = \"{0}\".",
                      name, node.text));
        } else if (right.direction == input) {
            inputs_[name] = &node;
        } else if (left.carries != right.carries) {
            error(node.key_location, fmt::format("{} is {} and {} {}; they cannot be wired together.", name,
                                                 left.carries, node.text, right.carries));
        } else {
            wires_.insert_or_assign(name, RackWire{right.end, left.end, false});
        }
    }

    /// Reports inputs wired to inputs, which nothing drives; a circle of inputs is reported once.
    void find_loops() {
        std::set<std::string> reported;
        for (const auto& [name, node] : inputs_) {
            if (reported.count(name) != 0) continue;
            std::vector<std::string> chain = {name};
            const TomlNode* at = node;
            while (at->text != name && chain.size() < 16 && inputs_.count(at->text) != 0) {
                chain.push_back(at->text);
                at = inputs_.at(at->text);
            }
            if (at->text == name) {
                reported.insert(chain.begin(), chain.end());
                error(node->key_location, fmt::format("These wires form a loop: {} = {}; no output drives them.",
                                                      fmt::join(chain, " = "), name));
            } else {
                error(node->key_location, fmt::format("{} and {} are both inputs; name the output that drives {}.",
                                                      name, node->text, name));
            }
        }
    }

    /// Listener limit of a kernel wire, less one for a recording.
    static constexpr int max_inputs = 31;

    void too_many_inputs() {
        std::map<std::string, int> inputs;
        for (const auto& input : wires_) {
            const WireEnd& output = input.second.from;
            const std::string from = config_.end_name(output);
            if (++inputs[from] != max_inputs + 1) continue;
            // An input named in the file; the default rule alone wires fewer.
            const auto named = std::find_if(named_.begin(), named_.end(), [&](const auto& each) {
                const auto its = wires_.find(each.first);
                return its != wires_.end() && its->second.from == output;
            });
            error(named != named_.end() ? named->second->key_location : TextPosition{},
                  fmt::format("{} drives more than {} inputs, the limit of an output; leave some open.", from,
                              max_inputs));
        }
    }

    void error(TextPosition location, std::string message) {
        sound_ = false;
        problems_.error(location, std::move(message));
    }

    const RackConfig& config_;
    Problems& problems_;
    bool sound_ = true;
    std::map<std::string, KnownEnd> known_;
    std::map<std::string, RackWire> wires_;  ///< by input name
    std::map<std::string, const TomlNode*> named_;
    std::map<std::string, const TomlNode*> inputs_;
    std::vector<WireEnd> open_;
    std::vector<std::string> unjudged_;  ///< cards of unknown type
};

}  // namespace

void resolve_wires(RackConfig& config, const TomlNode* wires, Problems& problems) {
    WireResolver resolver(config, problems);
    resolver.default_rule();
    if (wires != nullptr) resolver.read(*wires);
    config.wires = resolver.take();
    config.open = resolver.take_open();
    if (!resolver.sound()) return;  // one mistake, one error
    resolve_links(
        config, [&](const std::string& input) { return resolver.location_of(input); }, problems);
}

}  // namespace motionrack::rack
