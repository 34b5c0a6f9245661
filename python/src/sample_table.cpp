// Resolves names, and keeps the values read under them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <motionrack/rack/quantities.hpp>
#include <python/src/sample_table.hpp>
#include <utility>

namespace motionrack::python {

namespace {

rack::SampledChannel channel_of(const std::string& name, bool whole, std::function<double()> look) {
    if (whole)
        return {{name, rack::ChannelKind::number},
                [look = std::move(look)] { return static_cast<std::int64_t>(std::llround(look())); }};
    return {{name, rack::ChannelKind::quantity},
            [look = std::move(look)] { return std::bit_cast<std::int64_t>(look()); }};
}

Result<rack::SampledChannel> find_channel(rack::Rack& rack, const rack::WireAccess& context, const std::string& name) {
    for (const rack::WireAccess::Named& wire : context.names())
        if (wire.name == name) {
            rack::SampledChannel out = channel_of(name, !wire.volts, [&context, name] { return *context.get(name); });
            if (wire.volts) out.channel.unit = "V";
            return out;
        }
    const std::size_t dot = std::min(name.find('.'), name.size());
    if (const rack::Card* card = rack.card(std::string_view(name).substr(0, dot));
        card != nullptr && dot < name.size()) {
        const std::string value = name.substr(dot + 1);
        const Result<std::int64_t> there = card->inspect(value);
        if (there)
            return rack::SampledChannel{{name, rack::ChannelKind::number},
                                        [card, value] { return *card->inspect(value); }};
        if (!card->quantity(value)) return tl::unexpected<Error>(there.error());
    }
    MOTIONRACK_CHECK(rack::get_quantity(rack, name));
    for (const rack::QuantitiesOfPart& of : rack::quantities_of(rack))
        for (const rack::Quantity& one : of.quantities)
            if (of.part + '.' + one.name == name)
                return channel_of(name, one.whole(), [&rack, get = one.get] { return get(rack.kernel().now()); });
    // A counter of a card.
    return channel_of(name, name.ends_with("_counts"), [&rack, name] { return *rack::get_quantity(rack, name); });
}

}  // namespace

Result<std::vector<rack::SampledChannel>> sampled_channels(rack::Rack& rack, const rack::WireAccess& context,
                                                           const std::vector<std::string>& names) {
    std::vector<rack::SampledChannel> out;
    out.push_back({{"row"}, [] { return std::int64_t{0}; }});
    for (const std::string& name : names) {
        MOTIONRACK_TRY(rack::SampledChannel channel, find_channel(rack, context, name));
        if (channel.channel.unit.empty()) channel.channel.unit = rack::unit_of_quantity(name);
        out.push_back(std::move(channel));
    }
    return out;
}

SampleTable::SampleTable(const rack::Declaration& declared, std::size_t max_rows) : max_rows_(max_rows) {
    for (std::size_t i = 1; i < declared.channels.size(); ++i) columns_.push_back({declared.channels[i]});
}

void SampleTable::change(std::size_t index, std::int64_t value, Instant at) {
    if (index == 0) {
        takes_row_ = begin_row(at);
    } else {
        Column& column = columns_[index - 1];
        column.last = value;
        if (takes_row_) column.keep_last();
    }
}

Result<void> SampleTable::close(Instant) {
    if (ticks_.empty() || last_.count() == ticks_.back()) return {};
    add_row(last_);
    for (Column& column : columns_) column.keep_last();
    return {};
}

void SampleTable::Column::keep_last() {
    if (is_whole())
        counts.push_back(last);
    else
        values.push_back(channel.shown(last));
}

/// Begins a row. Returns false for a second row at the same instant, and for rows that are dropped.
bool SampleTable::begin_row(Instant at) {
    last_ = at;
    if (!ticks_.empty() && at.count() == ticks_.back()) return false;
    if (++skipped_ < every_ && !ticks_.empty()) return false;
    skipped_ = 0;
    add_row(at);
    return true;
}

void SampleTable::add_row(Instant at) {
    if (ticks_.size() >= max_rows_) thin_out();
    ticks_.push_back(at.count());
}

void SampleTable::thin_out() {
    every_ *= 2;
    const auto halve = [](auto& values) {
        for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
        values.resize((values.size() + 1) / 2);
    };
    halve(ticks_);
    for (Column& column : columns_) {
        halve(column.counts);
        halve(column.values);
    }
}

}  // namespace motionrack::python
