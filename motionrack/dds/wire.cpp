// Converts samples to and from the network format, and joins a domain.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <motionrack/dds/wire.hpp>

namespace motionrack::dds {

void WireBuffer::put(const Sample& sample) {
    MOTIONRACK_ASSERT(sample.frame.words <= grating_bus::max_scales);
    wire_.format = sample.format;
    std::copy(sample.source.id.begin(), sample.source.id.end(), wire_.source);
    std::transform(sample.source.host.begin(), sample.source.host.end(), wire_.host,
                   [](char c) { return static_cast<std::uint8_t>(c); });
    wire_.process = sample.source.process;
    wire_.period = sample.period;
    wire_.pace = sample.pace;
    wire_.time = sample.frame.time;
    wire_.sequence_number = sample.frame.sequence;
    wire_.counts._length = sample.frame.words;
    std::copy_n(sample.frame.counts.begin(), sample.frame.words, wire_.counts._buffer);
    wire_.addresses._length = sample.frame.words;
    std::copy_n(sample.frame.addresses.begin(), sample.frame.words, wire_.addresses._buffer);
    wire_.crc = sample.frame.crc;
    wire_.check = sample.check;
}

void WireBuffer::get(Sample& sample) const {
    sample.format = wire_.format;
    std::copy(std::begin(wire_.source), std::end(wire_.source), sample.source.id.begin());
    std::transform(std::begin(wire_.host), std::end(wire_.host), sample.source.host.begin(),
                   [](std::uint8_t c) { return static_cast<char>(c); });
    sample.source.process = wire_.process;
    sample.period = wire_.period;
    sample.pace = wire_.pace;
    sample.frame.time = wire_.time;
    sample.frame.sequence = wire_.sequence_number;
    // Cyclone DDS rejects longer sequences. A shorter copy, or one with too few addresses, gives a wrong CRC.
    sample.frame.words =
        std::min({wire_.counts._length, wire_.addresses._length, static_cast<std::uint32_t>(grating_bus::max_scales)});
    std::copy_n(wire_.counts._buffer, sample.frame.words, sample.frame.counts.begin());
    std::copy_n(wire_.addresses._buffer, sample.frame.words, sample.frame.addresses.begin());
    sample.frame.crc = wire_.crc;
    sample.check = wire_.check;
}

tl::unexpected<Error> engine_error(const char* what, dds_return_t code) {
    return fail(
        ErrorKind::io,
        fmt::format(
            "{}: {} (code {}). Nothing was opened; check the network interfaces and the file of CYCLONEDDS_URI.", what,
            dds_strretcode(code), code));
}

Result<Entity> join(const std::string& bus, int domain) {
    MOTIONRACK_CHECK(check_bus_name(bus));
    MOTIONRACK_CHECK(check_domain(domain));
    MOTIONRACK_CHECK(load_library());
    Entity participant(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr));
    if (participant.get() < 0)
        return engine_error(fmt::format("DDS domain {} cannot be joined", domain).c_str(), participant.get());
    return participant;
}

Qos qos_of(const std::string& bus, bool ignore_own) {
    Qos qos(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
    dds_qset_partition1(qos.get(), bus.c_str());
    if (ignore_own) dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return qos;
}

}  // namespace motionrack::dds
