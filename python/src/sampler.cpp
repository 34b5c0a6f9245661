// Resolves names and reads their values.
#include <cmath>
#include <motionrack/rack/quantities.hpp>
#include <python/src/sampler.hpp>

namespace motionrack::python {

namespace {

Result<Channel> channel_of(rack::Rack& rack, const rack::WireAccess& context, const std::string& name) {
    Channel out{name};
    for (const rack::WireAccess::Named& wire : context.names()) {
        if (wire.name != name) continue;
        out.whole = !wire.volts;
        out.look = [&context, name] { return *context.get(name); };
        out.count = [&context, name] { return static_cast<std::int64_t>(std::llround(*context.get(name))); };
        return out;
    }
    const std::size_t dot = std::min(name.find('.'), name.size());
    if (const rack::Card* card = rack.card(std::string_view(name).substr(0, dot));
        card != nullptr && dot < name.size()) {
        const std::string value = name.substr(dot + 1);
        const Result<std::int64_t> there = card->inspect(value);
        if (there) {
            out.whole = true;
            out.count = [card, value] { return *card->inspect(value); };
            return out;
        }
        if (!card->quantity(value)) return tl::unexpected<Error>(there.error());
    }
    MOTIONRACK_CHECK(rack::get_quantity(rack, name));
    out.whole = name.ends_with("_counts");  // card counters only
    out.look = [&rack, name] { return *rack::get_quantity(rack, name); };
    for (const rack::QuantitiesOfPart& of : rack::quantities_of(rack))
        for (const rack::Quantity& one : of.quantities) {
            if (of.part + '.' + one.name != name) continue;
            out.whole = one.whole();
            out.look = [&rack, get = one.get] { return get(rack.kernel().now()); };
        }
    out.count = [look = out.look] { return static_cast<std::int64_t>(std::llround(look())); };
    return out;
}

}  // namespace

Result<Sampler> Sampler::create(rack::Rack& rack, const rack::WireAccess& context,
                                const std::vector<std::string>& names, std::size_t max_samples) {
    Sampler out;
    out.max_samples_ = max_samples;
    for (const std::string& name : names) {
        MOTIONRACK_TRY(Channel channel, channel_of(rack, context, name));
        out.channels_.push_back(std::move(channel));
    }
    return out;
}

void Sampler::take(Instant now) {
    if (!ticks_.empty() && now.count() == ticks_.back()) return;
    if (++skipped_ < every_ && !ticks_.empty()) return;
    skipped_ = 0;
    if (ticks_.size() >= max_samples_) thin_out();
    ticks_.push_back(now.count());
    for (Channel& channel : channels_) {
        if (channel.whole)
            channel.counts.push_back(channel.count());
        else
            channel.values.push_back(channel.look());
    }
}

void Sampler::thin_out() {
    every_ *= 2;
    const auto halve = [](auto& values) {
        for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
        values.resize((values.size() + 1) / 2);
    };
    halve(ticks_);
    for (Channel& channel : channels_) {
        halve(channel.counts);
        halve(channel.values);
    }
}

}  // namespace motionrack::python
