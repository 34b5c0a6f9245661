// Runs two racks of one story and finds their first difference.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/cut.hpp>
#include <sstream>
#include <tests/text_of.hpp>

namespace motionrack::rack::cut {
namespace {

namespace fs = std::filesystem;

void carry_out(Session& session, const Order& order) {
    switch (order.kind) {
        case Order::write:
            static_cast<void>(session.write(order.on, order.bits, order.address, order.value));
            return;
        case Order::read:
            static_cast<void>(session.read(order.on, order.bits, order.address));
            return;
        case Order::wire:
            static_cast<void>(session.set_wire(order.on, order.level));
            return;
        case Order::fault:
            static_cast<void>(session.fault(order.what, order.on));
    }
}

/// Reads values of the machine, of each kind of card and of wires; a rack has only some of them.
void ask(Session& session) {
    for (const char* part : {"X.position_mm", "g2.age_us", "table.position_mm"}) static_cast<void>(session.part(part));
    constexpr std::array<std::array<const char*, 2>, 6> values = {{{"c1", "RR0"},
                                                                   {"d1", "POSITION"},
                                                                   {"p1", "0.POSITION"},
                                                                   {"s", "ENCODER0"},
                                                                   {"g1", "STATE"},
                                                                   {"g2", "2.COUNT"}}};
    for (const auto& [card, value] : values) static_cast<void>(session.peek(card, value));
    for (const char* wire : {"c1.xpp", "bus.data", "s.xout"}) static_cast<void>(session.wire(wire));
}

/// Advances in up to six pieces, some of zero length, some ending at a card's clock; reads values in between.
void pass_in_pieces(Session& session, std::uint64_t ns, Random& random) {
    constexpr std::uint64_t clock = 125;
    const std::uint64_t begin = session.now_ns();
    std::vector<std::uint64_t> ends{begin, begin + ns};
    for (std::uint64_t i = below(random, 6); i-- > 0;) {
        const std::uint64_t end = begin + below(random, ns + 1);
        ends.push_back(below(random, 2) == 0 ? end : std::max(begin, end / clock * clock));
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) {
        ASSERT_TRUE(session.advance(ends[i] - ends[i - 1]));
        ask(session);
    }
}

std::vector<std::string> reported(Session& session, std::uint64_t after) {
    std::vector<std::string> out;
    for (const sim::Condition& one : session.rack().kernel().conditions(after))
        out.push_back(
            fmt::format("{} {} {} {} {}", one.at.count(), static_cast<int>(one.device), one.code, one.a, one.b));
    return out;
}

/// Returns the devices whose state differs, and the first differing byte.
std::string difference(Session& one, Session& other) {
    std::string out;
    sim::Kernel &a = one.rack().kernel(), &b = other.rack().kernel();
    for (std::size_t i = 0; i < a.device_count(); ++i) {
        const auto id = static_cast<sim::DeviceId>(i);
        const std::span<std::byte> left = a.device(id).hashed_state(), right = b.device(id).hashed_state();
        const auto at = std::mismatch(left.begin(), left.end(), right.begin(), right.end()).first;
        if (at != left.end()) out += fmt::format(" {} at byte {};", a.device_name(id), at - left.begin());
    }
    if (a.events() != b.events()) out += fmt::format(" {} events and {};", a.events(), b.events());
    return out.empty() ? " the kernel" : out;
}

/// Returns the first line that differs.
std::string difference(const std::string& one, const std::string& other) {
    std::istringstream a(one), b(other);
    std::string left, right;
    for (int line = 1;; ++line) {
        const bool more = !std::getline(a, left).fail(), also = !std::getline(b, right).fail();
        if (!more && !also) return "";
        if (more != also || left != right)
            return fmt::format("line {} of the recording\n  {}\n  {}", line, more ? left : "", also ? right : "");
    }
}

struct World {
    /// `recording`: end of the name of a file that records all signals, such as whole.csv; empty: no recording.
    World(const std::string& text, const std::string& recording)
        : session(std::move(*Session::open(text))),
          path((fs::temp_directory_path() / fmt::format("motionrack_cut_{}_{}", ::getpid(), recording)).string()) {
        EXPECT_TRUE(recording.empty() || session->start_trace(path, "*"));
    }
    ~World() { fs::remove(path); }
    /// Interrupts and continues runs at each condition.
    void hear_conditions() {
        hears = true;
        session->on_condition([](const ReportedCondition&) {});
    }
    void become_its_copy() {
        session = std::move(*session->copy());
        if (hears) hear_conditions();
    }
    std::string recorded() { return session->stop_trace() ? text_of(path) : std::string(); }
    std::unique_ptr<Session> session;
    std::string path;
    bool hears = false;
};

/// Expects equal recordings of both racks. A recording belongs to one session, so no session is copied.
void expect_the_same_recording(const Story& story, std::uint64_t seed, const std::string& ending) {
    SCOPED_TRACE(ending);
    Random knife(seed + 2);
    World whole(story.text, "whole" + ending), cut(story.text, "cut" + ending);
    if (seed % 2 == 0) cut.hear_conditions();
    for (const Step& step : story.steps) {
        for (const Order& order : step.orders) {
            carry_out(*whole.session, order);
            carry_out(*cut.session, order);
        }
        ASSERT_TRUE(whole.session->advance(step.ns));
        pass_in_pieces(*cut.session, step.ns, knife);
    }
    ASSERT_EQ(whole.session->rack().kernel().trace_hash(), cut.session->rack().kernel().trace_hash());
    ASSERT_EQ(whole.session->state_hash(), cut.session->state_hash()) << difference(*whole.session, *cut.session);
    const std::string left = whole.recorded(), right = cut.recorded();
    ASSERT_FALSE(left.empty());
    ASSERT_TRUE(left == right) << difference(left, right);
}

}  // namespace

std::vector<Step> steps_of(Random& random, int count, const std::function<Orders(Random&)>& orders, double max_ns) {
    std::vector<Step> out;
    for (int i = 0; i < count; ++i) {
        Step& step = out.emplace_back();
        step.orders = orders(random);
        step.ns = spread(random, 50, max_ns);
    }
    return out;
}

void expect_the_same_however_it_is_cut(const Bench& bench, std::uint64_t seed) {
    SCOPED_TRACE(fmt::format("{}, MOTIONRACK_SEED={}", bench.name, seed));
    const Story story = bench.story(seed);
    Random knife(seed + 1);
    World whole(story.text, ""), cut(story.text, "");
    if (seed % 2 == 0) cut.hear_conditions();
    std::uint64_t heard = 0;
    for (std::size_t i = 0; i < story.steps.size(); ++i) {
        const Step& step = story.steps[i];
        if (below(knife, 20) == 0) cut.become_its_copy();
        for (const Order& order : step.orders) {
            carry_out(*whole.session, order);
            carry_out(*cut.session, order);
        }
        ASSERT_TRUE(whole.session->advance(step.ns));
        pass_in_pieces(*cut.session, step.ns, knife);
        const std::vector<std::string> changed = reported(*whole.session, heard);
        ASSERT_EQ(changed, reported(*cut.session, heard)) << "step " << i;
        heard += changed.size();
        ASSERT_EQ(whole.session->rack().kernel().trace_hash(), cut.session->rack().kernel().trace_hash())
            << "step " << i;
        ASSERT_EQ(whole.session->state_hash(), cut.session->state_hash())
            << "step " << i << ":" << difference(*whole.session, *cut.session);
    }
    expect_the_same_recording(story, seed, seed / 2 % 2 == 0 ? ".csv" : ".vcd");
}

}  // namespace motionrack::rack::cut
