// Implements the functions of motionrack/c.h for racks, buses, wires and recordings with rack::Session.
#include <fmt/format.h>

#include <motionrack/frontends/c/calls.hpp>
#include <motionrack/live/port_spec.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/toml_reader.hpp>

std::string& motionrack::c::last_error() {
    thread_local std::string sentence;
    return sentence;
}

namespace {

using namespace motionrack::c;
using motionrack::Error;
using motionrack::ErrorKind;
using motionrack::Result;
using motionrack::rack::ReportedCondition;
using motionrack::rack::Session;

constexpr const char* no_name = "A name is a null pointer. Nothing was done.";
constexpr const char* no_file = "The file's name is a null pointer. Nothing was done.";
constexpr const char* no_text = "The rack file is a null pointer. Nothing was done.";
constexpr const char* no_value = "The pointer to the value is null. Nothing was done.";
constexpr const char* no_location = "The pointer to the rack handle is null. Nothing was done.";

template <class Word>
constexpr int bits_of = 8 * static_cast<int>(sizeof(Word));

template <class Word>
int read(mr_rack* rack, const char* card, std::uint32_t address, Word* value) {
    return fetched({{rack, no_rack}, {card, no_card}, {value, no_value}}, value,
                   [&] { return rack->session->read(card, bits_of<Word>, address); });
}

/// Opens a session for a rack file or its text. Errors: as Session::open; invalid_input for the address of a real card.
Result<std::unique_ptr<Session>> open_session(std::string_view path_or_text) {
    if (!motionrack::live::names_real_card(path_or_text)) return Session::open(path_or_text, Session::Programs::yes);
    std::string reasons;
    for (const motionrack::rack::CardPlugin* plugin : motionrack::rack::card_plugins())
        if (reasons.find(plugin->no_live_port) == std::string::npos) reasons.append(" ").append(plugin->no_live_port);
    return motionrack::fail(
        ErrorKind::invalid_input,
        fmt::format("{} is the address of a real card, and the cards of a rack are virtual. Nothing was opened. A real "
                    "mcx314 is opened by mcx314_open(), a real databoard4002 by databoard4002_open().{}",
                    motionrack::rack::in_quotes(path_or_text), reasons));
}

template <class Word>
int write(mr_rack* rack, const char* card, std::uint32_t address, Word value) {
    return guarded({{rack, no_rack}, {card, no_card}},
                   [&] { return rack->session->write(card, bits_of<Word>, address, value); });
}

}  // namespace

// ---- racks and time

int mr_rack_open(const char* toml_path_or_text, mr_rack** out) {
    if (out != nullptr) *out = nullptr;
    bool wrong_text = false;
    const int code = guarded({{toml_path_or_text, no_text}, {out, no_location}}, [&]() -> Result<void> {
        auto session = open_session(toml_path_or_text);
        if (!session) {
            wrong_text = session.error().kind == ErrorKind::invalid_input;
            return tl::unexpected<Error>(std::move(session).error());
        }
        *out = new mr_rack{std::move(*session)};
        return {};
    });
    return wrong_text ? static_cast<int>(MR_BAD_INPUT) : code;
}

void mr_rack_close(mr_rack* rack) {
    if (rack == nullptr || guarded([&] { return rack->session->check_free(); }) != MR_OK) return;
    if (rack->session->is_recording()) (void)guarded([&] { return rack->session->stop_trace(); });
    delete rack;
}

const char* mr_last_error(void) {
    return last_error().c_str();
}

const char* mr_version(void) {
    return MOTIONRACK_VERSION;
}

int mr_advance_ns(mr_rack* rack, uint64_t ns) {
    return guarded({{rack, no_rack}}, [&] { return rack->session->advance(ns); });
}

uint64_t mr_now_ns(const mr_rack* rack) {
    if (rack != nullptr) return rack->session->now_ns();
    failed(MR_BAD_CALL, no_rack);
    return 0;
}

// ---- the bus

