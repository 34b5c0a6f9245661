// Checks the laws of sessions (session_laws.hpp) around the functions of motionrack/c.h. The linker redirects the calls
// of a test to the functions below, which call the library (option --wrap):
//
//   test ──mr_advance_ns──► advance() ──► picture, mr_advance_ns of the library, picture ──► SessionLaws
//
// Queries need no such function: the next picture would show a change that they made.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <motionrack/c.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <mutex>
#include <tests/invariants/c_sessions.hpp>
#include <tests/invariants/session_laws.hpp>
#include <utility>

extern "C" {
int real_open(const char* toml_path_or_text, mr_rack** out) __asm__("__real_mr_rack_open");
void real_close(mr_rack* rack) __asm__("__real_mr_rack_close");
int real_snapshot(mr_rack* rack, mr_rack** copy) __asm__("__real_mr_snapshot");
int real_advance(mr_rack* rack, std::uint64_t ns) __asm__("__real_mr_advance_ns");
int real_write8(mr_rack* rack, const char* card, std::uint32_t port, std::uint8_t value) __asm__("__real_mr_write8");
int real_write16(mr_rack* rack, const char* card, std::uint32_t offset,
                 std::uint16_t value) __asm__("__real_mr_write16");
int real_write32(mr_rack* rack, const char* card, std::uint32_t offset,
                 std::uint32_t value) __asm__("__real_mr_write32");
int real_wire_set(mr_rack* rack, const char* wire, double value) __asm__("__real_mr_wire_set");
int real_part_set(mr_rack* rack, const char* quantity, double value) __asm__("__real_mr_part_set");
int real_fault(mr_rack* rack, const char* fault, const char* target) __asm__("__real_mr_fault");
int real_run(mr_rack* rack, const char* path_or_text, const mr_run_options* options,
             mr_run_result* result) __asm__("__real_mr_run_program");
int real_home(mr_rack* rack, const char* axes) __asm__("__real_mr_home");

int wrapped_open(const char* toml_path_or_text, mr_rack** out) __asm__("__wrap_mr_rack_open");
void wrapped_close(mr_rack* rack) __asm__("__wrap_mr_rack_close");
int wrapped_snapshot(mr_rack* rack, mr_rack** copy) __asm__("__wrap_mr_snapshot");
int wrapped_advance(mr_rack* rack, std::uint64_t ns) __asm__("__wrap_mr_advance_ns");
int wrapped_write8(mr_rack* rack, const char* card, std::uint32_t port, std::uint8_t value) __asm__("__wrap_mr_write8");
int wrapped_write16(mr_rack* rack, const char* card, std::uint32_t offset,
                    std::uint16_t value) __asm__("__wrap_mr_write16");
int wrapped_write32(mr_rack* rack, const char* card, std::uint32_t offset,
                    std::uint32_t value) __asm__("__wrap_mr_write32");
int wrapped_wire_set(mr_rack* rack, const char* wire, double value) __asm__("__wrap_mr_wire_set");
int wrapped_part_set(mr_rack* rack, const char* quantity, double value) __asm__("__wrap_mr_part_set");
int wrapped_fault(mr_rack* rack, const char* fault, const char* target) __asm__("__wrap_mr_fault");
int wrapped_run(mr_rack* rack, const char* path_or_text, const mr_run_options* options,
                mr_run_result* result) __asm__("__wrap_mr_run_program");
int wrapped_home(mr_rack* rack, const char* axes) __asm__("__wrap_mr_home");
}

