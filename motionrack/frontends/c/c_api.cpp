// motionrack/c.h over rack::Session: pointers are checked, errors become codes and sentences, nothing is thrown out.
#include <motionrack/c.h>

#include <exception>
#include <memory>
#include <motionrack/rack/session.hpp>
#include <string>
#include <utility>

struct mr_rack {
    std::unique_ptr<motionrack::rack::Session> session;
};

namespace {

using motionrack::Error;
using motionrack::Result;
using motionrack::Trouble;
using motionrack::rack::Session;

thread_local std::string last_error;

/// Keeps the sentence, as far as there is memory for it.
int failed(int code, std::string_view sentence) noexcept {
    try {
        last_error = sentence;
    } catch (...) {
        last_error.clear();
    }
    return code;
}

int code_of(Trouble trouble) {
    switch (trouble) {
        case Trouble::bad_input: return MR_BAD_CALL;
        case Trouble::refused: return MR_REFUSED;
        case Trouble::io: return MR_IO;
        case Trouble::machine:
        case Trouble::stopped: break;
    }
    return MR_INTERNAL;
}

int null_pointer(const char* what) noexcept {
    return failed(MR_BAD_CALL, std::string_view(what));
}

/// Runs `call`, which gives a Result; whatever it throws becomes an error.
template <class Call>
int guarded(Call call) noexcept {
    try {
        const auto result = call();
        return result ? static_cast<int>(MR_OK) : failed(code_of(result.error().trouble), result.error().text());
    } catch (const std::bad_alloc&) {
        return failed(MR_INTERNAL, "There is not enough memory; nothing was done.");
    } catch (const std::exception& e) {
        return failed(MR_INTERNAL, e.what());
    } catch (...) {
        return failed(MR_INTERNAL, "Something went wrong in the library that it has no words for.");
    }
}

constexpr const char* no_rack = "The rack is a null pointer; open one with mr_rack_open. Nothing was done.";
constexpr const char* no_name = "A name is a null pointer. Nothing was done.";
constexpr const char* no_value = "There is no place for the value: it is a null pointer. Nothing was done.";

template <class Word>
int read(mr_rack* rack, const char* card, std::uint32_t address, Word* value) {
    if (rack == nullptr) return null_pointer(no_rack);
    if (card == nullptr) return null_pointer(no_name);
    if (value == nullptr) return null_pointer(no_value);
    return guarded([&]() -> Result<void> {
        MOTIONRACK_TRY(const std::uint32_t read, rack->session->read(card, 8 * static_cast<int>(sizeof(Word)), address));
        *value = static_cast<Word>(read);
        return {};
    });
}

template <class Word>
int write(mr_rack* rack, const char* card, std::uint32_t address, Word value) {
    if (rack == nullptr) return null_pointer(no_rack);
    if (card == nullptr) return null_pointer(no_name);
    return guarded([&] { return rack->session->write(card, 8 * static_cast<int>(sizeof(Word)), address, value); });
}

}  // namespace

int mr_rack_open(const char* toml_path_or_text, mr_rack** out) {
    if (out == nullptr) return null_pointer("There is no place for the rack: it is a null pointer. Nothing was done.");
    *out = nullptr;
    if (toml_path_or_text == nullptr) return null_pointer("The rack file is a null pointer. Nothing was done.");
    bool wrong_text = false;
    const int code = guarded([&]() -> Result<void> {
        auto session = Session::open(toml_path_or_text);
        if (!session) {
            wrong_text = session.error().trouble == Trouble::bad_input;
            return tl::unexpected<Error>(std::move(session).error());
        }
        *out = new mr_rack{std::move(*session)};
        return {};
    });
    return wrong_text ? static_cast<int>(MR_BAD_INPUT) : code;
}

void mr_rack_close(mr_rack* rack) {
    delete rack;
}

const char* mr_last_error(void) {
    return last_error.c_str();
}

int mr_advance_ns(mr_rack* rack, uint64_t ns) {
    if (rack == nullptr) return null_pointer(no_rack);
    return guarded([&] { return rack->session->advance(ns); });
}

uint64_t mr_now_ns(const mr_rack* rack) {
    if (rack != nullptr) return rack->session->now_ns();
    null_pointer(no_rack);
    return 0;
}

int mr_read8(mr_rack* rack, const char* card, uint32_t port, uint8_t* value) { return read(rack, card, port, value); }
int mr_write8(mr_rack* rack, const char* card, uint32_t port, uint8_t value) { return write(rack, card, port, value); }
int mr_read16(mr_rack* rack, const char* card, uint32_t offset, uint16_t* value) { return read(rack, card, offset, value); }
int mr_write16(mr_rack* rack, const char* card, uint32_t offset, uint16_t value) { return write(rack, card, offset, value); }
int mr_read32(mr_rack* rack, const char* card, uint32_t offset, uint32_t* value) { return read(rack, card, offset, value); }
int mr_write32(mr_rack* rack, const char* card, uint32_t offset, uint32_t value) { return write(rack, card, offset, value); }