int mr_read8(mr_rack* rack, const char* card, uint32_t port, uint8_t* value) {
    return read(rack, card, port, value);
}
int mr_write8(mr_rack* rack, const char* card, uint32_t port, uint8_t value) {
    return write(rack, card, port, value);
}
int mr_read16(mr_rack* rack, const char* card, uint32_t offset, uint16_t* value) {
    return read(rack, card, offset, value);
}
int mr_write16(mr_rack* rack, const char* card, uint32_t offset, uint16_t value) {
    return write(rack, card, offset, value);
}
int mr_read32(mr_rack* rack, const char* card, uint32_t offset, uint32_t* value) {
    return read(rack, card, offset, value);
}
int mr_write32(mr_rack* rack, const char* card, uint32_t offset, uint32_t value) {
    return write(rack, card, offset, value);
}

int mr_peek(mr_rack* rack, const char* card, const char* register_name, uint64_t* value) {
    return fetched({{rack, no_rack}, {card, no_card}, {register_name, no_name}, {value, no_value}}, value,
                   [&] { return rack->session->peek(card, register_name); });
}

// ---- wires and parts

int mr_wire_get(mr_rack* rack, const char* wire, double* value) {
    return fetched({{rack, no_rack}, {wire, no_name}, {value, no_value}}, value,
                   [&] { return rack->session->wire(wire); });
}

int mr_wire_set(mr_rack* rack, const char* wire, double value) {
    return guarded({{rack, no_rack}, {wire, no_name}}, [&] { return rack->session->set_wire(wire, value); });
}

int mr_part_get(mr_rack* rack, const char* part_dot_quantity, double* value) {
    return fetched({{rack, no_rack}, {part_dot_quantity, no_name}, {value, no_value}}, value,
                   [&] { return rack->session->part(part_dot_quantity); });
}

int mr_part_set(mr_rack* rack, const char* part_dot_quantity, double value) {
    return guarded({{rack, no_rack}, {part_dot_quantity, no_name}},
                   [&] { return rack->session->set_part(part_dot_quantity, value); });
}

int mr_fault(mr_rack* rack, const char* fault, const char* target) {
    return guarded({{rack, no_rack}, {fault, no_name}, {target, no_name}},
                   [&] { return rack->session->fault(fault, target); });
}

// ---- the whole rack

int mr_snapshot(mr_rack* rack, mr_rack** copy) {
    if (copy != nullptr) *copy = nullptr;
    return guarded({{rack, no_rack}, {copy, no_location}}, [&]() -> Result<void> {
        MOTIONRACK_TRY(std::unique_ptr<Session> made, rack->session->copy());
        *copy = new mr_rack{std::move(made)};
        return {};
    });
}

int mr_conditions(mr_rack* rack, uint64_t since,
                  void (*tell)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                               const char* sentence),
                  void* user) {
    return guarded({{rack, no_rack}, {reinterpret_cast<const void*>(tell), no_tell}}, [&]() -> Result<void> {
        for (const ReportedCondition& one : rack->session->conditions(since))
            tell(user, one.number, one.at.count(), one.source.c_str(), one.code, one.sentence.c_str());
        return {};
    });
}

int mr_on_condition(mr_rack* rack,
                    void (*call)(void* user, uint64_t number, int64_t at_100ps, const char* card, int code,
                                 const char* sentence),
                    void* user) {
    return guarded({{rack, no_rack}}, [&]() -> Result<void> {
        std::function<void(const ReportedCondition&)> reported;
        if (call != nullptr)
            reported = [call, user](const ReportedCondition& one) {
                call(user, one.number, one.at.count(), one.source.c_str(), one.code, one.sentence.c_str());
            };
        rack->session->on_condition(std::move(reported));
        return {};
    });
}

int mr_trace_unit(mr_rack* rack, double ns) {
    return guarded({{rack, no_rack}}, [&] { return rack->session->set_trace_unit(ns); });
}

int mr_trace_start(mr_rack* rack, const char* path, const char* signals) {
    return guarded({{rack, no_rack}, {path, no_file}}, [&] {
        return rack->session->start_trace(path, signals == nullptr ? "" : signals, MOTIONRACK_VERSION);
    });
}

int mr_trace_stop(mr_rack* rack) {
    return guarded({{rack, no_rack}}, [&] { return rack->session->stop_trace(); });
}

uint64_t mr_state_hash(const mr_rack* rack) {
    if (rack != nullptr) return rack->session->state_hash();
    failed(MR_BAD_CALL, no_rack);
    return 0;
}