namespace motionrack::test {

namespace {

/// Makes the current test fail; in a C program without tests, ends the program with code 70.
void report_breach(const std::string& sentence) {
    if (testing::UnitTest::GetInstance()->current_test_info() != nullptr) {
        ADD_FAILURE() << "a law of sessions: " << sentence;
        return;
    }
    std::fprintf(stderr, "a law of sessions: %s\n", sentence.c_str());
    std::_Exit(70);
}

/// A checked axis, and the names of its card, counter and pulses.
struct NamedAxis {
    SessionAxis axis;
    std::string card, counter, pulses;
};

/// Returns the stepping axes of original MCX314s; an MCX314As may set its counters by itself.
std::vector<NamedAxis> watched_axes(const rack::RackConfig& config) {
    std::vector<NamedAxis> out;
    for (const rack::PulseLink& link : config.pulse_links) {
        const rack::RackCard& card = config.cards[static_cast<std::size_t>(link.card)];
        const rack::RackAxis& axis = config.axes[static_cast<std::size_t>(link.axis)];
        if (card.type != "mcx314" || rack::mcx314_in(card).variant != rack::Mcx314Variant::mcx314 || axis.servo)
            continue;
        out.push_back({{axis.letter, axis.pulses_per_unit(), axis.max_velocity, axis.max_accel, axis.max_velocity_step},
                       card.name,
                       fmt::format("{}.LP", "xyzu"[link.channel]),
                       fmt::format("{}.pulses", axis.letter)});
    }
    return out;
}

class CSession {
  public:
    CSession(mr_rack* rack, const std::vector<NamedAxis>& watched)
        : rack_(rack), watched_(watched), laws_(axes_of(watched), picture(), report_breach) {}

    void see() { laws_.see(picture()); }
    /// Executes a call that may change counters, and records it if it succeeds. A call-back in it cannot close the
    /// rack.
    template <class Call>
    int order(Call call) {
        if (!busy_ && !laws_.is_ordered()) see();
        const bool within = std::exchange(busy_, true);
        const int code = call();
        busy_ = within;
        if (code == MR_OK) laws_.ordered();
        return code;
    }
    int advance(std::uint64_t ns) {
        if (busy_) return real_advance(rack_, ns);
        see();
        const std::uint64_t before = mr_now_ns(rack_);
        busy_ = true;
        const int code = real_advance(rack_, ns);
        busy_ = false;
        const std::uint64_t passed = mr_now_ns(rack_) - before;
        if (passed != (code == MR_OK ? ns : 0))
            report_breach(fmt::format("{} ns were to pass and {} did (code {})", ns, passed, code));
        see();
        return code;
    }
    template <class Call>
    int drive(Call call) {
        if (busy_) return call();
        see();
        laws_.begin_drive();
        busy_ = true;
        const int code = call();
        busy_ = false;
        laws_.end_drive(picture(), code == MR_OK || code == MR_MACHINE || code == MR_STOPPED, code == MR_OK);
        return code;
    }
    void during_drive() { laws_.during_drive(picture()); }
    bool busy() const { return busy_; }
    const std::vector<NamedAxis>& watched() const { return watched_; }

  private:
    static std::vector<SessionAxis> axes_of(const std::vector<NamedAxis>& watched) {
        std::vector<SessionAxis> out;
        for (const NamedAxis& one : watched) out.push_back(one.axis);
        return out;
    }
    SessionPicture picture() const {
        SessionPicture out;
        out.ns = mr_now_ns(rack_);
        for (const NamedAxis& one : watched_) {
            std::uint64_t counter = 0;
            double pulses = 0;
            if (mr_peek(rack_, one.card.c_str(), one.counter.c_str(), &counter) != MR_OK ||
                mr_part_get(rack_, one.pulses.c_str(), &pulses) != MR_OK)
                report_breach(mr_last_error());
            out.counters.push_back(static_cast<std::int64_t>(counter));
            out.pulses.push_back(static_cast<std::int64_t>(pulses));
        }
        return out;
    }

    mr_rack* rack_;
    std::vector<NamedAxis> watched_;
    SessionLaws laws_;
    bool busy_ = false;  ///< inside a call, which may call the call-backs of a test
};

/// The open sessions. Several threads may use racks at the same time, each rack by one thread.
struct OpenSessions {
    std::mutex lock;
    std::map<const mr_rack*, std::unique_ptr<CSession>> sessions;
    int opened = 0;

