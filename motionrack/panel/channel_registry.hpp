// Numeric channels by name, readable while the machine runs.
//
//   "X.commanded"  "X.position_mm"  "c1.xlmtp"  "estop"  "c1.x.LP"  "c1.fout_hz"
//    status         quantity         wire                 inspect     card's quantity
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/rack/card_types.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::panel {

/// When a channel can be read.
enum class ChannelReader : std::uint8_t {
    edges,    ///< a digital wire: a recording has every change
    anytime,  ///< also within a run of the kernel: reading does not allocate
    slices    ///< only between two runs of the kernel, once per slice
};
std::string_view name_of(ChannelReader reader);

struct LiveChannel {
    std::string name;
    std::string unit;
    std::string text;  ///< one sentence
    ChannelReader reader = ChannelReader::slices;
    std::function<double()> read;  ///< on the motion thread; without side effects
};

/// Returns the card's name in a channel name: "c1" for "c1.x.LP".
std::string_view card_part(std::string_view name);

/// Returns the names under which a card's inspect() knows a register: one name, or one per channel.
std::vector<std::string> register_names(const rack::CardType& type, const RegisterInfo& reg);

class ChannelRegistry {
  public:
    /// Channels of a virtual chip are left out if a real card replaces it.
    explicit ChannelRegistry(operate::Machine& machine);

    /// All channels by name.
    const std::map<std::string, LiveChannel, std::less<>>& all() const { return channels_; }
    /// Finds a channel by name; returns nullptr if it is unknown.
    const LiveChannel* find(std::string_view name) const;
    /// Returns the set of these channels; equal lists share one. Errors: invalid_input with the unknown name, or for
    /// more than Panel::max_channels.
    Result<std::shared_ptr<ChannelSet>> set_of(const std::vector<std::string>& names);
    /// Reads the channels of each set in use and shows the values to its clients; removes the other sets.
    void show(std::int64_t sequence, Instant at);

  private:
    void add(std::string name, std::string_view unit, std::string_view text, ChannelReader reader,
             std::function<double()> read);
    void add_axes(operate::Machine& machine);
    void add_quantities(rack::Rack& rack);
    void add_wires(operate::Machine& machine);
    void add_cards(rack::Rack& rack);

    struct ListedSet {
        std::weak_ptr<ChannelSet> set;
        std::vector<const LiveChannel*> channels;
    };
    const operate::Service& service_;
    std::map<std::string, LiveChannel, std::less<>> channels_;
    std::map<std::vector<std::string>, ListedSet> sets_;
};

}  // namespace motionrack::panel
