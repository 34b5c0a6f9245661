// Samples of a running rack: wires, registers and counters of cards, quantities of the machine.
//
//   "c1.xdrive" ─ wire ─┐
//   "c1.x.LP" ── card ──┼─► Recorder, every period ──► SampleTable: a row an instant, a column a name
//   "X.position_mm" ────┘
#pragma once

#include <cstdint>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <vector>

namespace motionrack::python {

/// Returns a channel that begins a row, then the channels of these names, to be read between runs. Errors:
/// invalid_input, listing the valid names, if a name is not that of a wire, a card value or a part quantity.
Result<std::vector<rack::SampledChannel>> sampled_channels(rack::Rack& rack, const rack::WireAccess& context,
                                                           const std::vector<std::string>& names);

class SampleTable final : public rack::ChangeSink {
  public:
    struct Column {
        rack::Channel channel;
        std::vector<std::int64_t> counts = {};
        std::vector<double> values = {};  ///< of a quantity; else empty

        std::int64_t last = 0;  ///< in the last row, even if that was dropped

        bool is_whole() const { return channel.kind != rack::ChannelKind::quantity; }
        void keep_last();
    };

    /// `declared`: of a recorder of sampled_channels(). Beyond `max_rows` rows, drops every second one and doubles
    /// their interval. Keeps the row of the end.
    SampleTable(const rack::Declaration& declared, std::size_t max_rows);

    void change(std::size_t index, std::int64_t value, Instant at) override;
    Result<void> close(Instant end) override;
    const std::vector<std::int64_t>& ticks() const { return ticks_; }
    const std::vector<Column>& columns() const { return columns_; }

  private:
    bool begin_row(Instant at);
    void add_row(Instant at);
    void thin_out();

    std::vector<Column> columns_;
    std::vector<std::int64_t> ticks_;
    std::size_t max_rows_, every_ = 1, skipped_ = 0;
    bool takes_row_ = false;
    Instant last_{};  ///< instant of the last row, even if that was dropped
};

}  // namespace motionrack::python