    void add(mr_rack* rack, const std::vector<NamedAxis>& watched) {
        auto session = std::make_unique<CSession>(rack, watched);
        const std::lock_guard<std::mutex> alone(lock);
        sessions[rack] = std::move(session);
        ++opened;
    }
    /// Returns nullptr if the rack is not open.
    CSession* find(const mr_rack* rack) {
        const std::lock_guard<std::mutex> alone(lock);
        const auto found = sessions.find(rack);
        return found != sessions.end() ? found->second.get() : nullptr;
    }
    void remove(const mr_rack* rack) {
        const std::lock_guard<std::mutex> alone(lock);
        sessions.erase(rack);
    }
};

OpenSessions& open_sessions() {
    static OpenSessions all;
    return all;
}

/// User pointer of on_progress: the session, and the options with the test's own progress call-back.
struct WatchedProgress {
    CSession* session = nullptr;
    const mr_run_options* own = nullptr;
};

int on_progress(void* user, double seconds, std::int64_t line, std::int64_t lines) {
    const auto& watched = *static_cast<const WatchedProgress*>(user);
    watched.session->during_drive();
    if (watched.own == nullptr || watched.own->progress == nullptr) return 0;
    return watched.own->progress(watched.own->user, seconds, line, lines);
}

template <class Call>
int ordered_by(const mr_rack* rack, Call call) {
    CSession* session = open_sessions().find(rack);
    return session != nullptr ? session->order(call) : call();
}

}  // namespace

int sessions_under_laws() {
    OpenSessions& all = open_sessions();
    const std::lock_guard<std::mutex> alone(all.lock);
    return all.opened;
}

}  // namespace motionrack::test

using namespace motionrack::test;

int wrapped_open(const char* toml_path_or_text, mr_rack** out) {
    const int code = real_open(toml_path_or_text, out);
    if (code == MR_OK) open_sessions().add(*out, watched_axes(*motionrack::rack::read_rack(toml_path_or_text).config));
    return code;
}

void wrapped_close(mr_rack* rack) {
    if (CSession* session = open_sessions().find(rack); session != nullptr && !session->busy()) {
        session->see();
        open_sessions().remove(rack);
    }
    real_close(rack);
}

int wrapped_snapshot(mr_rack* rack, mr_rack** copy) {
    const int code = real_snapshot(rack, copy);
    if (CSession* session = open_sessions().find(rack); code == MR_OK && session != nullptr)
        open_sessions().add(*copy, session->watched());
    return code;
}

int wrapped_advance(mr_rack* rack, std::uint64_t ns) {
    CSession* session = open_sessions().find(rack);
    return session != nullptr ? session->advance(ns) : real_advance(rack, ns);
}

int wrapped_write8(mr_rack* rack, const char* card, std::uint32_t port, std::uint8_t value) {
    return ordered_by(rack, [&] { return real_write8(rack, card, port, value); });
}

int wrapped_write16(mr_rack* rack, const char* card, std::uint32_t offset, std::uint16_t value) {
    return ordered_by(rack, [&] { return real_write16(rack, card, offset, value); });
}

int wrapped_write32(mr_rack* rack, const char* card, std::uint32_t offset, std::uint32_t value) {
    return ordered_by(rack, [&] { return real_write32(rack, card, offset, value); });
}

int wrapped_wire_set(mr_rack* rack, const char* wire, double value) {
    return ordered_by(rack, [&] { return real_wire_set(rack, wire, value); });
}

int wrapped_part_set(mr_rack* rack, const char* quantity, double value) {
    return ordered_by(rack, [&] { return real_part_set(rack, quantity, value); });
}

int wrapped_fault(mr_rack* rack, const char* fault, const char* target) {
    return ordered_by(rack, [&] { return real_fault(rack, fault, target); });
}

int wrapped_run(mr_rack* rack, const char* path_or_text, const mr_run_options* options, mr_run_result* result) {
    CSession* session = open_sessions().find(rack);
    if (session == nullptr || session->busy()) return real_run(rack, path_or_text, options, result);
    WatchedProgress progress{session, options};
    mr_run_options watched{};
    if (options != nullptr) watched = *options;
    watched.progress = on_progress;
    watched.user = &progress;
    return session->drive([&] { return real_run(rack, path_or_text, &watched, result); });
}

int wrapped_home(mr_rack* rack, const char* axes) {
    CSession* session = open_sessions().find(rack);
    return session != nullptr ? session->drive([&] { return real_home(rack, axes); }) : real_home(rack, axes);
}
