// Samples of a running rack: wires, registers and counters of cards, quantities of the machine.
//
//   "c1.xdrive" ─ wire ─┐
//  "c1.x.LP" ── card ──┼─► an integer or a double per period
//   "X.position_mm" ────┘
#pragma once

#include <functional>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::python {

struct Channel {
    std::string name;
    bool whole = false;  ///< its values are in `counts`, else in `values`
    std::vector<std::int64_t> counts = {};
    std::vector<double> values = {};
    std::function<double()> look = {};
    std::function<std::int64_t()> count = {};
};

class Sampler {
  public:
    /// Errors: invalid_input, listing the valid names, if a name is not that of a wire, a card value or a part
    /// quantity.
    static Result<Sampler> create(rack::Rack& rack, const rack::WireAccess& context,
                                  const std::vector<std::string>& names, std::size_t max_samples);

    /// Takes a sample between runs. Beyond `max_samples` samples, drops every second one and doubles the sample
    /// interval.
    void take(Instant now);
    const std::vector<std::int64_t>& ticks() const { return ticks_; }
    const std::vector<Channel>& channels() const { return channels_; }

  private:
    void thin_out();

    std::vector<Channel> channels_;
    std::vector<std::int64_t> ticks_;
    std::size_t max_samples_ = 0, every_ = 1, skipped_ = 0;
};

}  // namespace motionrack::python
